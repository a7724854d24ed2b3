"""Smoothing a random walk that is measured with white noise: Kalman filter and Rauch's way back.

    x_(k+1) = x_k + d,   var d = q (t_(k+1) - t_k);        z_k = x_k + e,   var e = r

The first value is free. Far from the ends this is a mean with weights exp(-|t - u| / T),
T = sqrt(r dt / q): as much as one can know, and no window to choose. Columns are alike.
"""

import numpy as np

from equipoise.maths.kernels.compiled import kernel
from equipoise.model.arrays import Floats, Series, Series1


@kernel
def _smooth(t: Floats, z: Floats, q: float, r: float, out: Floats, known: Floats) -> None:
    """Write the smoothed columns; ``known`` (n, 2) holds variance before and after each row."""
    n, m = z.shape
    for k in range(n):
        before = 1e12 * r if k == 0 else known[k - 1, 1] + q * (t[k] - t[k - 1])
        gain = before / (before + r)
        known[k, 0], known[k, 1] = before, gain * r
        for j in range(m):
            ahead = z[0, j] if k == 0 else out[k - 1, j]
            out[k, j] = ahead + gain * (z[k, j] - ahead)
    for k in range(n - 2, -1, -1):
        back = known[k, 1] / known[k + 1, 0]
        for j in range(m):
            out[k, j] += back * (out[k + 1, j] - out[k, j])


def smoothed_walk(t: Series1, z: Series, walk: float, noise: float) -> Series:
    """Return z (n, k) smoothed; walk per sqrt(s) and noise are one sd, in the units of z."""
    out, known = np.empty_like(z), np.empty((len(t), 2))
    _smooth(t, z, walk**2, max(noise, 1e-12) ** 2, out, known)
    return out
