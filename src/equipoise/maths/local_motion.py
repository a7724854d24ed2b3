"""Attitude and rate from attitude samples alone, by local polynomials on the rotation group.

Around each sample k the neighbours' rotation vectors phi_j = log(q_k^-1 q_j) are fitted by a
polynomial in time (weights equal, least squares). Its constant term corrects the sample, its slope
is the body rate at the sample. On a uniform grid this is Savitzky and Golay's filter; here times
may be uneven. Bias grows as the window to the power of the degree; noise falls with its root.
"""

import numpy as np

from equipoise.maths.attitude import difference, exponential, multiply
from equipoise.model.arrays import Floats, Series1, Series3, Series4

TURN = 0.6  # rad, chosen: most rotation in half a window, so that a cubic still follows it
LONGEST = 2.5  # s, chosen: swings of an air-bearing platform take tens of seconds


def half_window(t: Series1, q: Series4) -> float:
    """Return half the window (s) that suits the motion."""
    speed = np.linalg.norm(difference(q[1:], q[:-1]), axis=1) / np.diff(t)
    fastest = float(np.median(speed)) + 1e-9
    return max(min(TURN / fastest, LONGEST), 2.5 * float(np.median(np.diff(t))))


def local_motion(t: Series1, q: Series4, half: float, degree: int = 3) -> tuple[Series4, Series3]:
    """Return smoothed attitudes (n, 4) and body rates (n, 3) rad/s at the samples' own times."""
    n = len(t)
    reach = max(int(np.ceil(half / float(np.median(np.diff(t))))), (degree + 2) // 2)
    first = np.clip(np.arange(n) - reach, 0, max(n - 2 * reach - 1, 0))
    index = np.minimum(first[:, None] + np.arange(2 * reach + 1), n - 1)
    near = np.abs(t[index] - t[:, None]) <= np.maximum(half, np.abs(t[index[:, :1]] - t[:, None]))
    phi = np.stack([difference(q[column], q) for column in index.T], axis=1)
    scale = half if half > 0 else 1.0
    order = min(degree, n - 1)
    powers: Floats = ((t[index] - t[:, None]) / scale)[..., None] ** np.arange(order + 1)
    weighted = powers * near[..., None]
    normal = np.einsum("nja,njb->nab", weighted, powers)
    normal += 1e-9 * np.eye(order + 1)
    fit = np.linalg.solve(normal, np.einsum("nja,njc->nac", weighted, phi))
    return multiply(q, exponential(fit[:, 0])), fit[:, 1] / scale

