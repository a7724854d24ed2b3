"""The models of published filters, linearised along a motion.

    J w' = -w x (J w + h) - h' - [g x] mu + tau            g = g_B, mu = m r, J and mu masses moved

    dw'/dw  = J^-1 ([(J w + h) x] - [w x] J)
    dw'/dp  = -J^-1 Y(w, w')         Y = W(w') + [w x] W(w),  p = J xx yy zz xy xz yz, masses home
    dw'/dmu = -J^-1 [g x],           dw'/dr = m dw'/dmu
    dw'/dth = J^-1 [mu x][g x],      dth' = -w x dth + dw               (attitude sought, not given)

(da Silva 2021 Eqs. 33-38 with errata R14-R18; Ivanov 2021 Eq. 5.1 as corrected.) w' is that of
the filter's own model: a torque that moves the platform but is not in the model must not seem
to fix the scale. Known are the displacements of masses, momentum stored in wheels, outside
torque, and but for the filter that seeks it the attitude. Masses are taken to carry no momentum of
their own while they travel.

The simplified model (da Silva 2021 Eqs. 28-31, R11-R13) leaves out gyroscopic terms and products:

    w_k+1 = w_k + Phi_k r,     Phi_k = -(m T / 2) J_diag^-1 ([g_k x] + [g_k+1 x])
    [E 0; E Phi_0; E Phi_0 + Phi_1; ...] [w_0; r] = [w_0; w_1; w_2; ...]          corrected Eq. 31

Printed as [E 0; E 0] and called observable. A single Phi is J^-1 times a skew matrix and so of rank
2: with one attitude the stack has rank 5, and 6 takes two that differ in where gravity points.
"""

from typing import NamedTuple

import numpy as np

from equipoise.actuators.sliding_masses import MassMaps, inertia_shift
from equipoise.dynamics.propagation import Motion
from equipoise.dynamics.rigid_body import KNOWN_D, KNOWN_WARMTH
from equipoise.dynamics.timeline import Timeline
from equipoise.maths.attitude import to_matrix
from equipoise.maths.linalg import pack_symmetric, unpack_symmetric
from equipoise.model.arrays import Floats, Matrix3, Series1, Series3
from equipoise.model.mass_properties import MassProperties

ELEMENTS = np.array([unpack_symmetric(row) for row in np.eye(6)])  # dJ / dp
LEVI_CIVITA = np.zeros((3, 3, 3))
LEVI_CIVITA[[0, 1, 2], [1, 2, 0], [2, 0, 1]] = 1.0
LEVI_CIVITA[[0, 2, 1], [2, 1, 0], [1, 0, 2]] = -1.0


class Course(NamedTuple):
    """A motion as filters know it, at the start, middle and end of each of n steps."""

    step: Series1  # (n,) s
    mass: float
    rate: Floats  # (n, 3, 3) rad/s
    gravity: Floats  # (n, 3, 3) m/s^2, body axes
    inertia: Floats  # (n, 3, 3, 3) kg m^2 about P, masses as they stand
    moment: Floats  # (n, 3, 3) kg m
    momentum: Floats  # (n, 3, 3) N m s, stored
    momentum_rate: Floats  # (n, 1, 3) N m
    torque: Floats  # (n, 3, 3) N m


def course_of(
    line: Timeline, motion: Motion, body: MassProperties, maps: MassMaps, gravity: float
) -> Course:
    """Return the course of a motion at every half step."""
    known, k = line.known, len(maps.momentum)
    d = known[:, KNOWN_D : KNOWN_D + k]
    six = pack_symmetric(body.inertia_P)
    inertia = np.array([unpack_symmetric(six + inertia_shift(maps, row)) for row in d])
    step, stored = line.t[2::2] - line.t[:-2:2], known[:, :3]
    return Course(
        step,
        body.mass,
        in_thirds(motion.rate),
        in_thirds(-gravity * to_matrix(motion.q)[:, 2, :]),
        in_thirds(inertia),
        in_thirds(body.first_moment + d @ maps.first_moment),
        in_thirds(stored),
        ((stored[2::2] - stored[:-2:2]) / step[:, None])[:, None],
        in_thirds(known[:, 3:KNOWN_WARMTH]),
    )


