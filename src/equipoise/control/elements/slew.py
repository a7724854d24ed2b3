"""A turn from rest to rest about one axis, as a reference for the attitude control.

    angle(s) = A (10 s^3 - 15 s^4 + 6 s^5),   s = t / T        rate and acceleration begin and end 0

Its greatest rate is 15/8 A / T, its greatest acceleration 10 / sqrt(3) A / T^2. T is the shortest
that keeps both within limits, so that wheels are neither saturated nor spun up beyond their speed.
The axis is that of the shorter way, the same in body axes all along.
"""

from typing import NamedTuple

import numpy as np

from equipoise.control.elements.attitude_pid import Reference
from equipoise.control.plant.wheel_capacity import Capacity
from equipoise.maths.attitude import difference, exponential, level, multiply, to_matrix
from equipoise.model.arrays import Matrix3, Quaternion, Vector3

SLOW = 0.06  # rad/s, chosen: the fastest turn; momentum may require less
PART = 0.5  # of torque and momentum, chosen: what a turn may take of them
PEAK_RATE = 15.0 / 8.0
PEAK_ACCELERATION = 10.0 / 3.0**0.5


class Pace(NamedTuple):
    """The limits of a turn."""

    rate: float  # rad/s
    acceleration: float  # rad/s^2


class Slew(NamedTuple):
    """A turn and when it is made."""

    start: Quaternion
    turn: Vector3  # rad, in body axes
    begin: float  # s
    duration: float  # s


def moment_across(inertia_P: Matrix3, up: Vector3) -> float:
    """Return the greatest moment of inertia about an axis across ``up``, kg m^2."""
    across = np.eye(3) - np.outer(up, up)
    return float(np.linalg.eigvalsh(across @ inertia_P @ across)[-1])


def pace_for(moment: float, can: Capacity) -> Pace:
    """Return the pace that devices can make about an axis of some moment of inertia (kg m^2)."""
    return Pace(min(SLOW, PART * can.momentum / moment), PART * can.torque / moment)


def time_for(angle: float, pace: Pace) -> float:
    """Return the shortest time (s) for an angle (rad)."""
    soonest = (PEAK_ACCELERATION * angle / pace.acceleration) ** 0.5
    return max(PEAK_RATE * angle / pace.rate, soonest)


def slew(start: Quaternion, goal: Quaternion, begin: float, pace: Pace) -> Slew:
    """Return the turn from ``start`` to ``goal`` that begins at a time (s)."""
    turn = difference(goal, start)
    return Slew(start, turn, begin, time_for(float(np.linalg.norm(turn)), pace))


def levelled(q: Quaternion, up: Vector3) -> Quaternion:
    """Return the level attitude that is reached from ``q`` by the shortest turn."""
    return multiply(level(to_matrix(q) @ up), q)


def turned(base: Quaternion, turn: Vector3) -> Quaternion:
    """Return the attitude that a rotation vector (rad, body axes) leads to."""
    return multiply(base, exponential(turn))


def end_of(turn: Slew) -> float:
    """Return when the turn is made, s."""
    return turn.begin + turn.duration


def reference_at(turn: Slew, t: float) -> Reference:
    """Return where the platform should be at a time (s); before and after it, at rest."""
    T = max(turn.duration, 1e-9)
    s = min(max((t - turn.begin) / T, 0.0), 1.0)
    angle = s**3 * (10 - 15 * s + 6 * s**2)
    rate = 30 * s**2 * (1 - s) ** 2 / T
    acceleration = 60 * s * (1 - s) * (1 - 2 * s) / T**2
    q = turned(turn.start, angle * turn.turn)
    return Reference(q, rate * turn.turn, acceleration * turn.turn)
