"""Settings of every test."""

import signal

import pytest
from hypothesis import settings

from tests.support import thorough

# Time is the benchmark's to judge; the first example of a test may have to compile its kernel.
settings.register_profile("house", deadline=None, max_examples=thorough.count(100, 30))
settings.load_profile("house")

# A shell that runs the tests in the background lets Ctrl-C be ignored, by all that they start too.
signal.signal(signal.SIGINT, signal.default_int_handler)


def may_run_in_part(item: pytest.Item) -> bool:
    """Say whether a test draws examples, or its module asks how much of it runs."""
    requests = getattr(item.module, "thorough", None) is thorough
    return requests or getattr(item.obj, "is_hypothesis_test", False)


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
