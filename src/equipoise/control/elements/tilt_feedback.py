"""Feedback to sliding masses that levels a platform and stops its swinging (Chesi 2014, step 1).

Masses give torque across gravity only. With Phi = -m [g_b x], so that gravity's torque is Phi r,
w_p the rate across gravity and rh the estimate of r (da Silva 2021 Eqs. 39-41 with errata R20-R23:
the torques of gravity and of the masses, an adaptation gain gamma, |g|^2 and not |g|):

    J w' + w x J w = Phi r + tau_c
    tau_c = -Phi rh - k_p w_p                      shift = (g_b x tau_c) / (m |g|^2)
    rh'   = gamma Phi^T w + gamma m w_i P_up g_b                P_up = E - up up^T

As published w_i = 0. Then V = w J w / 2 + |r - rh|^2 / (2 gamma) has V' = -k_p |w_p|^2, and since
g_b' = g_b x w, Phi^T w is m g_b': the so-called estimate is

    rh(t) = rh(0) + gamma m (g_b(t) - g_b(0))

a function of the present tilt and nothing else. Here rh takes the measured increments of g_b, so
that this holds between samples, too, and nothing winds up however late the masses are. rh(0) is
free. Printed as 0, it leaves |r_up| times the tilt at which the law began. With

    rh(0) = prior + gamma m (g_b(0) + g up)

it ends as if it had begun level; the second term, X times the tilt, is ``owed`` and added no faster
than masses follow. To first order about level, with tilt a = P_up g_b / g,

    a'' = (m g / J) (r + shift) - w_z^2 a,    shift = -rh - (k_p / m g) a',    w_z^2 = -m g r_up / J

so the law is a proportional and differential one: w_a^2 = gamma (m g)^2 / J, k_p = 2 zeta w_a J.
Published copies have gamma = 1 s^2/kg, which is w_a = 280 rad/s and diverges. Here w_a is given
and gamma = J (w_a / (m g))^2, J the mean moment across up. The platform comes to rest with
r - rh along g_b; with X = gamma m g = w_a^2 J / (m g)

    tilt   |r_xy| / (|r_up| + X)
    left   |r_xy| |r_up| / (|r_up| + X)            (R23: said to be nothing)

With w_i > 0, rad/s, rh has an integral of the tilt. Rest is where rh' = 0, at a = 0: no offset is
left. The characteristic polynomial and Routh's condition are

    s^3 + 2 zeta w_a s^2 + (w_a^2 + w_z^2) s + w_i w_a^2
    2 zeta w_a (w_a^2 + w_z^2) > w_i w_a^2

Sampled every T with the shift held between, without w_i and w_z: w_a T < 1/zeta and < 4 zeta
(Jury). Masses of speed v (of the centre of mass) fall behind an offset r when w_a r > v, about;
see SPEED. The swing on the way reaches r / X, so w_a has a least value, too: the tilt limit. Where
the least is above the most the law cannot be stable, and ``frequency_for`` raises InputError.
"""

from typing import NamedTuple

import numpy as np

from equipoise.control.plant import offset_bounds as offsets
from equipoise.maths.linalg import cross
from equipoise.model.arrays import Floats, Vector3
from equipoise.model.testbed import Testbed

ZETA = 1.0  # chosen: no overshoot; the k_p = 0.5 N m s of published copies at w_a = 1 rad/s
SPEED = 0.5  # chosen: w_a |r| / v; up to 1 it is as if masses were at once, from 2 it falls
TILTED = 0.8  # of the tilt limit, chosen: what a swing may take
UPRIGHT = 0.5  # of w_a^2, chosen: what an inverted pendulum may take of it
INTEGRAL = 0.25  # of w_a, chosen: w_i; 2 is the limit


class Gains(NamedTuple):
    """The gains, and the platform that they are for."""

    mass: float  # kg
    gravity: float  # m/s^2
    up: Vector3
    gamma: float  # s^2/kg
    damping: float  # N m s, k_p
    integral: float  # rad/s, w_i
    period: float  # s


def gains_at(testbed: Testbed, frequency: float, integral: float, period: float) -> Gains:
    """Return the gains for a closed loop of that frequency w_a (rad/s)."""
    m, g, J = testbed.body.mass, testbed.gravity, offsets.level_inertia(testbed)
    gamma = J * (frequency / (m * g)) ** 2
    return Gains(m, g, testbed.up, gamma, 2 * ZETA * frequency * J, integral, period)


def frequency_of(gains: Gains, testbed: Testbed) -> float:
    """Return w_a (rad/s)."""
    return gains.damping / (2 * ZETA * offsets.level_inertia(testbed))


def owed(gains: Gains, gravity: Vector3) -> Vector3:
    """Return the term of rh(0) (m) with which the law ends as if it had begun level."""
    return gains.gamma * gains.mass * (gravity + gains.gravity * gains.up)


def followed(gains: Gains, held: Vector3, before: Vector3, now: Vector3, wait: bool) -> Vector3:
    """Return rh (m) a step on; ``wait``: the masses are late, so the integral stands still."""
    rise = now - before
    if not wait:
        mean = (before + now) / 2
        rise = rise + gains.integral * gains.period * (offsets.across(gains.up) @ mean)
    return held + gains.gamma * gains.mass * rise


def shift_for(gains: Gains, held: Vector3, gravity: Vector3, rate: Vector3) -> Vector3:
    """Return the shift (m) that gives the torque of the law."""
    # The product with g_b leaves of w, too, only what is across gravity.
    torque = gains.mass * cross(gravity, held) - gains.damping * rate
    return cross(gravity, torque) / (gains.mass * float(gravity @ gravity))


def polynomial(frequency: float, integral: float, swing: float) -> Floats:
    """Return the characteristic polynomial; ``swing`` is w_z^2 (rad^2/s^2), below 0 if upright."""
    w = frequency
    return np.array([1.0, 2 * ZETA * w, w**2 + swing, integral * w**2])


def routh_margin(frequency: float, integral: float, swing: float) -> float:
    """Return a1 a2 - a0 a3 over a1 a2; stable above 0. Without an integral: of the swing alone."""
    a0, a1, a2, a3 = polynomial(frequency, integral, swing)
    return float("-inf") if a2 <= 0 else float(1 - a0 * a3 / (a1 * a2))


def settling(frequency: float, integral: float, swing: float) -> float:
    """Return the time (s) in which the slowest mode falls to 1/e."""
    roots = np.roots(polynomial(frequency, integral, swing)[: 4 if integral else 3])
    return -1.0 / float(np.max(np.real(roots)))


def swing_of(testbed: Testbed, height: float) -> float:
    """Return w_z^2 (rad^2/s^2) of a centre of mass that high (m) above P."""
    return -testbed.weight * height / offsets.level_inertia(testbed)


def frequency_for(testbed: Testbed, period: float) -> float:
    """Return w_a (rad/s) at which the loop is stable; InputError if there is none."""
    least = least_frequency(testbed, offsets.likely_offset(testbed))
    return offsets.greatest_frequency(testbed, least, SPEED, period)


def least_frequency(testbed: Testbed, offset: float) -> float:
    """Return w_a (rad/s) below which an offset (m), or an inverted pendulum, tilts too far."""
    weight = testbed.weight / offsets.level_inertia(testbed)
    sideways = weight * offset / (TILTED * testbed.tilt_limit)
    upright = max(-swing_of(testbed, offsets.likely_height(testbed)), 0.0) / UPRIGHT
    return float(max(sideways, upright) ** 0.5)
