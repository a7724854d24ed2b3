"""A board's program: a method, a law and the masses, put together for one testbed.

    row -> method -> law -> displacements

The parts are plain functions with the same arguments, whichever method and law are wanted.
"""

from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np

from equipoise.model.arrays import Floats, Vector3
from equipoise.model.testbed import Testbed
from equipoise.onboard.program import (
    camera_filter,
    level_by_pid,
    momentum_recursion,
    moves_every_25s,
)
from equipoise.onboard.program.displacements import Rails, put_displacements, rails_on, shift_of
from equipoise.onboard.program.request import Request


class Board(NamedTuple):
    """What does not change."""

    take_row: Callable[..., None]
    put_estimate: Callable[..., None]
    step: Callable[..., None]
    method: Any
    law: Any
    rails: Rails


class Memory(NamedTuple):
    """What changes with every row."""

    method: Any
    law: Any
    out: Request
    clock: Floats  # (1,) s since the first row


METHODS = {
    "ekf_9": (camera_filter, camera_filter.filter_of),
    "momentum_recursive": (momentum_recursion, momentum_recursion.recursion_on),
}
LAWS = {
    "pid": (level_by_pid, level_by_pid.pid_on),
    "ivanov_25s": (moves_every_25s, moves_every_25s.moves_on),
}


def on_row(own: Board, memory: Memory, dt: float, q: Floats, rate: Floats, d: Floats) -> None:
    """Take a row dt s after the last: attitude (w x y z), rate (rad/s) and displacements (m)."""
    out = memory.out
    own.take_row(own.method, memory.method, dt, q, rate, d)
    own.put_estimate(memory.method, q, out)
    memory.clock[0] += dt
    own.step(own.law, memory.law, memory.clock[0], q, rate, shift_of(own.rails, d), out)
    put_displacements(own.rails, out.shift, out.displacement)


def board_of(method: str, law: str, testbed: Testbed, target: Vector3) -> tuple[Board, Memory]:
    """Return the program for a testbed, and its memory before the first row."""
    (method_room, method_on), (law_room, law_on) = METHODS[method], LAWS[law]
    constants, memory = method_on(testbed)
    law_constants, law_memory = law_on(testbed, target)
    level, room = np.array([1.0, 0.0, 0.0, 0.0]), np.zeros(len(testbed.masses))
    out = Request(level, np.zeros(3), np.zeros(3), np.zeros(3), room, np.zeros(1, np.bool_))
    board = Board(method_room.take_row, method_room.put_estimate, law_room.step, constants,
                  law_constants, rails_on(testbed))  # fmt: skip
    return board, Memory(memory, law_memory, out, np.zeros(1))
