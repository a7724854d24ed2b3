"""Series read between their rows, along straight lines; constant outside."""

import numpy as np

from equipoise.model.arrays import Bools, Floats, Series, Series1

STRAIGHT = 1e-9  # of the greatest slope, chosen: by which slopes differ by rounding alone


def read_at(at: Series1, t: Series1, values: Series) -> Series:
    """Return the columns of ``values`` (n, k), given at times t, at other times."""
    columns: list[Floats] = [np.interp(at, t, column) for column in values.T]
    return np.column_stack(columns) if columns else np.zeros((len(at), 0))


def bends(t: Series1, values: Series) -> Bools:
    """Return at which rows but the first and last (n - 2,) any column of values (n, k) bends."""
    slope = np.diff(values, axis=0) / np.diff(t)[:, None]
    size = np.abs(slope).max(initial=0.0) + 1e-300
    return np.any(np.abs(np.diff(slope, axis=0)) > STRAIGHT * size, axis=1)


def integral_at(at: Series1, t: Series1, values: Series) -> Series:
    """Return the integral of the lines from ``at[0]`` on, exact however they jump between rows."""
    inside = t[(t > at[0]) & (t < at[-1])]
    times = np.union1d(at, inside)
    lines = read_at(times, t, values)
    steps = 0.5 * (lines[1:] + lines[:-1]) * np.diff(times)[:, None]
    total = np.concatenate([np.zeros((1, values.shape[1])), np.cumsum(steps, axis=0)])
    return total[np.searchsorted(times, at)]
