"""The impulse of each cause over one stretch of a record, and how it goes with the unknowns.

    I_c = int T_c p_c dt            T_c: columns of the one regressor, p_c: their coefficients

    gravity  -[g_B x] (m r + sum m_i d_i(t_0) u_i)
    moves    -[g_B x] sum m_i (d_i - d_i(t_0)) u_i, less the reaction (``move_reaction``)
    others   terms of ``model.torque_terms``, group by group

The sum of all causes is the change of J(t_0) w, with int w x J(t_0) w, wheels and known torque
apart. Integrals are Simpson's, a step of the motion each. Attitude and rate within the stretch go
with the unknowns as the propagator says.
"""

from typing import NamedTuple

import numpy as np

from equipoise.dynamics.regressor import (
    DRIFT,
    MOMENT,
    N_TORQUES,
    SAG,
    THERMAL,
    TORQUE,
    VISCOUS,
    WIDTH,
)
from equipoise.dynamics.rigid_body import KNOWN_D, KNOWN_WARMTH
from equipoise.estimation.output_error.problem import Problem
from equipoise.estimation.parameters.fit_parameters import R, Unknowns
from equipoise.estimation.regression.formulations.columns import regressor_rows
from equipoise.estimation.torque_by_cause.move_reaction import reaction_of, reaction_slope
from equipoise.estimation.torque_by_cause.stretch_motion import Within, followed
from equipoise.model import torque_by_cause as cause
from equipoise.model.arrays import Floats, Series3

BLOCKS: dict[int, list[int]] = {
    cause.GRAVITY: [*range(MOMENT, TORQUE)],
    cause.SAG: [TORQUE + k for k in range(SAG, DRIFT)],
    cause.DRIFT: [TORQUE + k for k in range(DRIFT, THERMAL)],
    cause.WARMTH: [TORQUE + k for k in range(THERMAL, N_TORQUES)],
    cause.AIR: [TORQUE + k for k in range(VISCOUS, SAG)],
}
EPS = 1e-4  # rad, and rad/s, chosen: central differences of columns that are at most quadratic


class Impulse(NamedTuple):
    """The impulse of every cause, N m s, and its derivative by the unknowns of the stretch."""

    value: Floats  # (causes, 3)
    slope: Floats  # (causes, 3, n)


def impulse_of(
    problem: Problem, known: Floats, nodes: slice, point: Unknowns, start: Floats
) -> Impulse:
    """Return the impulse of every cause over a stretch; masses stood at ``start`` (m) at first."""
    at, maps = followed(problem, known, nodes, point), problem.maps
    shift = (at.known[:, KNOWN_D : KNOWN_D + len(maps.momentum)] - start) @ maps.first_moment
    columns, p = (regressors(problem, at, at.g, at.motion.rate),
                  coefficients(problem, point, start))  # fmt: skip
    value = np.einsum("n,cnj->cj", at.weights, torques(columns, p, shift, at.g))
    slope = slope_of(problem, at, columns, by_state(problem, at, p, shift))
    value[cause.MOVES] -= reaction_of(problem, at, point, start)
    reaction = reaction_slope(problem, at, point, start)
    slope[cause.MOVES, :, : reaction.shape[1]] -= reaction
    return Impulse(value, slope)


def regressors(problem: Problem, at: Within, g: Series3, w: Series3) -> Floats:
    """Return the regressor at every node, (N, 3, 28)."""
    found, mass = np.zeros((len(at.t), 3, WIDTH)), problem.mass
    warmth = np.ascontiguousarray(at.known[:, KNOWN_WARMTH])
    regressor_rows(np.ascontiguousarray(w), np.ascontiguousarray(g), at.t, warmth, mass,
                   problem.gravity, found)  # fmt: skip
    begin = at.t[0]  # from which the rows count time
    found[:, :, TORQUE + DRIFT : TORQUE + THERMAL] += mass * begin * found[:, :, MOMENT:TORQUE]
    return found


def coefficients(problem: Problem, point: Unknowns, start: Floats) -> Floats:
    """Return the coefficients of the regressor, (28,); masses as at the start (m)."""
    found = np.zeros(WIDTH)
    found[MOMENT:TORQUE] = problem.mass * point.com + start @ problem.maps.first_moment
    found[TORQUE:] = point.torque
    return found


def torques(columns: Floats, p: Floats, shift: Series3, g: Series3) -> Floats:
    """Return the torque of each cause at every node, (causes, N, 3), reactions of moves aside."""
    found = np.zeros((len(cause.CAUSES), len(g), 3))
    for k, block in BLOCKS.items():
        found[k] = columns[:, :, block] @ p[block]
    found[cause.MOVES] = np.cross(shift, g)
    return found


def by_state(problem: Problem, at: Within, p: Floats, shift: Series3) -> Floats:
    """Return the derivative of the torques by attitude and rate, (causes, N, 3, 6)."""
    found = np.zeros((len(cause.CAUSES), len(at.t), 3, 6))
    for j, axis in enumerate(np.eye(3)):
        turned, faster = EPS * np.cross(at.g, axis), EPS * np.tile(axis, (len(at.t), 1))
        for column, dg, dw in ((j, turned, 0 * faster), (3 + j, 0 * turned, faster)):
            ends = [
                torques(regressors(problem, at, at.g + s * dg, at.motion.rate + s * dw), p,
                        shift, at.g + s * dg)
                for s in (1, -1)
            ]  # fmt: skip
            found[..., column] = (ends[0] - ends[1]) / (2 * EPS)
    return found


def slope_of(problem: Problem, at: Within, columns: Floats, state: Floats) -> Floats:
    """Return the derivative of the impulses by the unknowns, (causes, 3, n)."""
    layout, k = problem.layout, len(problem.maps.momentum)
    found = np.zeros((len(cause.CAUSES), 3, layout.size))
    moved = np.concatenate([at.motion.turn_by, at.motion.rate_by], axis=1)
    found[:, :, : moved.shape[2]] = np.einsum("n,cnij,njm->cim", at.weights, state, moved)
    integral = np.einsum("n,njm->jm", at.weights, columns)
    found[cause.GRAVITY][:, R] += problem.mass * integral[:, MOMENT:TORQUE]
    for column, term in enumerate(layout.torque_index, layout.torques.start):
        owner = next(c for c, block in BLOCKS.items() if TORQUE + term in block)
        found[owner, :, column] += integral[:, TORQUE + term]
    for j, (owner, error) in enumerate(problem.errors.owner):
        response = at.known[:, KNOWN_D + k + j]
        push = np.cross(problem.maps.first_moment[owner], at.g)
        found[cause.MOVES, :, layout.mass_errors.start + error] += (at.weights * response) @ push
    return found
