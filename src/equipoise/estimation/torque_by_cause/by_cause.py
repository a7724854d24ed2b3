"""The chain of a fitted record, and rows of torque by cause from what is known of its stretches."""

from dataclasses import replace
from typing import NamedTuple

import numpy as np

from equipoise.dynamics.regressor import CONSTANT
from equipoise.dynamics.rigid_body import KNOWN_D
from equipoise.dynamics.timeline import SAME
from equipoise.estimation.output_error.drift_scale import scale_row
from equipoise.estimation.output_error.problem import Prior, Problem, posed
from equipoise.estimation.output_error.segment_jumps import Jump
from equipoise.estimation.output_error.solution import Fitted
from equipoise.estimation.parameters.fit_parameters import (
    CORE,
    JP,
    RATE,
    TURN,
    Layout,
    R,
    Unknowns,
    physical,
    unknowns_of,
)
from equipoise.estimation.parameters.retraction import TORQUE
from equipoise.estimation.torque_by_cause.gauss_markov import Chain, Course
from equipoise.estimation.torque_by_cause.posed_record import CARRIER
from equipoise.estimation.torque_by_cause.stretch_motion import inertia_at, known_at
from equipoise.estimation.torque_by_cause.stretch_torque import impulse_of
from equipoise.maths import pseudo_inertia
from equipoise.maths.attitude import exponential, multiply
from equipoise.maths.linalg import unpack_symmetric
from equipoise.model import torque_by_cause as cause
from equipoise.model.arrays import Floats, Ints, Matrix3, Series1, Series3, Square, Vector3
from equipoise.model.estimate import COM
from equipoise.model.estimate import RATE as RATES
from equipoise.model.mass_properties import parallel_axis

TOUCH, SHIFT = 1e-2, 1e-4  # rad/s, m, chosen: one sd of jumps; what rows tell is finer by far


class Rows(NamedTuple):
    """Mean torques over intervals, body axes, and their covariance's diagonal."""

    torque: Floats  # (n, causes, 3) N m
    variance: Floats  # (n, causes, 3)
    total: Series3  # (n, 3)
    total_variance: Series3


class Coordinates(NamedTuple):
    """How the unknowns x of a fit go with those of the chain, z (``gauss_markov``)."""

    constant: (
        Floats  # (n, n') S: the torque that an estimate calls constant acts as the carrier does
    )
    scale: Floats  # (n',) l
    carrier: Ints  # (3,)
    torque: Series3  # (K, 3) N m, of the points

    def step(self, k: int, z: Floats) -> Floats:
        """Return the step of stretch k, of first order in all but torque and scale."""
        step, c = self.constant @ z, float(self.scale @ z)
        step[self.carrier] += c * (self.torque[k] + step[self.carrier])
        return step

    def slope(self, k: int, z: Floats) -> Floats:
        """Return the derivative of the step by z, (n, n')."""
        found, c = self.constant.copy(), float(self.scale @ z)
        nu = self.torque[k] + (self.constant @ z)[self.carrier]
        found[self.carrier] = (1 + c) * found[self.carrier] + np.outer(nu, self.scale)
        return found


def coordinates_of(fitted: Fitted, up: Vector3, constant: bool) -> Coordinates:
    """Return the coordinates of the chain; ``constant``: beside a constant torque that stays."""
    layout = fitted.problem.layout
    n, carrier = layout.size, [layout.names.index(name) for name in CARRIER]
    S = np.hstack([np.eye(n), np.eye(n)[:, carrier if constant else []]])
    first = TORQUE + CONSTANT
    torque = fitted.at.pieces.points[:, first : first + 3]
    return Coordinates(
        S, scale_row(fitted.problem, fitted.point, up) @ S, np.array(carrier), torque
    )


def chain_of(fitted: Fitted, prior: Prior, by: Coordinates) -> Chain:
    """Return the stretches of a fit as a chain; the prior is of the layout's unknowns."""
    problem, pieces, layout = fitted.problem, fitted.at.pieces, fitted.problem.layout
    cuts, S, carrier = posed(problem).cuts, by.constant, by.carrier
    information = np.diag(prior.weight)
    if prior.coupling.size:
        information[CORE, CORE] += prior.coupling
    off = prior.mean - physical(fitted.point, problem.mass, layout)
    off[TURN], off[carrier] = 0.0, 0.0
    both = S.T @ information @ S
    both[carrier], both[:, carrier] = 0.0, 0.0
    zero = np.zeros(S.shape[1])
    maps = np.array([by.slope(k, zero) for k in range(len(by.torque))])
    across = np.swapaxes(maps, 1, 2)
    return Chain(
        across @ pieces.normal @ maps,
        np.einsum("knm,kn->km", maps, pieces.descent),
        pieces.onward @ maps[:-1],
        np.diff(problem.line.t[cuts.nodes])[:-1],
        carrier,
        by.torque,
        gaps_of(fitted, S.shape[1]),
        tuple(event_coordinates(jump, layout) for jump in problem.jumps),
        tuple(SHIFT if COM[0] in jump.names else TOUCH for jump in problem.jumps),
        both,
        S.T @ information @ off,
    )


def gaps_of(fitted: Fitted, size: int) -> Floats:
    """Return from each point where its motion ends, as a deviation (K - 1, size) of the next."""
    gaps = np.zeros((len(fitted.jumps), size))
    gaps[:, :6] = -fitted.jumps[:, :6]
    for k, jump in enumerate(fitted.problem.jumps):
        if COM[0] in jump.names:
            gaps[k, R] = -fitted.jumps[k, 9:12]
    return gaps


