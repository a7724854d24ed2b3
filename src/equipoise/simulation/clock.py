"""The bench's clock: time in whole nanoseconds.

Reads of 0.1 s add up to whole seconds only if each sum is rounded, and two moments that should be
one (a camera frame and a gyro row) must not differ by rounding: a mass's speed is taken from
neighbouring moments. Rounding also makes the motion independent of how a run is cut into reads.
"""

import numpy as np

from equipoise.model.arrays import Floats, Series1

DIGITS = 9  # of a second, chosen: far below any sensor's period, far above rounding


def tick(t: Floats) -> Floats:
    """Return times (s) rounded to the nanosecond."""
    return np.round(t, DIGITS)


def tick_one(t: float) -> float:
    """Return one time (s) rounded to the nanosecond."""
    return float(np.round(t, DIGITS))


def multiples(period: float, after: float, until: float) -> Series1:
    """Return the multiples of a period, zero and up, in (after, until], s."""
    first = max(int(np.floor(after / period)) - 1, 0)
    t = tick(period * np.arange(first, int(np.ceil(until / period)) + 2, dtype=np.float64))
    return t[(t > after) & (t <= until)]


def samples(rate: float, after: float, until: float) -> Series1:
    """Return the times k / rate (Hz), k zero and up, in (after, until], s."""
    first = max(int(np.floor(after * rate)) - 1, 0)
    t = tick(np.arange(first, int(np.ceil(until * rate)) + 2, dtype=np.float64) / rate)
    return t[(t > after) & (t <= until)]
