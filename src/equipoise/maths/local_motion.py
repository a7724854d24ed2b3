"""Attitude and rate from attitude samples alone, by local polynomials on the rotation group.

Around each sample k the neighbours' rotation vectors phi_j = log(q_k^-1 q_j) are fitted by a
polynomial in time (weights equal, least squares). Its constant term corrects the sample, its slope
is the body rate at the sample. On a uniform grid this is Savitzky and Golay's filter; here times
may be uneven. Bias grows as the window to the power of the degree; noise falls with its root.
"""

import numpy as np

from equipoise.maths.attitude import difference, exponential, multiply
from equipoise.maths.kernels.compiled import kernel, part
from equipoise.maths.scaled_solve import factorise, solve
from equipoise.maths.turns import turn
from equipoise.model.arrays import Floats, Series1, Series3, Series4

TURN = 0.6  # rad, chosen: most rotation in half a window, so that a cubic still follows it
LONGEST = 2.5  # s, chosen: swings of an air-bearing platform take tens of seconds
NEIGHBOURS = 24  # chosen: of more, evenly spaced ones are used; dense records are smooth anyway
DEGREE = 3


def half_window(t: Series1, q: Series4) -> float:
    """Return half the window (s) that suits the motion."""
    speed = np.linalg.norm(difference(q[1:], q[:-1]), axis=1) / np.diff(t)
    fastest = float(np.median(speed)) + 1e-9
    return max(min(TURN / fastest, LONGEST), 2.5 * float(np.median(np.diff(t))))


@part
def _add(powers: Floats, phi: tuple[float, float, float], normal: Floats, right: Floats) -> None:
    """Add one neighbour to the normal equations."""
    n = right.shape[1]
    for a in range(n):
        for b in range(n):
            normal[a, b] += powers[a] * powers[b]
        for c in range(3):
            right[c, a] += powers[a] * phi[c]


@kernel
def _fit(t: Floats, q: Floats, reach: int, stride: int, scale: float, out: Floats) -> None:
    """Write constant term and slope, shape (n, 2, 3)."""
    n, terms = t.shape[0], min(DEGREE + 1, t.shape[0])
    powers, unit, factors = np.zeros(terms), np.zeros(terms), np.zeros((terms, terms))
    normal, right, found = np.zeros((terms, terms)), np.zeros((3, terms)), np.zeros(terms)
    for k in range(n):
        normal[:], right[:] = 0.0, 0.0
        first = min(max(k - reach, 0), max(n - 1 - 2 * reach, 0))
        for j in range(first, min(first + 2 * reach + 1, n), stride):
            phi = turn(q[k], q[j])
            powers[0] = 1.0
            for a in range(1, terms):
                powers[a] = powers[a - 1] * (t[j] - t[k]) / scale
            _add(powers, phi, normal, right)
        for a in range(terms):
            normal[a, a] += 1e-9
        factorise(normal, 0.0, unit, factors)
        for c in range(3):
            solve(unit, factors, right[c], found)
            out[k, 0, c], out[k, 1, c] = found[0], found[1] / scale


def local_motion(t: Series1, q: Series4, half: float) -> tuple[Series4, Series3]:
    """Return smoothed attitudes (n, 4) and body rates (n, 3) rad/s at the samples' own times."""
    reach = max(int(np.ceil(half / float(np.median(np.diff(t))))), (DEGREE + 2) // 2)
    stride = max(2 * reach // NEIGHBOURS, 1)
    out = np.zeros((len(t), 2, 3))
    _fit(t, np.ascontiguousarray(q), reach, stride, half, out)
    return multiply(q, exponential(out[:, 0])), np.ascontiguousarray(out[:, 1])
