"""Random cycles of a board's life at wire speed: nothing is stuck, no position is believed falsely.

``verification/board_soak.py`` lives through a thousand of them.
"""

import pytest

from equipoise.hardware.boards.registry import BOARDS
from tests.support import thorough
from tests.support.board_soak import LINES, soak


@pytest.mark.parametrize("kind", sorted(BOARDS))
@pytest.mark.parametrize("how", sorted(LINES))
def test_a_board_lives_through_random_cycles(kind, how):
    """Starts, moves, halts, pauses, resets, switches, plugs; halts stop within 0.2 s."""
    done = soak(kind, how, 1).run(thorough.count(400, 60))
    assert done.cycles > 0
    assert (done.stuck, done.false, done.blamed, done.late) == ([], [], [], [])
