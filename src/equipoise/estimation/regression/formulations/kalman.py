"""Rates through an extended Kalman filter, then slopes by an even filter (Kim, Yang and Lee 2016).

    prediction   w' = J_0^-1 ( -w x (J_0 w + k) - k' + m r_0 x g_B + dmu x g_B + tau )
    correction   w+ = w + K (w_meas - w),   K = P / (P + sd^2),   P grows by (a dt)^2 a step

with J_0 and r_0 of the testbed, and a = ``WRONG`` of the rates' own accelerations: what the model
may be wrong by. P is the same about all axes, its transition taken for the unit matrix, as rates
change little from row to row. The filtered rates take the place of the gyro's in the momentum
balance, whose slope is Savitzky and Golay's through an even number of rows, between the middle two.

What the testbed's J is wrong by draws the answer towards it; the interval knows as much of that as
the testbed's own sd says. Cannot see what ``momentum`` cannot see.
"""

import numpy as np

from equipoise.estimation.motion.fused_motion import LedMotion
from equipoise.estimation.motion.sensor_noise import gyro_noise
from equipoise.estimation.regression.formulations.columns import columns
from equipoise.estimation.regression.formulations.momentum import body_axes
from equipoise.estimation.regression.formulations.rows import Posed, Rows
from equipoise.estimation.regression.formulations.torque import differentiated, even_savitzky_golay
from equipoise.maths.kernels.compiled import kernel
from equipoise.model.arrays import Floats, Ints, Series1, Series3

WRONG = 0.2  # chosen: of the accelerations, more than a CAD model is wrong by


@kernel
def _filter(
    t: Floats, w: Floats, piece: Ints, push: Floats, k: Floats, J: Floats, inverse: Floats,
    noise: Floats, out: Floats,
) -> None:  # fmt: skip
    """Write the filtered rates; ``push`` (n, 3) is the impulse up to each row, less k."""
    sd, grown = noise[0], noise[1]
    spread = sd * sd
    for i in range(t.shape[0]):
        new = i == 0 or piece[i] != piece[i - 1]
        if new:
            spread = sd * sd
            for j in range(3):
                out[i, j] = w[i, j]
            continue
        h, b = t[i] - t[i - 1], out[i - 1]
        H0 = J[0, 0] * b[0] + J[0, 1] * b[1] + J[0, 2] * b[2] + k[i - 1, 0]
        H1 = J[1, 0] * b[0] + J[1, 1] * b[1] + J[1, 2] * b[2] + k[i - 1, 1]
        H2 = J[2, 0] * b[0] + J[2, 1] * b[1] + J[2, 2] * b[2] + k[i - 1, 2]
        s0 = push[i, 0] - push[i - 1, 0] - h * (b[1] * H2 - b[2] * H1)
        s1 = push[i, 1] - push[i - 1, 1] - h * (b[2] * H0 - b[0] * H2)
        s2 = push[i, 2] - push[i - 1, 2] - h * (b[0] * H1 - b[1] * H0)
        spread += (grown * h) ** 2
        gain = spread / (spread + sd * sd)
        spread *= 1.0 - gain
        for j in range(3):
            ahead = b[j] + inverse[j, 0] * s0 + inverse[j, 1] * s1 + inverse[j, 2] * s2
            out[i, j] = ahead + gain * (w[i, j] - ahead)


def filtered_rates(posed: Posed) -> Series3:
    """Return the rates (rad/s) behind the filter."""
    motion, body = posed.motion, posed.testbed.body
    at = columns(posed.recording, posed.testbed, motion[:3])
    known = at.torque[:, :, :3] @ body.com + at.shifted
    push = at.impulse + summed(motion.t, known) - at.known_momentum
    noise = np.array([max(gyro_noise(posed.testbed), 1e-9), WRONG * accelerations(posed.motion)])
    out = np.empty_like(motion.w)
    J = np.ascontiguousarray(body.inertia_P)
    _filter(motion.t, np.ascontiguousarray(motion.w), motion.piece, push, at.known_momentum, J,
            np.asarray(np.linalg.inv(J), dtype=np.float64), noise, out)  # fmt: skip
    return out


def summed(t: Series1, rate: Series3) -> Series3:
    """Return the running integral by trapezes, over gaps too."""
    steps = 0.5 * (rate[1:] + rate[:-1]) * np.diff(t)[:, None]
    return np.concatenate([np.zeros((1, 3)), np.cumsum(steps, axis=0)])


def accelerations(motion: LedMotion) -> float:
    """Return how quickly rates change, rad/s^2: rms of slopes over half a second and more."""
    stride = max(round(0.5 / float(np.median(np.diff(motion.t)))), 1)
    w, t = motion.w[::stride], motion.t[::stride]
    slopes: Floats = np.diff(w, axis=0) / np.diff(t)[:, None]
    return float(np.sqrt(np.mean(slopes**2))) if len(slopes) else 1e-3


def kalman_torque(posed: Posed) -> Rows:
    """Return the torque balance of the filtered rates."""
    motion = posed.motion._replace(w=filtered_rates(posed))
    filtered = Posed(posed.recording, posed.testbed, motion, posed.terms)
    return differentiated(body_axes(filtered), even_savitzky_golay)