def event_coordinates(jump: Jump, layout: Layout) -> Ints:
    """Return what an event may change: the rate; or com alone, of a part that shifts."""
    names = () if not jump.is_event else COM if COM[0] in jump.names else RATES
    return np.array([layout.names.index(name) for name in names], dtype=np.int64)


def moved_point(point: Unknowns, step: Floats, problem: Problem) -> Unknowns:
    """Return a point after a step in physical coordinates."""
    layout, body = problem.layout, point.body(problem.mass)
    com, torque, sensor = point.com + step[R], point.torque.copy(), point.sensor.copy()
    inertia = body.inertia_P + unpack_symmetric(step[JP])
    torque[layout.torque_index] += step[layout.torques]
    sensor[layout.sensor_index] += step[layout.sensors]
    return replace(
        point,
        q0=multiply(point.q0, exponential(step[TURN])),
        w0=point.w0 + step[RATE],
        six=pseudo_inertia.from_inertia(inertia - parallel_axis(problem.mass, com)),
        com=com,
        torque=torque,
        sensor=sensor,
        error=point.error + step[layout.mass_errors],
        bias=point.bias + step[layout.gyro_bias] if layout.bias else point.bias,
    )


class Impulses(NamedTuple):
    """Impulses of the stretches, and where intervals begin."""

    first: Ints  # (n + 1,) the stretch with which each interval begins, and the one behind the last
    value: Floats  # (K, causes, 3) N m s
    slope: Floats  # (K, causes, 3, unknowns of the chain)


def impulses_of(fitted: Fitted, chain: Chain, by: Coordinates, begins: Series1) -> Impulses:
    """Return the impulses of all stretches, linear about the points of a fit.

    Intervals begin at ``begins`` (s); the last of these ends the last interval.
    """
    problem, cuts = fitted.problem, posed(fitted.problem).cuts
    points = [unknowns_of(flat) for flat in fitted.at.pieces.points]
    known, start = known_at(problem, points[0]), standing(problem)
    found = [
        impulse_of(problem, known, slice(int(a), int(b) + 1), point, start)
        for a, b, point in zip(cuts.nodes, cuts.nodes[1:], points, strict=False)
    ]
    zero = np.zeros(by.constant.shape[1])
    slope = np.array([each.slope @ by.slope(k, zero) for k, each in enumerate(found)])
    first = np.searchsorted(problem.line.t[cuts.nodes], begins - SAME)
    out = Impulses(first, np.array([each.value for each in found]), slope)
    inertia = inertia_at(problem, points[0], start)
    for k, changed in enumerate(chain.events):
        if RATE.start in changed:
            add_contact(out, k, inertia, -chain.gaps[k, RATE], chain.onward[k, RATE])
    return out


def steps_of(by: Coordinates, mean: Floats) -> Floats:
    """Return the steps of all stretches in the unknowns of the fit, (K, n), of first order."""
    zero = np.zeros(by.constant.shape[1])
    return np.array([by.slope(k, zero) @ each for k, each in enumerate(mean)])


def points_at(fitted: Fitted, by: Coordinates, at: Floats) -> list[Unknowns]:
    """Return where all stretches begin, off by deviations (K, n') of the chain's unknowns."""
    return [
        moved_point(unknowns_of(flat), by.step(k, at[k]), fitted.problem)
        for k, flat in enumerate(fitted.at.pieces.points)
    ]


def standing(problem: Problem) -> Floats:
    """Return where the masses stand (m) when the record begins."""
    return problem.line.known[0, KNOWN_D : KNOWN_D + len(problem.maps.momentum)]


def add_contact(
    impulses: Impulses, k: int, inertia: Matrix3, jump: Floats, rate_onward: Floats
) -> None:
    """Add the impulse J (w behind - w before) of a contact at inner cut k; w jumps by ``jump``."""
    impulses.value[k + 1, cause.CONTACTS] += inertia @ jump
    impulses.slope[k + 1, cause.CONTACTS][:, RATE] += inertia
    impulses.slope[k, cause.CONTACTS] -= inertia @ rate_onward


def rows_of(impulses: Impulses, course: Course, interval: float) -> Rows:
    """Return mean torques given all rows."""
    first, n = impulses.first, len(impulses.first) - 1
    torque, variance = np.zeros((2, n, len(cause.CAUSES), 3))
    total_variance = np.zeros((n, 3))
    values = impulses.value + np.einsum("kcij,kj->kci", impulses.slope, course.mean)
    for k in range(n):
        a, b = int(first[k]), int(first[k + 1])
        torque[k] = values[a:b].sum(axis=0)
        variance[k], total_variance[k] = spread_of(impulses.slope[a:b], course, a)
    total = torque.sum(axis=1)
    return Rows(torque / interval, variance / interval**2, total / interval,
                total_variance / interval**2)  # fmt: skip


def spread_of(slope: Floats, course: Course, a: int) -> tuple[Floats, Vector3]:
    """Return the variance of impulses of neighbouring stretches from ``a`` on, and of their sum."""
    onto, parts = slope[-1], list[tuple[Floats, Square]]()
    for j in range(len(slope) - 2, -1, -1):
        parts.append((onto, course.fresh[a + j]))
        onto = slope[j] + onto @ course.onward[a + j]
    parts.append((onto, course.covariance[a]))
    each = sum((np.einsum("cij,jl,cil->ci", D, C, D, optimize=True) for D, C in parts),
               np.zeros(onto.shape[:2]))  # fmt: skip
    whole = [(D.sum(axis=0), C) for D, C in parts]
    return each, sum((np.einsum("ij,jl,il->i", D, C, D) for D, C in whole), np.zeros(3))
