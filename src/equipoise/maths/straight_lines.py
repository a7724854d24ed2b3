"""Series read between their rows, along straight lines; constant outside."""

import numpy as np

from equipoise.model.arrays import Floats, Series, Series1


def read_at(at: Series1, t: Series1, values: Series) -> Series:
    """Return the columns of ``values`` (n, k), given at times t, at other times."""
    columns: list[Floats] = [np.interp(at, t, column) for column in values.T]
    return np.column_stack(columns) if columns else np.zeros((len(at), 0))


def integral_at(at: Series1, t: Series1, values: Series) -> Series:
    """Return the integral of the lines from ``at[0]`` on, exact however they jump between rows."""
    inside = t[(t > at[0]) & (t < at[-1])]
    times = np.union1d(at, inside)
    lines = read_at(times, t, values)
    steps = 0.5 * (lines[1:] + lines[:-1]) * np.diff(times)[:, None]
    total = np.concatenate([np.zeros((1, values.shape[1])), np.cumsum(steps, axis=0)])
    return total[np.searchsorted(times, at)]
