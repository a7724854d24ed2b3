"""The platform's motion from node to node, carried as attitude and total angular momentum.

The momentum H is continuous where a mass starts or stops, the rate is not, so H is the state; a
rate at such a corner is the one just before it. Steps are those of ``dynamics.propagation``, cut
short enough for the fastest of what may happen at their start:

    step <= TURN / (|w| + sqrt(g |mu| tr J^-1))     turning, and swinging as a pendulum

so that the motion depends on the nodes alone, not on how they are cut into runs. A step in which
the platform meets its stop is cut where it does (``simulation.stop``).
"""

from collections.abc import Callable, Sequence
from itertools import pairwise
from typing import NamedTuple

import numpy as np

from equipoise.dynamics.forcing import groups_of
from equipoise.dynamics.propagation import NO_COLUMNS, evaluate, step
from equipoise.dynamics.rigid_body import ROWS, Body, Now, body_at
from equipoise.dynamics.sensitivities import Columns, Inputs, work_for
from equipoise.maths.kernels.compiled import kernel, part
from equipoise.maths.kernels.copying import copy_values
from equipoise.model.arrays import Floats, Ints, Triple
from equipoise.simulation.stop import NO_STOP, Stop, is_beyond
from equipoise.simulation.striking import Course, lay, strike

TURN = 0.0125  # rad, chosen: energy then drifts by less than 1e-9 in ten minutes
LONGEST = 0.25  # s, chosen

NO_OWNERS = np.zeros((0, 2), dtype=np.int64)


class Path(NamedTuple):
    """The motion at every node."""

    y: Floats  # (n, 7) attitude, then angular momentum about P in body axes, N m s; and what a
    # platform with modes has behind these (``dynamics.modal_motion``)
    rate: Floats  # (n, 3) rad/s
    touch: Floats  # (n, 4) of the stop since the node before, zeros if none: first and last time,
    # s; impulse along laboratory x and y, N m s


def path_of(n: int, width: int = ROWS) -> Path:
    """Return a motion of n nodes to be written, of a state of so many numbers."""
    return Path(np.zeros((n, width)), np.zeros((n, 3)), np.zeros((n, 4)))


def in_pieces(edges: Sequence[int], y: Floats, follow: Callable[[Floats, slice], Path]) -> Path:
    """Return the motion from state ``y``, followed piece by piece between nodes (``edges``).

    ``follow`` returns the motion along a slice of nodes, from the state at its first.
    """
    path = path_of(edges[-1] + 1, len(y))
    path.y[0] = y
    for a, b in pairwise(edges):
        part = follow(path.y[a], slice(a, b + 1))
        for whole, piece in zip(path, part, strict=True):
            whole[a + 1 : b + 1] = piece[1:]
        if a == 0:
            path.rate[0] = part.rate[0]
    return path


@part
def parts_of(body: Body, now: Now, w: Triple, gap: float) -> int:
    """Return into how many steps a gap (s) is cut."""
    mu, inverse = now.moment, now.inverse
    turning = (w[0] * w[0] + w[1] * w[1] + w[2] * w[2]) ** 0.5
    moment = (mu[0] * mu[0] + mu[1] * mu[1] + mu[2] * mu[2]) ** 0.5
    swinging = (body.gravity * moment * (inverse[0] + inverse[1] + inverse[2])) ** 0.5
    steps = abs(gap) * max((turning + swinging) / TURN, 1.0 / LONGEST)
    return max(int(np.ceil(steps - 1e-9)), 1)


@kernel
def _run(
    body: Body,
    maps: Floats,
    stop: Stop,
    t: Floats,
    known: Floats,
    owners: Ints,
    columns: Columns,
    y: Floats,
    path: Floats,
    rates: Floats,
    touch: Floats,
) -> None:
    t3, known3, before = np.zeros(3), np.zeros((3, known.shape[1])), y.copy()
    inputs = Inputs(maps, t3, known3, owners, columns, groups_of(columns))
    work = work_for(0)
    course = Course(body, stop, t, known, inputs, work)
    copy_values(y, path[0])
    for node in range(t.shape[0] - 1):
        lay(t, known, node, 0.0, 1.0, t3, known3)
        now = body_at(body, maps, t3, known3, 1, 0.0)
        w, _ = evaluate(body, now, inputs, 1, 0.0, y, work)
        if node == 0:
            rates[0, 0], rates[0, 1], rates[0, 2] = w
        n = parts_of(body, now, w, t[node + 1] - t[node])
        for j in range(n):
            first, last = j / n, (j + 1) / n
            if n > 1:
                lay(t, known, node, first, last, t3, known3)
            copy_values(y, before)
            step(body, inputs, 1, y, work)
            if is_beyond(stop, y):
                strike(course, node, first, last, before, y, touch[node + 1])
        now = body_at(body, maps, t3, known3, 1, 1.0)
        w, _ = evaluate(body, now, inputs, 1, 1.0, y, work)
        copy_values(y, path[node + 1])
        rates[node + 1, 0], rates[node + 1, 1], rates[node + 1, 2] = w


def run(
    body: Body, maps: Floats, y: Floats, t: Floats, known: Floats, stop: Stop = NO_STOP
) -> Path:
    """Return the motion from state ``y`` at the first of at least two nodes ``t`` (s).

    ``known`` holds, at each node, stored momentum, torque, warmth and displacements, as in
    ``timeline``; nodes may also run backward, where there is no stop.
    """
    path = path_of(len(t))
    _run(body, maps, stop, t, known, NO_OWNERS, NO_COLUMNS, y.copy(), *path)
    return path
