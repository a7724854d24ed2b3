"""The law ``ivanov_25s`` row by row: four moves to the target, one every 25 s.

s = r* - r        at the first row from each due moment on (``control.laws.ivanov_25s``)
"""

from typing import NamedTuple

import numpy as np

from equipoise.control.laws.ivanov_25s import LAW, MOVES, due_after
from equipoise.model.arrays import Bools, Floats, Ints, Triple, Vector3
from equipoise.model.testbed import Testbed
from equipoise.onboard.program.request import Request


class Moves(NamedTuple):
    """What does not change."""

    target: Triple  # m


class Memory(NamedTuple):
    """Where it stands."""

    began: Floats  # (1,) s
    moves: Ints  # (1,)
    begun: Bools  # (1,)


def step(
    own: Moves, memory: Memory, t: float, q: Floats, rate: Floats, shift: Triple, out: Request
) -> None:
    """Write the shift that is wanted at t s; finished once the last move has had its time."""
    if not memory.begun[0]:
        memory.begun[0], memory.began[0] = True, t
    moves = memory.moves[0]
    made = moves >= MOVES
    if t - memory.began[0] < due_after(moves, made):
        return
    if made:
        out.finished[0] = True
        return
    for j in range(3):
        out.shift[j] = own.target[j] - out.com[j]
    memory.moves[0] = moves + 1


def moves_on(testbed: Testbed, target: Vector3) -> tuple[Moves, Memory]:
    """Return the law at its beginning; InputError where the library's law refuses the testbed."""
    LAW.begin(testbed, target)
    x, y, z = map(float, target)
    memory = Memory(np.zeros(1), np.zeros(1, np.int64), np.zeros(1, np.bool_))
    return Moves((x, y, z)), memory
