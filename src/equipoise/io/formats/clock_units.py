"""Seconds of a bench's clock to whole nanoseconds of a log's, and back.

A log counts nanoseconds in whole numbers. A time that has no more than nine decimals comes back as
the same double; any other to the nearest nanosecond.
"""

import numpy as np

from equipoise.model.arrays import Ints, Series1

PER_S, PER_MS, PER_US = 10**9, 10**6, 10**3


def nanoseconds(t: float) -> int:
    """Return a time (s) in whole nanoseconds."""
    whole = int(t)  # apart from the rest: a date in seconds times 1e9 is beyond a double's digits
    return whole * PER_S + round((t - whole) * 1e9)


def seconds(ns: Ints) -> Series1:
    """Return times in s, each the double nearest to its nanoseconds."""
    # Python divides whole numbers exactly and rounds once; NumPy would round them first.
    return np.array([count / PER_S for count in ns.tolist()], dtype=np.float64)
