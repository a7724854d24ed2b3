"""Composite adaptation of inertia and centre of mass while a trajectory is tracked.

    J w' = -w x (J w + h) + u + m (r + s) x g_B,      u = -h' the torque of wheels or gyros
    w_r  = w_d + lam e,     sigma = w - w_r          e: what is left to turn, w_d: the trajectory's

With the parameters p = (J, r), J w_r' + w_r x J w - m r x g_B = Y p, and since (J w) x sigma does
no work on sigma, the torque

    u = w x h - m s x g_B + Y p^ - K sigma            leaves
    J sigma' = (J w) x sigma - K sigma + Y (p^ - p)

Momentum in laboratory axes gives rows without an acceleration: of R (J w + h) the part that a
high-pass filter with the time constant T leaves, F p = f + noise of variance v. With

    p^'    = -gamma P Y^T sigma - P F^T (F p^ - f) / v
    P^-1'  = F^T F / v
    V      = sigma J sigma / 2 + (p^ - p) P^-1 (p^ - p) / (2 gamma)
    V'     = -sigma K sigma - |F (p^ - p)|^2 / (2 gamma v)

(Slotine and Li 1987 for the first term of p^', 1989 for both.) The second is a Kalman filter of
constant parameters; its sampled form is exact. gamma makes the loop of sigma and r as quick as w_a:
gamma P_r(0) = J (w_a / (m g))^2. Its share fades with P as the rows tell more.

What it cannot see: r along gravity until the platform has tilted; J about an axis about which the
trajectory does not turn, which keeps the testbed's value. Sag and drift are held at none.
"""

from typing import NamedTuple

import numpy as np

from equipoise.control.elements.attitude_pid import Reference, error_of
from equipoise.control.law import Sample
from equipoise.dynamics.regressor import momentum_columns
from equipoise.maths.attitude import to_matrix
from equipoise.maths.kernels.compiled import kernel
from equipoise.maths.linalg import (
    cross,
    element_sizes,
    inverse_spd,
    pack_symmetric,
    skew,
    symmetrise,
)
from equipoise.model.arrays import Floats, Matrix3, Square, Vector3
from equipoise.model.testbed import Testbed

COM = slice(6, 9)  # of p, behind J
SIZE = 9
WINDOW = 20.0  # s, chosen: T; torques of air and bearing that last longer are taken for r
FREQUENCY = 0.3  # rad/s, chosen: w_a
LAM = 0.3  # 1/s, chosen
DAMPING = 1.0  # 1/s, chosen: K / J
LASTING = 5e-5  # N m s, chosen: one sd of what lasts a window: bias, air, masses that travel
CREEP = 0.02e-6  # m/sqrt(s), chosen: com walks, so that old rows fade
LEAST_SHARE = 1e-3  # chosen: inertia is not taken to be known better
LEAST_SD = 1e-6  # m, chosen: nor is a centre of mass that is still to be balanced


class Constants(NamedTuple):
    """What does not change while it tracks."""

    mass: float  # kg
    gain: Matrix3  # N m s, K
    coupling: float  # gamma
    variance: float  # (N m s)^2 s, v of a row that counts for a second


class Adaptation(NamedTuple):
    """The parameters, and what the rows have said so far."""

    p: Floats  # (9,) J xx yy zz xy xz yz, r with the masses at home
    P: Square
    low: Floats  # (3, 10) of [F | f], what the filter passes
    whole: Floats  # (3, 4) integrals of [-R m [g x] | R m s x g]
    slope: Floats  # (3, 4) their integrands at the last sample
    shift: Vector3  # m
    t: float  # s


@kernel
def momentum_matrix(w: Vector3) -> Floats:
    """Return W (3, 6) with W J = J w."""
    out = np.zeros((3, 6))
    momentum_columns((w[0], w[1], w[2]), out)
    return out


def constants_of(testbed: Testbed) -> Constants:
    """Return the constants for a testbed; it must have a gyro."""
    assert testbed.gyro is not None
    inertia, sd = testbed.body.inertia_P, max(float(np.max(testbed.com_sd)), LEAST_SD)
    moment = float(np.trace(inertia)) / 3
    gyro = moment * testbed.gyro.noise / testbed.gyro.rate**0.5
    coupling = moment * (FREQUENCY / testbed.weight) ** 2 / sd**2
    variance = gyro**2 + WINDOW * LASTING**2
    return Constants(testbed.body.mass, DAMPING * inertia, coupling, variance)


