"""One problem for many records: what is measured differs, times and known inputs do not.

For Monte Carlo studies, whose fits would else take longer around a kernel than in it. Of two first
points each record takes the one whose motion is nearer to its rows, as a fit alone does.
"""

from typing import NamedTuple

import numpy as np

from equipoise.dynamics.sensitivities import Inputs
from equipoise.estimation.output_error.kernels.gauss_newton import descend
from equipoise.estimation.output_error.kernels.normal_equations import (
    Measurements,
    Pass,
    accumulate,
    pass_for,
)
from equipoise.estimation.output_error.kernels.record_pass import Posed, local_for
from equipoise.estimation.parameters.retraction import (
    COM,
    ERROR,
    SENSOR,
    SIX,
    W,
    away,
    body_at_point,
    plus,
    six_at,
)
from equipoise.maths.kernels.compiled import kernel, part
from equipoise.maths.kernels.copying import copy_values
from equipoise.maths.levenberg_marquardt import FIRST, GROWTH
from equipoise.maths.pseudo_inertia import six_of
from equipoise.maths.turns import turned
from equipoise.model.arrays import Bools, Floats, Ints


class Descents(NamedTuple):
    """Where the descents of k records ended."""

    points: Floats  # (k, ...)
    normal: Floats  # (k, n, n) A, data and priors, in physical coordinates
    cost: Floats  # (k,) half the sum of squares; infinite where none was begun
    converged: Bools  # (k,)
    evaluations: Ints  # (k,)


class Blind(NamedTuple):
    """The problem without unknowns, whose pass costs a fraction of that with them."""

    inputs: Inputs  # without columns
    observed: Measurements  # without rows of the gyro


@kernel
def points_at(bodies: Floats, motions: Floats, mass: float, ahead: float, size: int) -> Floats:
    """Return two first points of each record (k, 2, size): by momentum, and as measured.

    ``bodies`` (k, 9) are J and com; ``motions`` (k, 10) the first row's attitude, its rate, and the
    rate by momentum. The motion begins ``ahead`` seconds after that row. All else is zero.
    """
    points = np.zeros((bodies.shape[0], 2, size))
    for k in range(bodies.shape[0]):
        com = (bodies[k, 6], bodies[k, 7], bodies[k, 8])
        six = six_of(plus(six_at(bodies[k], 0), away(mass, com), -1.0))
        for c in range(2):
            point, w = points[k, c], motions[k, 7:] if c == 0 else motions[k, 4:7]
            point[0], point[1], point[2], point[3] = turned(
                motions[k], ahead * w[0], ahead * w[1], ahead * w[2]
            )
            for j in range(3):
                point[W + j], point[COM + j] = w[j], com[j]
            for j in range(6):
                point[SIX + j] = six[j]
    return points


@kernel
def measured(o: Measurements, attitude: Floats, rate: Floats) -> Measurements:
    """Return other measurements at the same times."""
    return Measurements(attitude, o.attitude_node, o.attitude_share, o.attitude_sd,
                        o.attitude_spread, rate, o.rate_node, o.rate_share, o.rate_sd,
                        o.rate_spread, o.forward, o.terms, o.vectors)  # fmt: skip


@kernel
def observing(posed: Posed, attitude: Floats, rate: Floats) -> Posed:
    """Return the problem with other measurements at the same times."""
    own = measured(posed.observed, attitude, rate)
    return Posed(posed.mass, posed.gravity, posed.maps, posed.t, posed.known, posed.owners,
                 posed.columns, own, posed.limit, posed.mean, posed.weight, posed.coupling,
                 posed.held, posed.slots, posed.cuts, posed.parts)  # fmt: skip


@part
def rms_of(left: Floats, sd: float) -> float:
    """Return the rms residual vector, rad; infinite where it is no number."""
    total = 0.0
    for i in range(left.shape[0]):
        total += left[i, 0] * left[i, 0] + left[i, 1] * left[i, 1] + left[i, 2] * left[i, 2]
    found = sd * (total / left.shape[0]) ** 0.5
    return found if np.isfinite(found) else np.inf


@kernel
def misfit_at(
    blind: Blind, mass: float, gravity: float, attitude: Floats, point: Floats, work: Pass,
    left: Floats,
) -> float:  # fmt: skip
    """Return how far a point's motion is from the camera's rows, rms in rad; no errors of masses.

    ``work`` and ``left`` are worked in.
    """
    inputs, own = blind.inputs, measured(blind.observed, attitude, blind.observed.rate)
    body, nodes = body_at_point(point, mass, gravity), (0, inputs.t.shape[0] - 1)
    accumulate(body, inputs, point[:W], point[W : W + 3], point[SENSOR:ERROR], point[-3:], own,
               0.0, nodes, (0, 0, 0), work, left, left, left)  # fmt: skip
    return rms_of(left, own.attitude_sd)


@kernel
def settle_each(
    posed: Posed, blind: Blind, attitudes: Floats, rates: Floats, points: Floats, near: float,
    most: int, out: Descents,
) -> None:  # fmt: skip
    """Write where the descent of each record ends, from the nearer of its two points (k, 2, p).

    None is begun from a point whose motion is more than ``near`` (rad) from the rows.
    """
    descent, left = np.empty(posed.slots.shape[0]), np.empty((attitudes.shape[1], 3))
    work, mass, gravity = pass_for(0, 1), posed.mass, posed.gravity
    for k in range(attitudes.shape[0]):
        one = misfit_at(blind, mass, gravity, attitudes[k], points[k, 0], work, left)
        other = misfit_at(blind, mass, gravity, attitudes[k], points[k, 1], work, left)
        best = local_for(posed, points[k, 1 if other < one else 0])
        out.cost[k], out.converged[k], out.evaluations[k] = np.inf, False, 0
        if min(one, other) <= near:
            own = observing(posed, attitudes[k], rates[k])
            ended = descend(own, best, most, out.normal[k], descent, FIRST, GROWTH)
            out.cost[k], out.converged[k] = ended.cost, ended.converged
            out.evaluations[k] = ended.evaluations
        copy_values(best.point, out.points[k])
