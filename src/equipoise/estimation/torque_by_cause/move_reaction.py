"""What travelling masses take of the momentum, beside the shift of the centre of mass.

    K = dJ w + h,      impulse on the rest = -(K_end - K_begin) - int w x K dt

dJ: change of inertia since the record began; h: momentum of travel. Rates jump where a mass starts
or stops; each step sees its own, and the first K is that of the step before the stretch.
"""

import numpy as np

from equipoise.actuators.sliding_masses import MassMaps, inertia_shift
from equipoise.dynamics.rigid_body import KNOWN_D
from equipoise.estimation.output_error.problem import Problem
from equipoise.estimation.parameters.fit_parameters import Unknowns
from equipoise.estimation.torque_by_cause.stretch_motion import Within
from equipoise.maths.linalg import unpack_symmetric
from equipoise.model.arrays import Floats, Series3, Vector3


def reaction_of(problem: Problem, at: Within, point: Unknowns, start: Floats) -> Vector3:
    """Return the change of K with int w x K (N m s); masses stood at ``start`` (m) at first."""
    d = at.known[:, KNOWN_D : KNOWN_D + len(problem.maps.momentum)]
    before = at.before[: d.shape[1]]
    if not np.any(d != start) and not np.any(before):
        return np.zeros(3)
    h = (at.t[2::2] - at.t[:-2:2])[:, None]
    travel = (d[2::2] - d[:-2:2]) / h
    ends = [moved_momentum(problem, at, point, start, (rows, travel))
            for rows in (slice(0, -1, 2), slice(1, None, 2), slice(2, None, 2))]  # fmt: skip
    first = moved_momentum(problem, at, point, start, (slice(0, 1), before[None]))[1]
    turned = [np.cross(w, K) for w, K in ends]
    integral = np.sum(h / 6 * (turned[0] + 4 * turned[1] + turned[2]), axis=0)
    return ends[2][1][-1] - first[0] + integral


def moved_momentum(
    problem: Problem, at: Within, point: Unknowns, start: Floats, step: tuple[slice, Floats]
) -> tuple[Series3, Series3]:
    """Return rate and K at some nodes, as steps see them in which masses travel so fast (m/s)."""
    (rows, travel), maps = step, problem.maps
    d, wheels = at.known[rows, KNOWN_D : KNOWN_D + travel.shape[1]], at.known[rows, :3]
    h = travel @ maps.momentum
    inertia = point.body(problem.mass).inertia_P + bent(maps, d, np.zeros_like(start))
    left: Floats = at.motion.momentum[rows] - wheels - h
    w = np.linalg.solve(inertia, left[..., None])[..., 0].astype(np.float64, copy=False)
    return w, np.einsum("nij,nj->ni", bent(maps, d, start), w) + h


def bent(maps: MassMaps, d: Floats, start: Floats) -> Floats:
    """Return the change of inertia from displacements ``start`` (m) to others (n, k), (n, 3, 3)."""
    change = inertia_shift(maps, d) - inertia_shift(maps, start)
    return np.moveaxis(unpack_symmetric(change.T), -1, 0)


def reaction_slope(problem: Problem, at: Within, point: Unknowns, start: Floats) -> Floats:
    """Return the derivative of the reaction by the columns of the motion, (3, m).

    By small steps of each unknown that displaces masses; of all others by the rates at both ends.
    """
    k, layout = len(problem.maps.momentum), problem.layout
    rate_by = at.motion.rate_by
    bend = bent(problem.maps, at.known[[0, -1], KNOWN_D : KNOWN_D + k], start)
    slope = bend[1] @ rate_by[-1] - bend[0] @ rate_by[0]
    here = reaction_of(problem, at, point, start)
    for error in range(len(layout.errors)):
        own = [j for j, (_, e) in enumerate(problem.errors.owner) if e == error]
        responses = np.append(at.known[:, [KNOWN_D + k + j for j in own]].ravel(),
                              at.before[[k + j for j in own]])  # fmt: skip
        if np.any(responses):
            column, size = layout.mass_errors.start + error, float(problem.errors.sd[error])
            other = off_by(problem, at, point, error, size)
            slope[:, column] = (reaction_of(problem, other, point, start) - here) / size
    return slope


def off_by(problem: Problem, at: Within, point: Unknowns, error: int, size: float) -> Within:
    """Return the motion with one error of displacement larger by ``size``, of first order."""
    k, known, before = len(problem.maps.momentum), at.known.copy(), at.before.copy()
    for j, (owner, e) in enumerate(problem.errors.owner):
        if e == error:
            known[:, KNOWN_D + owner] += size * known[:, KNOWN_D + k + j]
            before[owner] += size * before[k + j]
    column = problem.layout.mass_errors.start + error
    rate = at.motion.rate + size * at.motion.rate_by[:, :, column]
    d = known[:, KNOWN_D : KNOWN_D + k]
    travel = np.diff(d, axis=0) / np.diff(at.t)[:, None]
    travel = np.vstack([travel, travel[-1:]])  # of the step that leaves a node; the last: its own
    inertia = point.body(problem.mass).inertia_P + bent(problem.maps, d, np.zeros(k))
    momentum = np.einsum("nij,nj->ni", inertia, rate) + known[:, :3]
    momentum = momentum + travel @ problem.maps.momentum
    return at._replace(known=known, before=before, motion=at.motion._replace(momentum=momentum))
