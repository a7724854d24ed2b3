"""The unknowns of a trajectory, and how a step changes them.

Physical coordinates, in which information and covariance are stated:

    [ turn of the first attitude (3) | first rate (3) | J_P xx yy zz xy xz yz | com (3)
      | torque coefficients | displacement errors | gyro bias (3) ]

The inertia itself is kept as the six numbers of ``maths.pseudo_inertia``, so every point is a body
that can exist. Steps are sought in physical coordinates, where the residuals are nearly linear; a
step that would leave the possible bodies is sought again along their boundary

    v.Sigma_C v = floor,      d(v.Sigma_C v) = 1/2 tr dJ_P - v.dJ_P v - 2 m (v.r) v.dr

(steps in the six numbers themselves crawl when the body is nearly flat: see docs/decisions/0008).
"""

from dataclasses import dataclass, replace
from functools import lru_cache

import numpy as np

from equipoise.maths import attitude, pseudo_inertia
from equipoise.maths.levenberg_marquardt import Quadratic, scaled_solve
from equipoise.maths.linalg import pack_symmetric, unpack_symmetric
from equipoise.model.arrays import Floats, Matrix3, Quaternion, Vector3, Vector6
from equipoise.model.estimate import COM, INERTIA
from equipoise.model.mass_properties import (
    MassProperties,
    from_centre,
    parallel_axis,
    second_moments,
)
from equipoise.model.torque_terms import TERMS, unit_of

TURN, RATE, JP, R = slice(0, 3), slice(3, 6), slice(6, 12), slice(12, 15)
DOUBLE = np.array([1, 1, 1, 2, 2, 2])  # off-diagonal entries stand for two
FIXED = 15  # coordinates before torques, errors and bias


@dataclass(frozen=True, slots=True, eq=False)
class Layout:
    """Which of the optional unknowns there are."""

    terms: tuple[str, ...] = ()
    errors: tuple[str, ...] = ()
    bias: bool = False

    @property
    def size(self) -> int:
        """Return the number of unknowns."""
        return FIXED + len(self.terms) + len(self.errors) + 3 * self.bias

    @property
    def names(self) -> tuple[str, ...]:
        """Return the names in physical coordinates."""
        first = ("attitude_x", "attitude_y", "attitude_z", "rate_x", "rate_y", "rate_z")
        bias = ("gyro_bias_x", "gyro_bias_y", "gyro_bias_z") if self.bias else ()
        return (*first, *INERTIA, *COM, *self.terms, *self.errors, *bias)

    @property
    def units(self) -> tuple[str, ...]:
        """Return their units."""
        first = ("rad",) * 3 + ("rad/s",) * 3 + ("kg m2",) * 6 + ("m",) * 3
        terms = tuple(unit_of(term) for term in self.terms)
        return first + terms + ("m",) * len(self.errors) + ("rad/s",) * (3 * self.bias)

    @property
    def torque_index(self) -> list[int]:
        """Return the columns of the torques among the sixteen."""
        return [TERMS.index(term) for term in self.terms]


@dataclass(frozen=True, slots=True, eq=False)
class Unknowns:
    """One point of the search."""

    q0: Quaternion
    w0: Vector3  # rad/s
    six: Vector6  # of J_C, masses at home
    com: Vector3  # m, masses at home
    torque: Floats  # (16,)
    error: Floats  # (e,) m
    bias: Vector3  # rad/s

    def body(self, mass: float) -> MassProperties:
        """Return the mass properties with the masses at home."""
        return body_of_point(self, mass)


@lru_cache(maxsize=8)  # a step of the search asks a point for its body some ten times
def body_of_point(point: Unknowns, mass: float) -> MassProperties:
    """Return the mass properties of a point with the masses at home."""
    return from_centre(mass, point.com, pseudo_inertia.to_inertia(point.six))


