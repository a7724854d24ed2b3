"""Settings of every test."""

import signal
from pathlib import Path

import jaxtyping
import pytest
from hypothesis import settings

from tests.support import thorough

# Time is the benchmark's to judge; the first example of a test may have to compile its kernel.
settings.register_profile("house", deadline=None, max_examples=thorough.count(100, 20))
settings.load_profile("house")

# A shell that runs the tests in the background, or under nohup, lets signals to stop be ignored, by
# all that they start too.
signal.signal(signal.SIGINT, signal.default_int_handler)
for name in ("SIGTERM", "SIGHUP"):
    if hasattr(signal, name):
        signal.signal(getattr(signal, name), signal.SIG_DFL)

# Shapes and types are checked by the tests of the rooms that are decorated for it (pyproject.toml)
# and of the front door; in runs of other rooms' tests the checks are up to half of the time.
CHECKED = ("model", "io", "procedure/steps", "assessment", "app/api")
HERE = Path(__file__).parent


def checks_shapes(item: pytest.Item) -> bool:
    """Say whether a test does: in `make verify` all do but long statistics."""
    room = item.path.relative_to(HERE).as_posix()
    return room.startswith(CHECKED) or (thorough.THOROUGH and not room.startswith("statistical"))


@pytest.hookimpl(tryfirst=True)
def pytest_runtest_setup(item: pytest.Item) -> None:
    """Switch shape checks on or off before the fixtures of a test are made."""
    jaxtyping.config.update("jaxtyping_disable", not checks_shapes(item))


def may_run_in_part(item: pytest.Item) -> bool:
    """Say whether a test draws examples, or its module asks how much of it runs."""
    requests = getattr(item.module, "thorough", None) is thorough
    fewer = {"few_draws", "few_platforms"} & set(getattr(item, "fixturenames", ()))
    return requests or bool(fewer) or getattr(item.obj, "is_hypothesis_test", False)


def pytest_collection_modifyitems(config: pytest.Config, items: list[pytest.Item]) -> None:
    """Mark what `make verify` runs again in full; leave out what runs nowhere else."""
    for item in items:
        if may_run_in_part(item):
            item.add_marker("thorough")
    if thorough.THOROUGH:
        return
    left_out = [item for item in items if item.get_closest_marker("whole")]
    items[:] = [item for item in items if item not in left_out]
    config.hook.pytest_deselected(items=left_out)


@pytest.fixture
def few_draws(monkeypatch: pytest.MonkeyPatch) -> None:
    """Let linear methods find their sd from half as many replicates, in `make verify` from all."""
    thorough.few_draws(monkeypatch)


@pytest.fixture
def few_platforms(monkeypatch: pytest.MonkeyPatch) -> None:
    """Let plans predict sd from a tenth of the platforms, in `make verify` from all."""
    thorough.few_platforms(monkeypatch)