def in_thirds(series: Floats) -> Floats:
    """Return what is known at half steps as start, middle and end of each step."""
    return np.stack([series[:-2:2], series[1:-1:2], series[2::2]], axis=1)


def cross_matrix(vectors: Floats) -> Floats:
    """Return [a x] of each vector."""
    return -np.einsum("ijk,...k->...ij", LEVI_CIVITA, vectors)


def momentum_columns(w: Floats) -> Floats:
    """Return W(w) of each rate, so that J w = W p."""
    return np.einsum("kij,...j->...ik", ELEMENTS, w)


def times(matrices: Floats, vectors: Floats) -> Floats:
    """Return M v of each."""
    return np.einsum("...ij,...j->...i", matrices, vectors)


def momentum_of(course: Course) -> Floats:
    """Return J w + h."""
    return times(course.inertia, course.rate) + course.momentum


def divided(course: Course, columns: Floats) -> Floats:
    """Return J^-1 times columns."""
    return np.linalg.solve(course.inertia, columns).astype(np.float64, copy=False)


def acceleration(course: Course) -> Floats:
    """Return w' of the model, rad/s^2."""
    left = times(cross_matrix(course.moment), course.gravity) + course.torque
    left = left - times(cross_matrix(course.rate), momentum_of(course)) - course.momentum_rate
    return divided(course, left[..., None])[..., 0]


def by_rate(course: Course) -> Floats:
    """Return dw'/dw."""
    turned = cross_matrix(momentum_of(course)) - cross_matrix(course.rate) @ course.inertia
    return divided(course, turned)


def by_inertia(course: Course) -> Floats:
    """Return dw'/dp, (n, 3, 3, 6)."""
    columns = momentum_columns(acceleration(course))
    columns += cross_matrix(course.rate) @ momentum_columns(course.rate)
    return -divided(course, columns)


def by_moment(course: Course) -> Floats:
    """Return dw'/dmu."""
    return -divided(course, cross_matrix(course.gravity))


def by_turn(course: Course) -> Floats:
    """Return dw'/dth."""
    twice = cross_matrix(course.moment) @ cross_matrix(course.gravity)
    return divided(course, twice)


def rate_com(course: Course) -> Floats:
    """Return the model of state [w, r]: slopes of w, (n, 3, 3, 6)."""
    return np.concatenate([by_rate(course), course.mass * by_moment(course)], axis=-1)


def rate_vertical(course: Course) -> Floats:
    """Return the model of state [w, r_z]: slopes of w, (n, 3, 3, 4)."""
    return rate_com(course)[..., [0, 1, 2, 5]]


def rate_inertia_moment(course: Course) -> Floats:
    """Return the model of state [w, J, mu]: slopes of w, (n, 3, 3, 12)."""
    return np.concatenate([by_rate(course), by_inertia(course), by_moment(course)], axis=-1)


def attitude_rate_com(course: Course) -> Floats:
    """Return the model of state [attitude, w, r]: slopes of attitude and w, (n, 3, 6, 9)."""
    still = np.zeros_like(course.inertia)
    turns = np.concatenate([-cross_matrix(course.rate), still + np.eye(3), still], axis=-1)
    rates = np.concatenate([by_turn(course), rate_com(course)], axis=-1)
    return np.concatenate([turns, rates], axis=-2)


def simplified_stack(gravity: Series3, inertia: Matrix3, mass: float, step: Series1) -> Floats:
    """Return the corrected Eq. 31 for gravity at N rows (m/s^2) that are ``step`` (s) apart.

    Shape (N, 3, 6).
    """
    both = cross_matrix(gravity[1:] + gravity[:-1]) / np.diag(inertia)[:, None]
    phi = -0.5 * mass * step[:, None, None] * both
    sums = np.concatenate([np.zeros((1, 3, 3)), np.cumsum(phi, axis=0)])
    return np.concatenate([np.tile(np.eye(3), (len(sums), 1, 1)), sums], axis=-1)