def term_sizes(terms: tuple[str, ...], inertia: float, weight: float) -> Floats:
    """Return a size natural to each torque coefficient.

    For a moment of inertia (kg m^2) and a weight (N): damping in 10 s, the torque of 10 um, a sag
    of 10 um, a drift of 1 um/s.
    """
    by_group = {"viscous": 0.1 * inertia, "quadratic": inertia, "sag": 1e-5, "drift": 1e-6}
    return np.array([by_group.get(term.split("_")[0], 1e-5 * weight) for term in terms])


def physical(point: Unknowns, mass: float, layout: Layout) -> Floats:
    """Return the physical coordinates; the turn of the first attitude is zero at the point."""
    inertia = pack_symmetric(point.body(mass).inertia_P)
    bias = point.bias if layout.bias else np.zeros(0)
    torque = point.torque[layout.torque_index]
    return np.concatenate([np.zeros(3), point.w0, inertia, point.com, torque, point.error, bias])


def boundary(point: Unknowns, mass: float, layout: Layout, step: Floats) -> tuple[Floats, Floats]:
    """Return rows C and gaps d with C step = d on the boundary.

    One for each moment that a step takes below the floor; none when the step leads to a possible
    body.
    """
    inertia = point.body(mass).inertia_P
    com = point.com + step[R]
    there = inertia + unpack_symmetric(step[JP]) - parallel_axis(mass, com)
    floor = 2 * pseudo_inertia.FLOOR * float(np.trace(inertia))
    if pseudo_inertia.exceeds(second_moments(there), 0.5 * floor):
        return np.zeros((0, layout.size)), np.zeros(0)
    values, vectors = np.linalg.eigh(second_moments(there))
    beyond = vectors[:, values < 0.5 * floor].T
    rows, gaps = np.zeros((len(beyond), layout.size)), np.zeros(len(beyond))
    now = second_moments(point.body(mass).inertia_C)
    for k, v in enumerate(beyond):
        square: Matrix3 = v[:, None] * v
        rows[k, JP] = 0.5 * np.array([1, 1, 1, 0, 0, 0]) - pack_symmetric(square) * DOUBLE
        rows[k, R] = -2 * mass * (v @ point.com) * v
        gaps[k] = floor - v @ now @ v
    return rows, gaps


def possible_step(
    point: Unknowns, mass: float, layout: Layout, local: Quadratic, damping: float
) -> Floats:
    """Return the damped step to the least of the local model among possible bodies."""
    free = scaled_solve(local.normal, local.descent, damping)
    free = step = free / max(1.0, stride(free, point, mass))
    for _ in range(8):
        rows, gaps = boundary(point, mass, layout, step)
        if not len(rows):
            break
        toward = np.column_stack([scaled_solve(local.normal, row, damping) for row in rows])
        step = free + toward @ np.linalg.solve(rows @ toward, gaps - rows @ free)
    return step / max(1.0, stride(step, point, mass))


def stride(step: Floats, point: Unknowns, mass: float) -> float:
    """Return the length of a step in units beyond which no local model is to be believed.

    These are a radian, a radian a second, the body's own inertia.
    """
    size = float(np.trace(point.body(mass).inertia_P))
    parts = np.concatenate([step[TURN], step[RATE], step[JP] / size])
    return float(np.linalg.norm(parts))


def retract(point: Unknowns, step: Floats, mass: float, layout: Layout) -> Unknowns:
    """Return the point after a step in physical coordinates."""
    torque = point.torque.copy()
    n, e = len(layout.terms), len(layout.errors)
    torque[layout.torque_index] += step[FIXED : FIXED + n]
    com = point.com + step[R]
    inertia = point.body(mass).inertia_P + unpack_symmetric(step[JP])
    return replace(
        point,
        q0=attitude.normalise(attitude.multiply(point.q0, attitude.exponential(step[TURN]))),
        w0=point.w0 + step[RATE],
        six=pseudo_inertia.from_inertia(inertia - parallel_axis(mass, com)),
        com=com,
        torque=torque,
        error=point.error + step[FIXED + n : FIXED + n + e],
        bias=point.bias + step[FIXED + n + e :] if layout.bias else point.bias,
    )
