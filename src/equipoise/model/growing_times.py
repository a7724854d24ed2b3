"""Times that ought to grow: where a counter restarted, and the longest run that does not fall."""

from array import array
from bisect import bisect_right

import numpy as np

from equipoise.model.arrays import Ints, Series1
from equipoise.model.units import US

LATE = 20.0  # usual steps that a counter may have gone on by when it is seen again (chosen)
BITS = (16, 32)  # of counters, in the column's unit
PERIODS = (2**32 * US, 86_400.0, 43_200.0, 604_800.0)  # s: micros(), a day, its half, a week
PART = 1 << 16  # times that are Python's numbers at once (chosen)


def wraps(t: Series1, unit: float) -> list[tuple[int, float]]:
    """Return where a clock (s, of a counter's ``unit``) restarted, and after how long (s)."""
    steps = np.diff(t)
    ahead, back = steps[steps > 0], np.flatnonzero(steps < 0)
    if not len(back) or not len(ahead):
        return []
    late = LATE * float(np.median(ahead))
    lengths = [2.0**bits * unit for bits in BITS] + list(PERIODS)
    found: list[tuple[int, float]] = []
    for k in back.tolist():
        fits = [length for length in lengths if 0 < steps[k] + length <= late]
        found += [(k + 1, length) for length in fits[:1]]
    return found


def longest_rising(t: Series1) -> Ints:
    """Return the places of the longest subsequence that does not fall, by patience sorting."""
    ends = array("d")  # of the best run of each length
    places = array("q")  # where that is
    before = np.full(len(t), -1, dtype=np.int64)
    values = (x for at in range(0, len(t), PART) for x in t[at : at + PART].tolist())
    for k, value in enumerate(values):
        length = len(ends) if not ends or value >= ends[-1] else bisect_right(ends, value)
        before[k] = places[length - 1] if length else -1
        if length == len(ends):
            ends.append(value)
            places.append(k)
        else:
            ends[length], places[length] = value, k
    kept = np.empty(len(ends), dtype=np.int64)
    place = places[-1]
    for k in reversed(range(len(kept))):
        kept[k], place = place, int(before[place])
    return kept
