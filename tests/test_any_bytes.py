"""Whatever bytes arrive, no parser raises anything but the declared error."""

import os

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.support import thorough
from tests.support.driver_fuzz_targets import TARGETS as DEVICES
from tests.support.file_fuzz_targets import TARGETS as FILES

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
