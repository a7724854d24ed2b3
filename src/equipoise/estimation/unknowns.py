"""The unknowns of a trajectory, and how a step changes them.

Physical coordinates, in which information and covariance are stated:

    [ turn of the first attitude (3) | first rate (3) | J_P xx yy zz xy xz yz | com (3)
      | torque coefficients | displacement errors | gyro bias (3) ]

Free coordinates, in which steps are taken, replace J_P by the six numbers of
``maths.pseudo_inertia``, so that every step leads to a body that can exist:

    dJ_P = (dJ_C/d six) dsix + m (2 r.dr E - r dr^T - dr r^T)
"""

from dataclasses import dataclass, replace

import numpy as np

from equipoise.maths import attitude, pseudo_inertia
from equipoise.maths.linalg import pack_symmetric
from equipoise.model.arrays import Floats, Quaternion, Square, Vector3, Vector6
from equipoise.model.estimate import COM, INERTIA
from equipoise.model.mass_properties import MassProperties, from_centre
from equipoise.model.torque_terms import TERMS, unit_of

TURN, RATE, JP, R = slice(0, 3), slice(3, 6), slice(6, 12), slice(12, 15)
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
        first = ("turn_x", "turn_y", "turn_z", "rate_x", "rate_y", "rate_z")
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
        return from_centre(mass, self.com, pseudo_inertia.to_inertia(self.six))


def physical(point: Unknowns, mass: float, layout: Layout) -> Floats:
    """Return the physical coordinates; the turn of the first attitude is zero at the point."""
    inertia = pack_symmetric(point.body(mass).inertia_P)
    bias = point.bias if layout.bias else np.zeros(0)
    torque = point.torque[layout.torque_index]
    return np.concatenate([np.zeros(3), point.w0, inertia, point.com, torque, point.error, bias])


def chain(point: Unknowns, mass: float, layout: Layout) -> Square:
    """Return d(physical)/d(free), a square matrix."""
    matrix = np.eye(layout.size)
    matrix[JP, JP] = pseudo_inertia.jacobian(point.six)
    for k in range(3):
        unit = np.eye(3)[k]
        cross = np.outer(point.com, unit)
        change = mass * (2 * point.com[k] * np.eye(3) - cross - cross.T)
        matrix[JP, R.start + k] = pack_symmetric(change)
    return matrix


def retract(point: Unknowns, step: Floats, layout: Layout) -> Unknowns:
    """Return the point after a step in free coordinates."""
    torque = point.torque.copy()
    n, e = len(layout.terms), len(layout.errors)
    torque[layout.torque_index] += step[FIXED : FIXED + n]
    six_step = step[JP].copy()
    six_step[:3] = np.clip(six_step[:3], -1.0, 1.0)  # at most a factor e at a time
    return replace(
        point,
        q0=attitude.normalise(attitude.multiply(point.q0, attitude.exponential(step[TURN]))),
        w0=point.w0 + step[RATE],
        six=point.six + six_step,
        com=point.com + step[R],
        torque=torque,
        error=point.error + step[FIXED + n : FIXED + n + e],
        bias=point.bias + step[FIXED + n + e :] if layout.bias else point.bias,
    )
