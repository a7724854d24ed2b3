"""Something happens to a command at a random moment: a part of the check in `make verify`."""

import pytest

from tests.support import thorough

pytest.importorskip("pty", reason="no pseudo terminals, no limits of files")
from verification.struck_program import FAULTS
from verification.sudden_faults import NAMES, struck

# In `make test`: a full disk while runs are kept, and indexed; the kill of who keeps, of a page.
SEEDS = range(len(FAULTS) * len(NAMES)) if thorough.THOROUGH else (3, 4, 17, 57)


@pytest.mark.parametrize("seed", SEEDS)
def test_what_is_left_is_whole_and_what_is_said_is_so(seed):
    """Masses stand, files are whole or not there, nothing hidden stays, no traceback."""
    found = struck(seed)
    assert found.wrong == (), found
