"""The motion of a platform with modes from node to node, as ``simulation.motion`` has a rigid one.

Over a step in which the platform meets its stop the modes pass as if it did not, and the platform
as if they stayed as they were at its beginning: an impulse of the stop changes H, and not p.
"""

import numpy as np

from equipoise.dynamics.forcing import groups_of
from equipoise.dynamics.modal_motion import (
    Modes,
    S,
    modal_parts,
    modal_step,
    modal_work,
    with_modes,
)
from equipoise.dynamics.propagation import NO_COLUMNS, evaluate
from equipoise.dynamics.rigid_body import ROWS, Body, Now, body_at, cross
from equipoise.dynamics.sensitivities import Inputs, Work
from equipoise.maths.kernels.compiled import kernel
from equipoise.maths.kernels.copying import copy_values
from equipoise.model.arrays import Floats, Ints, Triple
from equipoise.simulation.motion import NO_OWNERS, Path, path_of
from equipoise.simulation.stop import NO_STOP, Stop, is_beyond
from equipoise.simulation.striking import Course, lay, strike


@kernel
def _strike(
    body: Body, stop: Stop, modes: Modes, rigid: Now, moved: Now, g: Triple, inputs: Inputs,
    work: Work, shares: tuple[float, float], before: Floats, y: Floats, touch: Floats,
) -> None:  # fmt: skip
    """Take q and H of y again over a part of step 1 at whose end it was beyond the stop.

    ``rigid`` and ``moved`` are the platform at its beginning without and with its modes.
    """
    gap, known = inputs.t[1:3].copy(), inputs.known[1:3].copy()
    moment = np.zeros(3)
    for k in range(modes.table.shape[0]):
        for j in range(3):
            moment[j] += before[ROWS + 2 * k] * modes.table[k, S + j]
    pull = cross((moment[0], moment[1], moment[2]), g)
    for row in range(2):
        for j in range(3):
            known[row, j] += moved.momentum[j] - rigid.momentum[j]
            known[row, 3 + j] += pull[j]
    t3, known3 = inputs.t.copy(), inputs.known.copy()
    within = Inputs(inputs.maps, t3, known3, inputs.owners, inputs.columns, inputs.groups)
    course = Course(body, stop, gap, known, within, work)
    strike(course, 0, shares[0], shares[1], before[:ROWS], y[:ROWS], touch)


@kernel
def _run(
    body: Body, maps: Floats, modes: Modes, stop: Stop, t: Floats, known: Floats, owners: Ints,
    y: Floats, path: Path,
) -> None:  # fmt: skip
    t3, known3, before = np.zeros(3), np.zeros((3, known.shape[1])), y.copy()
    inputs = Inputs(maps, t3, known3, owners, NO_COLUMNS, groups_of(NO_COLUMNS))
    work = modal_work(modes)
    copy_values(y, path.y[0])
    for node in range(t.shape[0] - 1):
        lay(t, known, node, 0.0, 1.0, t3, known3)
        now = with_modes(modes, body_at(body, maps, t3, known3, 1, 0.0), y)
        w, _ = evaluate(body, now, inputs, 1, 0.0, y, work)
        if node == 0:
            path.rate[0, 0], path.rate[0, 1], path.rate[0, 2] = w
        n = modal_parts(body, modes, now, w, t[node + 1] - t[node])
        for j in range(n):
            copy_values(y, before)
            modal_step(body, modes, inputs, 1, j / n, (j + 1) / n, y, work)
            if is_beyond(stop, y):
                rigid = body_at(body, maps, t3, known3, 1, j / n)
                moved = with_modes(modes, rigid, before)
                _, g = evaluate(body, moved, inputs, 1, j / n, before, work)
                _strike(body, stop, modes, rigid, moved, g, inputs, work, (j / n, (j + 1) / n),
                        before, y, path.touch[node + 1])  # fmt: skip
        now = with_modes(modes, body_at(body, maps, t3, known3, 1, 1.0), y)
        w, _ = evaluate(body, now, inputs, 1, 1.0, y, work)
        copy_values(y, path.y[node + 1])
        path.rate[node + 1, 0], path.rate[node + 1, 1], path.rate[node + 1, 2] = w


def run_modes(
    body: Body, maps: Floats, modes: Modes, y: Floats, t: Floats, known: Floats,
    stop: Stop = NO_STOP,
) -> Path:  # fmt: skip
    """Return the motion from state ``y`` at the first of at least two nodes ``t`` (s).

    Behind q and H the state has e and p of every mode; all else is as in ``motion.run``.
    """
    path = path_of(len(t), len(y))
    _run(body, maps, modes, stop, t, known, NO_OWNERS, y.copy(), path)
    return path
