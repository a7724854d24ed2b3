"""The torque of gravity a little ahead of time, for the feed-forward of a controller.

A platform turns on at its rate and its centre of mass drifts on; gravity in body axes follows:

    q(t + T) = q exp(T w),    g_B = R(q)^T (0, 0, -g),    n = g_B / g
    mu  = m (r + v T + C n)                               first moment about P, masses as they stand
    tau = mu x g_B

and with errors a of the attitude (body axes, q exp(a)), of w, r and v, to first order:

    dg_B = g_B x a,   a(t + T) = a + T dw
    dmu  = m (dr + T dv + C (n x a)) + m S(n) dc,      C n = S(n) c, c: the five terms of the sag
    dtau = dmu x g_B + mu x dg_B

The sag's coefficients count as independent of r. Their errors come on top.

(RAMBO, 2026, feeds the torque of gravity forward in a quaternion PD controller. The torque is that
of da Silva 2021 Eq. 13, in the signs of a laboratory whose Z points up.)

A feed-forward is usable where the error that is left is much less than the torque:

    sqrt(tr Cov tau) <= max(|tau| / 2, m g c),     c = 3 um

Cannot see torques that do not come from gravity: air, cables, magnets. A hand that holds the
platform looks like a centre of mass that needs no holding.
"""

from dataclasses import dataclass

import numpy as np

from equipoise.dynamics.sag_trim import sag_matrix
from equipoise.maths.attitude import to_matrix, turned_on
from equipoise.maths.linalg import cross, skew
from equipoise.model.arrays import Floats, Matrix3, Quaternion, Square, Vector3
from equipoise.model.torque_terms import GROUPS
from equipoise.model.units import UM

SHARE = 0.5  # of the torque, chosen: so that the pointing error is at least halved
CLOSE = 3 * UM  # m, chosen: as well as a balanced platform is known
SAG = GROUPS["sag"]


@dataclass(frozen=True, slots=True, eq=False)
class Heavy:
    """What of a platform gravity acts on, beside its centre of mass."""

    mass: float  # kg
    gravity: float  # m/s^2
    sag: Floats  # (5,) m, the terms ``SAG``
    sag_covariance: Square  # (5, 5) m^2

    @property
    def weight(self) -> float:
        """Return m g, N."""
        return self.mass * self.gravity


@dataclass(frozen=True, slots=True, eq=False)
class Moving:
    """A platform as it is estimated to move now."""

    q: Quaternion  # body to laboratory
    rate: Vector3  # rad/s, body axes
    com: Vector3  # m, masses as they stand, without sag
    drift: Vector3  # m/s, of com
    covariance: Square  # (12, 12) of attitude (rad, body axes), rate, com and drift


@dataclass(frozen=True, slots=True, eq=False)
class Ahead:
    """First moment, gravity and torque at one time, body axes."""

    first_moment: Vector3  # kg m
    gravity: Vector3  # m/s^2
    torque: Vector3  # N m
    moment_covariance: Matrix3
    torque_covariance: Matrix3


def sag_columns(n: Vector3) -> Floats:
    """Return S(n), (3, 5), with C n = S(n) c."""
    units = np.eye(len(SAG))
    return np.column_stack([sag_matrix(dict(zip(SAG, unit, strict=True))) @ n for unit in units])


def gravity_ahead(now: Moving, heavy: Heavy, lead: float) -> Ahead:
    """Return the torque after ``lead`` (s), with the covariance that the estimate gives it."""
    q = turned_on(now.q, now.rate, lead)
    n: Vector3 = -to_matrix(q)[2]
    g, C = heavy.gravity * n, sag_matrix(dict(zip(SAG, heavy.sag, strict=True)))
    mu: Vector3 = heavy.mass * (now.com + lead * now.drift + C @ n)
    turned = heavy.mass * C @ skew(n)
    mu_state = np.hstack([turned, lead * turned, *(heavy.mass * k * np.eye(3) for k in (1, lead))])
    mu_sag = heavy.mass * sag_columns(n)
    swung = skew(mu) @ skew(g)
    tau_state = -skew(g) @ mu_state
    tau_state[:, :6] += np.hstack([swung, lead * swung])
    tau_sag = -skew(g) @ mu_sag
    return Ahead(mu, g, cross(mu, g), *(
        of_state @ now.covariance @ of_state.T + of_sag @ heavy.sag_covariance @ of_sag.T
        for of_state, of_sag in ((mu_state, mu_sag), (tau_state, tau_sag))
    ))  # fmt: skip


def is_usable(ahead: Ahead, heavy: Heavy) -> bool:
    """Say whether a controller gains by this torque; see above."""
    left = float(np.sqrt(np.trace(ahead.torque_covariance)))
    size = float(np.linalg.norm(ahead.torque))
    return bool(left <= max(SHARE * size, CLOSE * heavy.weight))
