"""What many runs found: median and middle 95 % of groups, where single ones hide each other."""

from collections.abc import Sequence
from datetime import datetime

import numpy as np

from equipoise.app.figures.study.trend import Band
from equipoise.model.arrays import Series, Series1

CROWDED = 2000  # runs, chosen: that many points and bars fill a figure
GROUPS = 300  # chosen: about as many as a figure has places for
MIDDLE = (0.025, 0.5, 0.975)


def over_time(times: Sequence[datetime], values: Series) -> list[Band]:
    """Return a band for each column of values; nothing where runs can stand one by one."""
    if len(times) <= CROWDED:
        return []
    at = np.array(times, dtype="datetime64[us]").astype(np.int64)
    bands = over(at.astype(np.float64), values)
    return [b._replace(at=b.at.astype(np.int64).astype("datetime64[us]")) for b in bands]


def over(x: Series1, values: Series) -> list[Band]:
    """Return a band for each column of values, over x; rows without a number are left out."""
    return [_band(x[known], column[known]) for column in values.T
            for known in [np.isfinite(column) & np.isfinite(x)]]  # fmt: skip


def _band(x: Series1, y: Series1) -> Band:
    """Return the quantiles of groups, each of its share of the rows in the order of x."""
    order = np.argsort(x, kind="stable")
    groups = [group for group in np.array_split(order, GROUPS) if len(group)]
    rows = [np.quantile(y[group], MIDDLE) for group in groups]
    low, middle, high = np.reshape(rows, (-1, len(MIDDLE))).T
    return Band(x[[group[len(group) // 2] for group in groups]], low, middle, high)
