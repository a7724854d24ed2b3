"""Torque balance (da Silva 2021 Eq. 12): the momentum balance differentiated, by some filter D.

    D[ W(w) ] p + D[ int w x W(w) ] p - D[ int (m r x g_B) ] - D[ int T c ] = D[ known side ]

Every column passes the same filter, products of noisy signals as well as the rates: so no column
is later or smoother than another, and nothing is biased at the edges of known torques, as it is
where w' is filtered by itself (-0.5 to -1.6 % of J). As printed, Eq. 15 has the sign of a
laboratory whose Z points down; here Z points up.

    central              (f(t + T) - f(t - T)) / 2T, the noisiest
    Savitzky and Golay   slope of a cubic through 0.51 s
    tracking             Han's tracking differentiator: ``maths.sampled.tracking_differentiator``

Amplifies the gyro's noise. Cannot see what ``momentum`` cannot see.
"""

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from equipoise.estimation.regression.formulations.momentum import body_axes
from equipoise.estimation.regression.formulations.rows import Formulation, Posed, Rows
from equipoise.maths.sampled.savitzky_golay import slope_weights
from equipoise.maths.straight_lines import read_at
from equipoise.model.arrays import Floats, Series, Series1

WINDOW = 0.51  # s, chosen: methods compare 0.5 and 2 s; swings take tens of seconds
DEGREE = 3
FEWEST = 5  # rows of a window

Differentiator = Callable[[Series, float], tuple[Series, int, float]]


def central(values: Series, period: float) -> tuple[Series, int, float]:
    """Return the slope of evenly spaced rows, its first row, and how much earlier it is (s)."""
    return (values[2:] - values[:-2]) / (2 * period), 1, 0.0


def window_of(period: float, rows: int, even: bool = False, seconds: float = WINDOW) -> int:
    """Return the rows of a window: odd, or even, never more than there are."""
    wanted = max(round(seconds / period), FEWEST)
    wanted += (wanted % 2 == 0) != even
    return min(wanted, rows - (rows % 2 == 0) if not even else rows - rows % 2)


def savitzky_golay(
    values: Series, period: float, seconds: float = WINDOW
) -> tuple[Series, int, float]:
    """Return the slope of a cubic through an odd number of rows."""
    n = window_of(period, len(values), seconds=seconds)
    return slope_of_cubic(values, period, n), n // 2, 0.0


def even_savitzky_golay(values: Series, period: float) -> tuple[Series, int, float]:
    """Return the slope of a cubic through an even number of rows, between the middle two."""
    n = window_of(period, len(values), even=True)
    return slope_of_cubic(values, period, n), n // 2, 0.5 * period


def slope_of_cubic(values: Series, period: float, n: int) -> Series:
    """Return the slope of a cubic through n rows, in their middle."""
    return filtered(values, slope_weights(n, min(DEGREE, n - 1), period))


def filtered(values: Series, weights: Floats) -> Series:
    """Return the sums of neighbouring rows, weighted, where all of them are there."""
    size = len(values) + len(weights) - 1
    spectrum = np.fft.rfft(values, size, axis=0) * np.fft.rfft(weights[::-1], size)[:, None]
    return np.fft.irfft(spectrum, size, axis=0)[len(weights) - 1 : len(values)]


def evenly(t: Series1, values: Series) -> tuple[Series1, Series, float]:
    """Return a piece on even times, straight between its rows, and the period (s)."""
    period = float(np.median(np.diff(t)))
    steps = max(round(float(t[-1] - t[0]) / period), 1)
    grid: Series1 = t[0] + period * np.arange(steps + 1)
    return grid, read_at(grid, t, values), period


def differentiated(rows: Rows, by: Differentiator) -> Rows:
    """Return the slopes of summed rows, piece by piece; the free constants are gone."""
    n, m, c = rows.A.shape
    assert rows.piece is not None
    flat = np.concatenate([rows.A.reshape(n, m * c), rows.b], axis=1)
    times, found = list[Series1](), list[Floats]()
    for k in np.unique(rows.piece):
        mine = rows.piece == k
        if mine.sum() < FEWEST:
            continue
        grid, values, period = evenly(rows.t[mine], flat[mine])
        slope, first, early = by(values, period)
        times.append(grid[first : first + len(slope)] - early)
        found.append(slope)
    slopes = np.concatenate(found) if found else np.zeros((0, m * (c + 1)))
    A, b = slopes[:, : m * c].reshape(-1, m, c), slopes[:, m * c :]
    t = np.concatenate(times) if times else np.zeros(0)
    return replace(rows, t=t, A=A, b=b, piece=None)


def torque(by: Differentiator) -> Formulation:
    """Return the torque balance by a differentiator."""

    def rows(posed: Posed) -> Rows:
        return differentiated(body_axes(posed), by)

    return rows
