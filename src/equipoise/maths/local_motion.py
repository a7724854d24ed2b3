"""Attitude and rate from attitude samples alone, by local polynomials on the rotation group.

Around each sample k the neighbours' rotation vectors phi_j = log(q_k^-1 q_j) are fitted by a
polynomial in time (weights equal, least squares). Its constant term corrects the sample, its slope
is the body rate at the sample. On a uniform grid this is Savitzky and Golay's filter; here times
may be uneven. Bias grows as the window to the power of the degree; noise falls with its root.

Both terms are linear in phi_j, by weights that follow from the times alone:

    out_k = sum_j W_kj phi_j,      W_kj = e^T (P^T P)^-1 P_j,     P_j = [1 s s^2 s^3], s = t_j - t_k

Records with the same times take the same weights.
"""

from typing import NamedTuple

import numpy as np

from equipoise.maths.attitude import exponential, multiply
from equipoise.maths.kernels.compiled import kernel, part
from equipoise.maths.scaled_solve import factorise, solve
from equipoise.maths.turns import turn
from equipoise.model.arrays import Floats, Series1, Series3, Series4

TURN = 0.6  # rad, chosen: most rotation in half a window, so that a cubic still follows it
LONGEST = 2.5  # s, chosen: swings of an air-bearing platform take tens of seconds
NEIGHBOURS = 24  # chosen: of more, evenly spaced ones are used; dense records are smooth anyway
DEGREE = 3
RIDGE = 1e-9
SMALL = 0.02  # square of the tangent of half a turn, 0.28 rad: the series is then exact to 2e-15


class Window(NamedTuple):
    """Which neighbours a sample has."""

    reach: int  # rows to either side
    stride: int  # rows from one neighbour to the next
    neighbours: int
    half: float  # s


