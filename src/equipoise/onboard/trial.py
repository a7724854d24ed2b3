"""A board's program in a loop with a bench: rows go in, masses go where it says.

The program is a function from a row (t, q, rate, d) to an answer (com, its sd, displacements,
finished): Python's own, or a program in C at the other end of a pipe. Both see the same rows.
"""

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np

from equipoise.maths.straight_lines import read_at
from equipoise.model.arrays import Floats, Series
from equipoise.model.bench import Bench
from equipoise.model.recording import Recording, Samples
from equipoise.model.testbed import Testbed
from equipoise.onboard.plain_python import plain_python
from equipoise.onboard.program.board import Board, Memory, on_row
from equipoise.sensors.timing import measured_at

Answer = Callable[[Floats], Floats]
STILL = 1e-9  # m, chosen: a goal that changes by less is the same


@dataclass(frozen=True, slots=True, eq=False)
class Trial:
    """What went in and came out."""

    rows: Series  # (n, 8 + k)
    answers: Series  # (n, 7 + k)


def plain_answer(board: Board, memory: Memory) -> Answer:
    """Return the program as the interpreter runs it; the memory is its own from now on."""
    take = plain_python(on_row)
    board = board._replace(
        take_row=plain_python(board.take_row),
        put_estimate=plain_python(board.put_estimate),
        step=plain_python(board.step),
    )

    before: list[float] = []

    def answer(row: Floats) -> Floats:
        t = float(row[0])
        dt = t - before.pop() if before else 0.0
        before.append(t)
        take(board, memory, dt, row[1:5], row[5:8], row[8:])
        out = memory.out
        finished = np.array([float(out.finished[0])])
        return np.concatenate([out.com, out.com_sd, out.displacement, finished])

    return answer


def rows_of(fresh: Recording, testbed: Testbed, here: Floats, longest: int) -> Iterator[Floats]:
    """Yield rows of what was read, the last ``longest`` of them at most; masses stood ``here``."""
    attitude = fresh.attitude
    if attitude is None or not len(attitude):
        return
    t = measured_at(attitude.t, testbed.attitude)[-longest:]
    rate, masses = read_or(fresh.rate, t, np.zeros(3)), read_or(fresh.masses, t, here)
    yield from np.column_stack([t, attitude.values[-longest:], rate, masses])


def read_or(channel: Samples | None, t: Floats, otherwise: Floats) -> Floats:
    """Return a channel at times, straight between its rows; a value where it has none."""
    if channel is None or not len(channel):
        return np.tile(otherwise, (len(t), 1))
    return read_at(t, channel.t, channel.values)


def run_trial(
    bench: Bench, answer: Answer, duration: float, period: float, longest: int = 1
) -> Trial:
    """Run a program on a bench for so long (s), reading every ``period`` s."""
    names = [mass.name for mass in bench.testbed.masses]
    here, goal = np.zeros(len(names)), np.zeros(len(names))
    rows, answers, end = list[Any](), list[Any](), bench.time + duration
    while bench.time < end - period / 2:
        for row in rows_of(bench.read(period), bench.testbed, here, longest):
            rows.append(row)
            answers.append(answer(row))
            here = row[8:]
        wanted = answers[-1][6:-1] if answers else goal
        changed = np.flatnonzero(np.abs(wanted - goal) > STILL)
        if len(changed):
            bench.move({names[k]: float(wanted[k]) for k in changed})
            goal = wanted
        if answers and answers[-1][-1]:
            break
    return Trial(np.array(rows), np.array(answers))
