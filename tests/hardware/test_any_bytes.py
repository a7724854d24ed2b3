"""Whatever arrives, no driver of a sensor raises: junk, and valid messages with junk in them."""

import os

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.hardware.fuzz import PARSERS, told

EXAMPLES = int(os.environ.get("EQUIPOISE_FUZZ", "150"))


@pytest.mark.parametrize(("name", "hear"), PARSERS, ids=[name for name, _ in PARSERS])
def test_no_bytes_raise(name, hear):
    valid = told(name)
    assert valid

    @settings(max_examples=EXAMPLES, deadline=None)
    @given(st.binary(max_size=60), st.integers(0, len(valid)), st.integers(0, 60), st.booleans())
    def fuzz(junk: bytes, at: int, lost: int, inside: bool) -> None:
        hear(valid[:at] + junk + valid[at + lost :] if inside else junk)

    fuzz()
