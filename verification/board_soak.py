"""A thousand random cycles of each motor board: is it stuck, blamed, or believed falsely?

Boards are emulated firmware behind a line of 115 200 baud, in bench time, byte by byte. The host is
busy (it looks now and then a third of a second late, and pauses for 0.5, 2 or 10 s), and once more
behind a line that splits, delays and stalls.
"""

from collections.abc import Sequence

import numpy as np

from equipoise.hardware.boards.registry import BOARDS
from tests.support.board_soak import STOPS, Tally, soak
from verification.result import Result, Row, Spread, at_most, in_turn

CYCLES = 20  # to a seed
HOWS = ("busy", "nasty")


def lived(seed: int) -> dict[tuple[str, str], Tally]:
    """Let each kind of board live through some cycles."""
    return {
        (kind, how): soak(kind, how, seed).run(CYCLES) for kind in sorted(BOARDS) for how in HOWS
    }


def measure(seeds: Sequence[int], spread: Spread = in_turn) -> Result:
    """Add up what became of all cycles."""
    runs = spread(lived, seeds)
    rows: list[Row] = []
    notes: list[str] = []
    for kind, how in sorted(runs[0]):
        own = [run[kind, how] for run in runs]
        halts = [each for run in own for each in run.halts]
        name = f"{kind}, {how}"
        rows += [
            at_most(f"{name}: stuck", sum(len(run.stuck) for run in own), 0, "d"),
            at_most(f"{name}: false positions", sum(len(run.false) for run in own), 0, "d"),
            at_most(f"{name}: faults without a cause", sum(len(run.blamed) for run in own), 0, "d"),
            at_most(f"{name}: halts or pauses too long", sum(len(run.late) for run in own), 0, "d"),
        ]
        if how == "busy":
            longest = float(np.max(halts, initial=0.0))
            rows.append(at_most(f"{name}: longest halt (s)", longest, STOPS, ".3f"))
        notes.append(f"{name}: {len(halts)} halts, {sum(run.homed for run in own)} homings.")
    claim = (
        f"{CYCLES * len(runs)} random cycles of each emulated board at 115200 baud: start, move, "
        "move again, halt in mid-move, home, reset, power, plug, limit switch, pause of the host."
    )
    return Result("board_soak", claim, tuple(rows), tuple(notes))