@kernel
def suitable_half(t: Floats, q: Floats, period: float) -> float:
    """Return half the window (s) that suits a motion (n, 4), by its median speed; s a row."""
    n = t.shape[0] - 1
    speeds = np.empty(n)
    for k in range(n):
        x, y, z = turn(q[k], q[k + 1])
        speeds[k] = (x * x + y * y + z * z) ** 0.5 / (t[k + 1] - t[k])
    speeds.sort()  # a kernel with ``np.median`` loads SciPy's linear algebra
    fastest = 0.5 * float(speeds[(n - 1) // 2] + speeds[n // 2]) + 1e-9
    return max(min(TURN / fastest, LONGEST), 2.5 * period)


@part
def window_of(half: float, period: float, rows: int) -> Window:
    """Return the neighbours within half a window (s)."""
    reach = max(int(np.ceil(half / period)), (DEGREE + 2) // 2)
    stride = max(2 * reach // NEIGHBOURS, 1)
    return Window(reach, stride, (min(2 * reach + 1, rows) + stride - 1) // stride, half)


@part
def first_of(window: Window, k: int, rows: int) -> int:
    """Return the first neighbour of sample k."""
    return min(max(k - window.reach, 0), max(rows - 1 - 2 * window.reach, 0))


@part
def write_powers(t: Floats, k: int, first: int, window: Window, powers: Floats) -> None:
    """Write P (m, terms) of the neighbours of sample k, in half windows."""
    for j in range(powers.shape[0]):
        after = (t[first + j * window.stride] - t[k]) / window.half
        powers[j, 0] = 1.0
        for a in range(1, powers.shape[1]):
            powers[j, a] = powers[j, a - 1] * after


@part
def write_normal(powers: Floats, normal: Floats) -> None:
    """Write P^T P and a ridge."""
    for a in range(normal.shape[0]):
        for b in range(normal.shape[0]):
            normal[a, b] = RIDGE if a == b else 0.0
            for j in range(powers.shape[0]):
                normal[a, b] += powers[j, a] * powers[j, b]


@kernel
def weights_of(t: Floats, window: Window) -> Floats:
    """Return W (n, 2, m) of m neighbours: of the constant term, and of the slope (1/s)."""
    n, terms = t.shape[0], min(DEGREE + 1, t.shape[0])
    powers, normal, factors = (np.empty((window.neighbours, terms)), np.empty((terms, terms)),
                               np.empty((terms, terms)))  # fmt: skip
    unit, right, found = np.empty(terms), np.empty(terms), np.empty(terms)
    out = np.zeros((n, 2, window.neighbours))
    for k in range(n):
        write_powers(t, k, first_of(window, k, n), window, powers)
        write_normal(powers, normal)
        factorise(normal, 0.0, unit, factors)
        for c in range(2):
            right[:] = 0.0
            right[c] = 1.0 if c == 0 else 1.0 / window.half
            solve(unit, factors, right, found)
            for j in range(window.neighbours):
                for a in range(terms):
                    out[k, c, j] += found[a] * powers[j, a]
    return out


@part
def weigh_small(
    parts: Floats, k: int, first: int, stride: int, weights: Floats, out: Floats
) -> bool:
    """Write both terms by the series of the arc tangent; say whether all turns are small enough.

    log q = 2 v / w (1 - u/3 + u^2/5 - ...), u = |v|^2 / w^2: nothing in it but sums and products,
    so that one machine instruction serves several neighbours. ``parts`` are the rows w, x, y, z.
    """
    a, b, c, d = parts[0, k], parts[1, k], parts[2, k], parts[3, k]
    p, q, r, s = parts[0, first:], parts[1, first:], parts[2, first:], parts[3, first:]
    still, slope, large = weights[0], weights[1], 0.0
    x0, y0, z0, x1, y1, z1 = 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
    for j in range(still.shape[0]):
        i = j * stride
        inverse = 1.0 / (a * p[i] + b * q[i] + c * r[i] + d * s[i])
        x = inverse * (a * q[i] - b * p[i] - c * s[i] + d * r[i])
        y = inverse * (a * r[i] + b * s[i] - c * p[i] - d * q[i])
        z = inverse * (a * s[i] - b * r[i] + c * q[i] - d * p[i])
        u = x * x + y * y + z * z
        large += 0.0 if u < SMALL else 1.0
        by = 1 / 13 + u * (-1 / 15 + u * (1 / 17))
        by = 1 / 7 + u * (-1 / 9 + u * (1 / 11 - u * by))
        by = 2.0 - 2.0 * u * (1 / 3 + u * (-1 / 5 + u * by))
        one, other = by * still[j], by * slope[j]
        x0, y0, z0 = x0 + one * x, y0 + one * y, z0 + one * z
        x1, y1, z1 = x1 + other * x, y1 + other * y, z1 + other * z
    out[0, 0], out[0, 1], out[0, 2] = x0, y0, z0
    out[1, 0], out[1, 1], out[1, 2] = x1, y1, z1
    return large == 0.0


@part
def weigh_any(q: Floats, k: int, first: int, stride: int, weights: Floats, out: Floats) -> None:
    """Write both terms of turns of any size."""
    out[:] = 0.0
    for j in range(weights.shape[1]):
        phi = turn(q[k], q[first + j * stride])
        for c in range(3):
            out[0, c] += weights[0, j] * phi[c]
            out[1, c] += weights[1, j] * phi[c]


@kernel
def weigh(q: Floats, parts: Floats, window: Window, weights: Floats, out: Floats) -> None:
    """Write constant term and slope of attitudes (n, 4), shape (n, 2, 3).

    ``parts`` (4, n) is worked in.
    """
    n = q.shape[0]
    for k in range(n):
        for c in range(4):
            parts[c, k] = q[k, c]
    for k in range(n):
        first = first_of(window, k, n)
        if not weigh_small(parts, k, first, window.stride, weights[k], out[k]):
            weigh_any(q, k, first, window.stride, weights[k], out[k])


@kernel
def _fit(t: Floats, q: Floats, half: float, period: float, out: Floats) -> None:
    """Write constant term and slope of one record."""
    window = window_of(half, period, t.shape[0])
    weigh(q, np.empty((4, t.shape[0])), window, weights_of(t, window), out)


def half_window(t: Series1, q: Series4) -> float:
    """Return half the window (s) that suits the motion."""
    return suitable_half(t, np.ascontiguousarray(q), float(np.median(np.diff(t))))


def local_motion(t: Series1, q: Series4, half: float) -> tuple[Series4, Series3]:
    """Return smoothed attitudes (n, 4) and body rates (n, 3) rad/s at the samples' own times."""
    out = np.zeros((len(t), 2, 3))
    _fit(t, np.ascontiguousarray(q), half, float(np.median(np.diff(t))), out)
    return multiply(q, exponential(out[:, 0])), np.ascontiguousarray(out[:, 1])
