"""A sampled function of time as fewer straight pieces.

Knots are found by halving where a chord is farthest off, until none is off by more than a tolerance
(Ramer 1972, Douglas and Peucker 1973). The values at the knots are then those of the least squared
distance from all rows,

    minimise  sum_j | v_j - (1 - s_j) x_k - s_j x_(k+1) |^2         s: share of the piece behind k

because chords lie on one side of a bend, and what is summed over many bends must not.
"""

from itertools import pairwise

import numpy as np
import scipy

from equipoise.model.arrays import Bools, Floats, Ints, Series, Series1

NONE: Ints = np.zeros(0, dtype=np.int64)


def off_chord(t: Series1, v: Series, first: int, last: int) -> Floats:
    """Return how far (columns) the rows between two lie off the straight line between these."""
    share = (t[first + 1 : last] - t[first]) / (t[last] - t[first])
    return np.abs(v[first + 1 : last] - v[first] - share[:, None] * (v[last] - v[first]))


def knots(t: Series1, v: Series, tolerance: Floats, firm: Ints = NONE) -> Ints:
    """Return the rows between which straight lines are nowhere off by more than ``tolerance``."""
    keep: Bools = np.zeros(len(t), dtype=bool)
    keep[[0, -1]] = True
    keep[firm] = True
    open_pieces = list(pairwise(np.flatnonzero(keep).tolist()))
    while open_pieces:
        first, last = open_pieces.pop()
        if last - first < 2:
            continue
        off = (off_chord(t, v, first, last) / tolerance).max(axis=1)
        worst = int(np.argmax(off))
        if off[worst] > 1:
            middle = first + 1 + worst
            keep[middle] = True
            open_pieces += [(first, middle), (middle, last)]
    return np.flatnonzero(keep)


def nearest_values(t: Series1, v: Series, at: Ints) -> Floats:
    """Return the values at knots whose straight lines are nearest to all rows."""
    k = np.clip(np.searchsorted(at, np.arange(len(t)), side="right") - 1, 0, len(at) - 2)
    s = (t - t[at[k]]) / (t[at[k + 1]] - t[at[k]])
    n = len(at)
    band = np.zeros((2, n))  # over the diagonal, and the diagonal
    band[0, 1:] = np.bincount(k, s * (1 - s), n - 1)
    band[1] = np.bincount(k, (1 - s) ** 2, n) + np.bincount(k + 1, s**2, n)
    right = [np.bincount(k, (1 - s) * x, n) + np.bincount(k + 1, s * x, n) for x in v.T]
    return scipy.linalg.solveh_banded(band, np.column_stack(right))


def straight_pieces(
    t: Series1, v: Series, tolerance: Floats, firm: Ints = NONE
) -> tuple[Series1, Series]:
    """Return times and values of fewer rows; ``tolerance`` is one number a column.

    The rows ``firm`` are knots.
    """
    if len(t) < 3:
        return t, v
    at = knots(t, v, tolerance, firm)
    return t[at], np.ascontiguousarray(nearest_values(t, v, at))
