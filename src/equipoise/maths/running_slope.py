"""Slope by least squares in a running window, and the mean of all else that goes with it.

Savitzky and Golay's slope (degree 1 or 2, in the middle of n rows) is a weighted mean of the true
slope. With m the mean of the times in the window,

    slope = sum_j a_j x_j,     a_j = (t_j - m) / sum_i (t_i - m)^2
          = sum_i k_i (x_(i+1) - x_i),       k_i = sum_(j > i) a_j

and an increment is the integral of x', by the trapezoid (x'_i + x'_(i+1)) (t_(i+1) - t_i) / 2. So

    slope of x = sum_i c_i x'_i,       c_i = (k_(i-1) dt_(i-1) + k_i dt_i) / 2

which is a parabola on even rows. Where x' = y, the slope of x is the mean of y with weights c, at
jumps of y too: a plain mean, or none, would not do. Times may be uneven. Noise of one sd s in each
row becomes s sqrt(12 / n^3) / dt in the slope.
"""

import numpy as np

from equipoise.maths.compiled import kernel, part
from equipoise.model.arrays import Floats, Ints, Series, Series1


@part
def _weights(t: Floats, a: Floats, c: Floats) -> None:
    """Write the weights of a window: a for slopes, c for the means that match."""
    n, middle, spread = t.shape[0], 0.0, 0.0
    for i in range(n):
        middle += t[i] / n
    for i in range(n):
        spread += (t[i] - middle) ** 2
        c[i] = 0.0
    behind = 0.0
    for i in range(n - 1, -1, -1):
        a[i] = (t[i] - middle) / spread
        if i:
            behind += a[i]
            half = 0.5 * behind * (t[i] - t[i - 1])
            c[i] += half
            c[i - 1] += half


@part
def _add(weight: float, row: Floats, out: Floats) -> None:
    """Add a weighted row."""
    for q in range(row.shape[0]):
        out[q] += weight * row[q]


@kernel
def _run(t: Floats, values: Floats, k: int, windows: Ints, out: Floats) -> None:
    """Write slopes of the first k columns, means of the others."""
    room = np.empty((2, t.shape[0]))
    for i in range(out.shape[0]):
        first, last = windows[i, 0], windows[i, 1]
        a, c = room[0, : last - first], room[1, : last - first]
        _weights(t[first:last], a, c)
        out[i] = 0.0
        near = values[first:last]
        for j in range(last - first):
            _add(a[j], near[j, :k], out[i, :k])
            _add(c[j], near[j, k:], out[i, k:])


def running_slope(t: Series1, x: Series, y: Series, windows: Ints) -> tuple[Series, Series]:
    """Return slopes of x (n, k) and matching means of y (n, l) in each window.

    ``windows`` (w, 2) are first rows and the rows behind the last ones: three rows or more.
    """
    k = x.shape[1]
    out = np.empty((len(windows), k + y.shape[1]))
    _run(t, np.hstack([x, y]), k, windows, out)
    return out[:, :k], out[:, k:]
