"""Medians and quantiles of numbers too many for memory, exact: digit by digit, pass after pass.

The bits of doubles that are not negative, read as whole numbers, have the doubles' order.
"""

from collections.abc import Callable, Iterator

import numpy as np

from equipoise.model.arrays import Series1

DIGIT = 16  # bits that a pass finds (chosen: 65536 counts)
Parts = Callable[[], Iterator[Series1]]  # each call restarts


def streamed_median(parts: Parts) -> float:
    """Return the median of finite numbers of which none is negative."""
    count = sum(map(len, parts()))
    low, high = (ranked(parts, rank) for rank in ((count - 1) // 2, count // 2))
    return (low + high) / 2


def streamed_quantile(parts: Parts, share: float) -> float:
    """Return a quantile of such numbers, between the two nearest by a straight line."""
    at = share * (sum(map(len, parts())) - 1)
    low, high = (ranked(parts, rank) for rank in (int(np.floor(at)), int(np.ceil(at))))
    return low + (high - low) * (at - float(np.floor(at)))


def ranked(parts: Parts, rank: int) -> float:
    """Return the number of a rank, from 0 for the smallest."""
    found = 0
    for shift in range(64 - DIGIT, -1, -DIGIT):
        counts = np.zeros(1 << DIGIT, dtype=np.int64)
        for part in parts():
            digits = (part + 0.0).view(np.int64) >> shift  # -0.0 becomes 0.0
            here = digits[digits >> DIGIT == found] & ((1 << DIGIT) - 1)
            counts += np.bincount(here, minlength=len(counts))
        below = np.cumsum(counts)
        digit = int(np.searchsorted(below, rank, side="right"))
        rank -= int(below[digit] - counts[digit])
        found = found << DIGIT | digit
    return float(np.int64(found).view(np.float64))
