"""Commands interrupted at random moments of their work: a part of the check in `make verify`."""

import pytest

from tests.support import thorough

pytest.importorskip("pty", reason="no pseudo terminals, no SIGINT")
from verification.interrupted_commands import COMMANDS, interrupted

# In `make test` one balancing in simulation and one on a bench.
SEEDS = range(6 * len(COMMANDS)) if thorough.THOROUGH else (2, 3)


@pytest.mark.parametrize("seed", SEEDS)
def test_an_interrupted_command_ends_by_itself_and_its_masses_stand(seed):
    """Each of the four commands in turn; one that had finished before was not interrupted."""
    found = interrupted(seed)
    wrong = found.crashed, found.astray, found.traceback, found.goes_on
    assert wrong == (False, False, False, False), found
    assert not found.finished or found.code in (0, 1), found
