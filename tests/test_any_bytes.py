"""Whatever bytes arrive, no parser raises anything but the declared error."""

import math
import os
import resource
import tempfile
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.support import thorough
from tests.support.driver_fuzz_targets import TARGETS as DEVICES
from tests.support.file_fuzz_targets import TARGETS as FILES
from tests.support.fuzz_target import Target, folder
from tests.support.watched_files import WATCHER
from verification.structures import SHAKES, share_of
from verification.structures import TARGETS as STRUCTURED

TRIED = 2000  # in all, the slow less often; a million in ``verification.structures``
ROOM = 1 << 30  # bytes that a reader may take
EXAMPLES, FEWEST = int(os.environ.get("EQUIPOISE_FUZZ", thorough.count(150, 50))), 10


@pytest.mark.parametrize("target", [*DEVICES, *FILES], ids=lambda each: each.name)
def test_no_bytes_raise(target):
    """Junk alone, and valid bytes with junk in the place of some."""
    valid = target.valid()
    target.take(valid)

    @settings(max_examples=max(FEWEST, round(EXAMPLES * target.share)), deadline=None)
    @given(st.binary(max_size=60), st.integers(0, len(valid)), st.integers(0, 60), st.booleans())
    def fuzz(junk: bytes, at: int, lost: int, inside: bool) -> None:
        target.take(valid[:at] + junk + valid[at + lost :] if inside else junk)

    fuzz()


@pytest.fixture
def one_gigabyte():
    """Let this process grow by a gigabyte, and no more."""
    soft, hard = resource.getrlimit(resource.RLIMIT_DATA)
    status = Path("/proc/self/status").read_text(encoding="ascii").splitlines()
    (data,) = (int(line.split()[1]) << 10 for line in status if line.startswith("VmData"))
    resource.setrlimit(resource.RLIMIT_DATA, (data + ROOM, hard))
    yield
    resource.setrlimit(resource.RLIMIT_DATA, (soft, hard))


def _tried(target: Target) -> int:
    return math.ceil(TRIED * share_of(target) / sum(map(share_of, STRUCTURED)))


@pytest.mark.parametrize("target", STRUCTURED, ids=lambda each: each.name)
def test_no_structure_raises(target, one_gigabyte):
    """A file that is taken apart and put together wrongly; nothing is written elsewhere."""
    rng, valid = np.random.default_rng(7), target.valid()
    target.take(valid)
    WATCHER.found = []
    for _ in range(_tried(target)):
        content = SHAKES[target.name](valid, rng)
        with WATCHER.watching(str(folder()), tempfile.gettempdir()):
            target.take(content)
    assert WATCHER.found == []