def opened(testbed: Testbed, sample: Sample) -> Adaptation:
    """Return the beginning at a sample: the testbed's values and what is uncertain of them."""
    inertia = testbed.body.inertia_P
    sd = max(testbed.inertia_sd, LEAST_SHARE) * element_sizes(inertia)
    P = np.diag(np.concatenate([sd, np.maximum(testbed.com_sd, LEAST_SD)]) ** 2)
    p = np.concatenate([pack_symmetric(inertia), testbed.body.com])
    slope, whole = integrands(testbed.body.mass, sample), np.zeros((3, 4))
    return Adaptation(p, P, columns(whole, sample), whole, slope, sample.shift, sample.t)


def integrands(mass: float, sample: Sample) -> Floats:
    """Return [-R m [g x] | R m s x g], N and N m, laboratory axes."""
    g = sample.gravity
    known = mass * cross(sample.shift, g)
    return to_matrix(sample.q) @ np.column_stack([-mass * skew(g), known])


def columns(whole: Floats, sample: Sample) -> Floats:
    """Return [F | f] before the filter: momentum of p, less what gravity gave it; known momentum.

    R W J - (integral of -R m [g x]) r = -R h + integral of R m s x g + a constant
    """
    R = to_matrix(sample.q)
    f = whole[:, 3] - R @ sample.momentum
    return np.column_stack([R @ momentum_matrix(sample.rate), -whole[:, :3], f])


def sigma_of(sample: Sample, reference: Reference) -> tuple[Vector3, Vector3, Vector3]:
    """Return sigma, w_r (rad/s) and its slope (rad/s^2)."""
    e = error_of(sample.q, reference.q)
    w_r: Vector3 = reference.rate + LAM * e
    slope: Vector3 = reference.acceleration + LAM * (reference.rate - sample.rate)
    return sample.rate - w_r, w_r, slope


def tracking_rows(sample: Sample, w_r: Vector3, slope: Vector3, mass: float) -> Floats:
    """Return Y (3, 9)."""
    turning = momentum_matrix(slope) + skew(w_r) @ momentum_matrix(sample.rate)
    return np.column_stack([turning, mass * skew(sample.gravity)])


def adapted(
    now: Adaptation, sample: Sample, reference: Reference, known: Constants
) -> tuple[Adaptation, Vector3]:
    """Return the adaptation after a sample, and the torque (N m) to request."""
    sigma, w_r, slope = sigma_of(sample, reference)
    Y = tracking_rows(sample, w_r, slope, known.mass)
    after = informed(now, sample, known)
    dt = sample.t - now.t
    p = after.p - dt * known.coupling * after.P @ Y.T @ sigma
    u = cross(sample.rate, sample.momentum) + Y @ p - known.gain @ sigma
    u -= known.mass * cross(sample.shift, sample.gravity)
    return after._replace(p=p), u


def informed(now: Adaptation, sample: Sample, known: Constants) -> Adaptation:
    """Return the adaptation after the rows of a sample."""
    dt = sample.t - now.t
    if dt <= 0:
        return now
    slope = integrands(known.mass, sample)
    whole = now.whole + 0.5 * dt * (now.slope + slope)
    raw = columns(whole, sample)
    low = now.low + (1 - np.exp(-dt / WINDOW)) * (raw - now.low)
    F, f = (raw - low)[:, :SIZE], (raw - low)[:, SIZE]
    P = now.P.copy()
    P[COM, COM] += CREEP**2 * dt * np.eye(3)
    PFt = P @ F.T
    K = PFt @ inverse_spd(F @ PFt + known.variance / dt * np.eye(3))
    p = now.p + K @ (f - F @ now.p)
    return Adaptation(p, symmetrise(P - K @ PFt.T), low, whole, slope, sample.shift, sample.t)


def com_of(now: Adaptation) -> tuple[Vector3, Vector3]:
    """Return r with the masses at home (m), and its sd."""
    return now.p[COM], np.sqrt(np.diag(now.P)[COM])
