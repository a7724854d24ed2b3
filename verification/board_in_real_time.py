"""Random cycles of each motor board in real time, behind a pseudo terminal, both cores busy.

As ``board_soak``, with what the system makes of a serial line and of a computer that is at work.
"""

from collections.abc import Sequence

import numpy as np

from equipoise.hardware.boards.registry import BOARDS
from tests.support.board_in_real_time import RealTimeSoak, busy_cores
from tests.support.board_soak import STOPS, Tally
from verification.result import Result, Row, Spread, at_most, in_turn

CYCLES, CORES = 10, 2  # to a seed; processes that do nothing but work
SLACK = 0.1  # s, chosen: by which a busy system may delay a halt


def lived(seed: int) -> dict[str, Tally]:
    """Let each kind of board live through some cycles."""
    done: dict[str, Tally] = {}
    with busy_cores(CORES):
        for kind in sorted(BOARDS):
            soak = RealTimeSoak(kind, seed, SLACK)
            done[kind] = soak.run(CYCLES)
            soak.close()
    return done


def measure(seeds: Sequence[int], spread: Spread = in_turn) -> Result:
    """Add up what became of all cycles; one after the other, whatever the workers."""
    runs = list(in_turn(lived, seeds))
    rows: list[Row] = []
    notes: list[str] = []
    for kind in sorted(BOARDS):
        own = [run[kind] for run in runs]
        halts = [each for run in own for each in run.halts]
        rows += [
            at_most(f"{kind}: stuck", sum(len(run.stuck) for run in own), 0, "d"),
            at_most(f"{kind}: false positions", sum(len(run.false) for run in own), 0, "d"),
            at_most(f"{kind}: faults without a cause", sum(len(run.blamed) for run in own), 0, "d"),
        ]
        if halts:
            late = float(np.quantile(halts, 0.9))
            rows.append(at_most(f"{kind}: nine of ten halts (s)", late, STOPS, ".3f"))
            notes.append(f"{kind}: {len(halts)} halts, the longest {max(halts):.3f} s.")
    claim = (
        f"{CYCLES * len(runs)} random cycles of each emulated board in real time behind a pseudo "
        f"terminal, {CORES} processes keeping the cores busy."
    )
    return Result("board_in_real_time", claim, tuple(rows), tuple(notes))
