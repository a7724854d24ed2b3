"""Rows of records as rows of charts: few enough to draw, in the unit shown.

Of a long record each stretch of time keeps its least and its greatest, so that no spike is lost.
"""

from collections.abc import Sequence
from itertools import pairwise

import numpy as np

from equipoise.app.figures.base.style import BAND
from equipoise.app.text.charts import Mark, Numbers, Rows
from equipoise.model.arrays import Floats, Series, Series1

STRETCHES = 900  # of a record, chosen: more than a screen shows apart, few enough for a file
GAP = 10.0  # times the median step, chosen: a line is broken there
NUDGE = 1e-6  # of the record, chosen: less than any zoom shows
DIGITS = 6  # of a number, chosen: what a zoom of a thousand times shows


def rows_of(
    names: Sequence[str], t: Series1, values: Series, size: float, mark: Mark = "line"
) -> Rows:
    """Return columns (n, k) SI over t; ``size`` is the unit's."""
    t, every = _increasing(t), [values / size]
    if mark == "line":
        t, every = _broken(t, every)
    x, (columns,) = _few(t, every)
    return Rows(tuple(names), x, columns, mark=mark)


def straight(names: Sequence[str], t: Series1, values: Series, size: float) -> Rows:
    """Return columns (n, k) SI that are straight between rows, however far apart these are."""
    x, (columns,) = _few(_increasing(t), [values / size])
    return Rows(tuple(names), x, columns)


def banded(names: Sequence[str], t: Series1, values: Series, sd: Series, size: float) -> Rows:
    """Return the same with bands of two sd."""
    low, high = (values - BAND * sd) / size, (values + BAND * sd) / size
    t, every = _broken(_increasing(t), [values / size, low, high])
    x, (columns, lows, highs) = _few(t, every)
    return Rows(tuple(names), x, columns, lows, highs)


def _few(t: Series1, every: list[Series]) -> tuple[tuple[float, ...], list[tuple[Numbers, ...]]]:
    """Return abscissae and columns, no more of them than are drawn."""
    if len(t) > 2 * STRETCHES:
        t, every = _extremes(t, every)
    x = tuple(float(f"{at:.9g}") for at in t.tolist())
    return x, [tuple(map(_column, of.T)) for of in every]


def _increasing(t: Series1) -> Series1:
    """Return times in which those that are equal follow each other by a little."""
    if len(t) < 2:
        return t
    ties = np.cumsum(np.diff(t, prepend=-np.inf) <= 0)
    return t + NUDGE * (t[-1] - t[0]) * ties


def _broken(t: Series1, every: list[Series]) -> tuple[Series1, list[Series]]:
    """Return rows with an unknown one in each gap."""
    if len(t) < 3:
        return t, every
    gap = np.flatnonzero(np.diff(t) > GAP * np.median(np.diff(t))) + 1
    middle = (t[gap - 1] + t[gap]) / 2
    return np.insert(t, gap, middle), [np.insert(of, gap, np.nan, axis=0) for of in every]


def _extremes(t: Series1, every: list[Series]) -> tuple[Series1, list[Series]]:
    """Return two rows a stretch: least and greatest of each column, in their order."""
    gaps = np.flatnonzero(np.isnan(every[0]).all(axis=1))  # by themselves, so that they stay
    even = np.linspace(0, len(t), STRETCHES + 1).astype(np.int64)
    edges = np.unique(np.concatenate([even, gaps, gaps + 1]))
    of_stretch = [slice(a, b) for a, b in pairwise(edges)]
    x = np.concatenate([[t[s][0], t[s][-1]] for s in of_stretch])
    return x, [np.vstack([_least_and_greatest(of[s]) for s in of_stretch]) for of in every]


def _least_and_greatest(part: Floats) -> Floats:
    """Return (2, k): the least and the greatest of columns, whichever comes first above."""
    known = np.where(np.isnan(part), np.inf, part), np.where(np.isnan(part), -np.inf, part)
    low, high = np.argmin(known[0], axis=0), np.argmax(known[1], axis=0)
    rows = np.sort([low, high], axis=0)
    return np.take_along_axis(part, rows, axis=0)


def _column(values: Floats) -> Numbers:
    return tuple(_short(v) if np.isfinite(v) else None for v in values.tolist())


def _short(value: float) -> float:
    return float(f"{value:.{DIGITS}g}")
