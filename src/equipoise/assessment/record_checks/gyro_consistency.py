"""Whether gyro and attitude show the same rotation: signs, axes, units, zero.

The turn between two attitudes is compared with the integral of the gyro between their times. They
are taken far enough apart for the turn to stand out from the noise, near enough for it to be small.
"""

import math

import numpy as np
from numpy.typing import NDArray

from equipoise.assessment.record_checks.attitude_steps import steps
from equipoise.maths.straight_lines import read_at
from equipoise.model.arrays import Floats, Series3
from equipoise.model.recording import Samples

LONGEST = 1.0  # s apart; chosen: a gyro's drift is nothing yet
SMALL = math.radians(20)  # turn up to which the integral of rates is a turn within 2 % (chosen)
GAP = 3.0  # median intervals of either sensor
SURE = 0.8  # correlation from which axes are called the same (chosen)
UNSURE = 0.5  # correlation below which they are called different (chosen)
FEWEST = 10  # pairs (chosen)
ABOVE = 2.0  # of the noise of a turn, chosen: a gyro axis that turned less shows nothing of axes
OFF = 0.2  # of the scale, before it is reported (chosen: no gyro's scale is this wrong)
ZERO_OFF = math.radians(0.05)  # rad/s: a zero worth a finding (chosen)


def rate_pairs(attitude: Samples, rate: Samples) -> tuple[Series3, Series3]:
    """Return mean rates (rad/s) between pairs of attitudes, from the attitude and from the gyro."""
    lag = lag_of(attitude)
    duration, turn = steps(attitude, lag)
    start, end = attitude.t[:-lag], attitude.t[lag:]
    covered = (start >= rate.t[0]) & (end <= rate.t[-1])
    covered &= duration < GAP * np.median(duration)
    covered &= ~across_gap(rate, start, end)
    gyro = (integral(rate, end) - integral(rate, start)) / duration[:, None]
    return (turn / duration[:, None])[covered], gyro[covered]


def lag_of(attitude: Samples) -> int:
    """Return how many rows apart attitudes are compared."""
    _, turn = steps(attitude)
    size = float(np.median(np.linalg.norm(turn, axis=1)))
    most = min(LONGEST / attitude.period, SMALL / max(size, 1e-12), len(attitude) / 4)
    return max(1, int(most))


def integral(rate: Samples, at: Floats) -> Series3:
    """Return the integral of the gyro (rad) from its first row to given times, by trapezoids.

    Its mean is taken off and added again, so that the sums stay small.
    """
    mean = rate.values.mean(axis=0)
    free = rate.values - mean
    panels = 0.5 * np.diff(rate.t)[:, None] * (free[1:] + free[:-1])
    whole = np.vstack([np.zeros(3), np.cumsum(panels, axis=0)])
    return read_at(at, rate.t, whole) + np.multiply.outer(at - rate.t[0], mean)


def across_gap(rate: Samples, start: Floats, end: Floats) -> NDArray[np.bool_]:
    """Say for each span whether it touches an interval in which the gyro was silent."""
    t = rate.t
    silent = np.append(False, np.diff(t) > GAP * rate.period)
    before = np.cumsum(silent)
    first = np.maximum(np.searchsorted(t, start, side="right") - 1, 0)
    last = np.minimum(np.searchsorted(t, end, side="left"), len(t) - 1)
    return before[last] > before[first]


def repeats(camera: Series3, gyro: Series3) -> bool:
    """Say whether rates are those of the attitude to the last digit."""
    return bool(np.abs(camera - gyro).max() < 1e-9 * np.abs(camera).max())
