"""The motion within one stretch of a record, with its sensitivities to the unknowns of the stretch.

A stretch begins at a node as the step that ends there sees it (``record_pass``). The propagator
begins as the step that leaves it does. Where a mass starts or stops just there, the momentum of
travel h goes over into the rate:

    w_leaving = w_arriving + J^-1 (h_arriving - h_leaving)

and an error of displacement whose response bends there changes it likewise.
"""

from typing import NamedTuple

import numpy as np

from equipoise.actuators.sliding_masses import inertia_shift
from equipoise.dynamics.propagation import Motion, body_of, propagate
from equipoise.dynamics.regressor import DRIFT, THERMAL
from equipoise.dynamics.rigid_body import KNOWN_D
from equipoise.estimation.output_error.problem import Problem
from equipoise.estimation.parameters.fit_parameters import RATE, R, Unknowns
from equipoise.maths.attitude import to_matrix
from equipoise.maths.linalg import pack_symmetric, unpack_symmetric
from equipoise.model.arrays import Floats, Matrix3, Series1, Series3
from equipoise.model.torque_terms import GROUPS


class Within(NamedTuple):
    """The motion within a stretch, with a node in the middle of each step."""

    t: Series1  # (N,) s since the record began
    known: Floats  # (N, ...) inputs, masses where they really are
    motion: Motion
    g: Series3  # m/s^2
    weights: Series1  # (N,) s, Simpson's
    before: Floats  # (k + f,) travel (m/s) and responses (1/s) of the step before the stretch


def simpson(t: Series1) -> Series1:
    """Return the weights (s) of nodes of which every second is the middle of a step."""
    h, weights = t[2::2] - t[:-2:2], np.zeros(len(t))
    weights[:-2:2] += h / 6
    weights[2::2] += h / 6
    weights[1::2] += 4 * h / 6
    return weights


def halved(values: Floats) -> Floats:
    """Return rows with the mean of neighbours between them."""
    out = np.zeros((2 * len(values) - 1, *values.shape[1:]))
    out[::2], out[1::2] = values, 0.5 * (values[1:] + values[:-1])
    return out


def known_at(problem: Problem, point: Unknowns) -> Floats:
    """Return the known inputs at the nodes, with the masses where they really are."""
    known, errors = problem.line.known.copy(), problem.errors
    first = KNOWN_D + len(problem.maps.momentum)
    for j, (owner, error) in enumerate(errors.owner):
        known[:, KNOWN_D + owner] += point.error[error] * known[:, first + j]
    return known


def travel_of(problem: Problem, known: Floats, i: int) -> Floats:
    """Return how fast displacements and responses change in step i; at rest before the record."""
    t = problem.line.t
    if i < 0:
        return 0.0 * known[0, KNOWN_D:]
    change: Floats = np.diff(known[i : i + 2, KNOWN_D:], axis=0).reshape(-1)
    return change / float(t[i + 1] - t[i])


def inertia_at(problem: Problem, point: Unknowns, d: Floats) -> Matrix3:
    """Return the inertia about P with the masses at displacements d (m)."""
    return point.body(problem.mass).inertia_P + unpack_symmetric(inertia_shift(problem.maps, d))


def followed(problem: Problem, known: Floats, nodes: slice, point: Unknowns) -> Within:
    """Return the motion of a stretch that begins at a point."""
    line, mass, i = problem.line, problem.mass, int(nodes.start)
    t, inputs = halved(line.t[nodes]), halved(known[nodes])
    since, body = t[0] - line.t[0], point.body(problem.mass)
    moment = body.first_moment + mass * since * point.torque[DRIFT:THERMAL]
    rigid = body_of(mass, problem.gravity, pack_symmetric(body.inertia_P), moment, point.torque)
    before = travel_of(problem, known, i - 1)
    turned_over = rates_taken_over(problem, point, known[i], before - travel_of(problem, known, i))
    k = len(problem.maps.momentum)
    own = line._replace(t=t, known=inputs)
    w0 = point.w0 + turned_over[:, :k].sum(axis=1)
    motion = propagate(rigid, problem.maps, own, point.q0, w0, problem.columns)
    for by in (motion.turn_by, motion.rate_by):
        for j, column in drift_columns(problem):  # whose time counts from the stretch's begin
            by[:, :, column] += mass * since * by[:, :, R.start + j]
        for j, (_, error) in enumerate(problem.errors.owner):
            column = problem.layout.mass_errors.start + error
            by[:, :, column] += by[:, :, RATE] @ turned_over[:, k + j]
        by[:, :, R] *= mass
    g = -problem.gravity * to_matrix(motion.q)[:, 2, :]
    return Within(t - line.t[0], inputs, motion, g, simpson(t), before)


def rates_taken_over(problem: Problem, point: Unknowns, known: Floats, change: Floats) -> Floats:
    """Return J^-1 m rho x u times a change of travel, by masses and by responses, (3, k + f)."""
    k, maps = len(problem.maps.momentum), problem.maps
    owners = [*range(k), *(int(owner) for owner, _ in problem.errors.owner)]
    h = change[:, None] * maps.momentum[owners] if owners else np.zeros((0, 3))
    inertia = inertia_at(problem, point, known[KNOWN_D : KNOWN_D + k])
    return np.linalg.solve(inertia, h.T).astype(np.float64, copy=False)


def drift_columns(problem: Problem) -> list[tuple[int, int]]:
    """Return the axes along which the centre of mass drifts, with their unknowns."""
    names, terms = problem.layout.names, GROUPS["drift"]
    return [(j, names.index(term)) for j, term in enumerate(terms) if term in names]
