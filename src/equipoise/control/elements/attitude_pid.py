"""Attitude control by wheels or gyros: quaternion PID with gravity feed-forward.

The platform should follow a reference as one with inertia J and neither wheels nor weight:

    e   = 2 sgn(s) v,   (s, v) = q* (x) q_ref         rad, body axes; small: what is left to turn
    a   = a_ref + 2 zeta w_n (w_ref - w) + w_n^2 ( e + w_i int e dt )
    u   = w x (J w + h)  -  m r x g_B  +  J a           N m on the platform, = -h'

Put into J w' = -w x (J w + h) + u + m r x g_B this leaves w' = a. Wrong J in the gyroscopic part
does no work and cannot unsettle. The integral takes what the feed-forward misses; with it the loop
is stable for w_i < 2 zeta w_n.

The integral is kept from winding up twice. Torque that was requested and not delivered goes back
into it (back-calculation, time constant 1 / w_n), and its torque never passes a limit:

    x' = e + J^-1 (u_delivered - u_requested) / (w_n w_i)

(Lee et al. Eq. 2, with K_d = 2 zeta w_n J, K_p = w_n^2 J, K_I = 2 w_n^2 w_i J; of its gyroscopic
terms that has w x h alone. Printed there is the integral of E^T(q) w, which is no 3-vector: it is
that of E^T(q) q_T, the v above, and both errors need the sign of s (errata L4). The feed-forward is
RAMBO's.)

Cannot hold against more torque, or for longer, than the devices give: see ``capacity``.
"""

from typing import NamedTuple

import numpy as np

from equipoise.control.law import Sample
from equipoise.maths.attitude import conjugate, multiply
from equipoise.maths.linalg import cross
from equipoise.model.arrays import Matrix3, Quaternion, Vector3

FREQUENCY, DAMPING, INTEGRAL = 0.5, 0.8, 0.1  # rad/s, -, rad/s, chosen: settles in ten seconds


class Reference(NamedTuple):
    """The wanted attitude and its derivatives; vectors in the body axes of that attitude."""

    q: Quaternion
    rate: Vector3  # rad/s
    acceleration: Vector3  # rad/s^2


class Gains(NamedTuple):
    """The loop, and the body that it is made for."""

    inertia_P: Matrix3  # kg m^2
    frequency: float  # rad/s, w_n
    damping: float  # -, zeta
    integral: float  # rad/s, w_i; 0: no integral
    most: float  # N m, the integral's torque per axis


class Pid(NamedTuple):
    """The state of the controller."""

    total: Vector3  # rad s, of the error
    requested: Vector3  # N m, at the last step
    t: float | None  # s, of the last step; None: there was none


def gains_for(inertia_P: Matrix3, most: float) -> Gains:
    """Return the loop that laws use by default; ``most`` as in Gains."""
    return Gains(inertia_P, FREQUENCY, DAMPING, INTEGRAL, most)


def at_rest(q: Quaternion) -> Reference:
    """Return the reference of standing still at an attitude."""
    return Reference(q, np.zeros(3), np.zeros(3))


def unwound() -> Pid:
    """Return the beginning."""
    return Pid(np.zeros(3), np.zeros(3), None)


def error_of(q: Quaternion, target: Quaternion) -> Vector3:
    """Return e (rad): the shorter way from ``q`` to ``target``, twice the sine of its half."""
    turn = multiply(conjugate(q), target)
    return 2.0 * np.copysign(1.0, turn[0]) * turn[1:]


def integrated(pid: Pid, error: Vector3, sample: Sample, gains: Gains) -> Vector3:
    """Return the integral (rad s) at this sample, unwound by the torque that was not delivered."""
    if pid.t is None or gains.integral == 0:
        return pid.total
    slope = gains.frequency * gains.integral
    missed = np.linalg.solve(gains.inertia_P, sample.torque - pid.requested)
    total = pid.total + (sample.t - pid.t) * (error + missed / slope)
    most = gains.most / (np.diag(gains.inertia_P) * gains.frequency * slope)
    return np.clip(total, -most, most)


def torque(
    pid: Pid, sample: Sample, reference: Reference, gains: Gains, moment: Vector3
) -> tuple[Pid, Vector3]:
    """Return the torque to request, N m; ``moment`` (kg m) is the estimated m r, for its weight."""
    J, w, w_n = gains.inertia_P, sample.rate, gains.frequency
    e = error_of(sample.q, reference.q)
    total = integrated(pid, e, sample, gains)
    a = (
        reference.acceleration
        + 2.0 * gains.damping * w_n * (reference.rate - w)
        + w_n**2 * (e + gains.integral * total)
    )
    u = cross(w, J @ w + sample.momentum) - cross(moment, sample.gravity) + J @ a
    return Pid(total, u, sample.t), u
