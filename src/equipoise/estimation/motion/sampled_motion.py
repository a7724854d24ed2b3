"""Attitude and rate at common times, from whatever sensors there are: input of the linear methods.

With a camera, at the camera's times: the attitude smoothed, the rate from the gyro (averaged over
one camera period) or else from the attitude itself. With a gyro alone, at the gyro's times: the
attitude is integrated from level, as a platform on an air bearing is within its tilt limit of it,
or from what sensors of vectors show (``vector_attitude``).
"""

from typing import NamedTuple

import numpy as np

from equipoise.estimation.motion.observed_vectors import observed
from equipoise.estimation.motion.vector_attitude import attitude_by_vectors, integrate_rate
from equipoise.maths.attitude import level
from equipoise.maths.local_motion import half_window, local_motion
from equipoise.model.arrays import Floats, Ints, Series1, Series3, Series4
from equipoise.model.recording import Recording
from equipoise.model.testbed import Testbed
from equipoise.sensors.timing import measured_at

ENOUGH = 4  # rows of a camera, of which attitude and rate are taken


class SampledMotion(NamedTuple):
    """What the linear methods take."""

    t: Series1
    q: Series4
    w: Series3


def averaged(t: Series1, values: Floats, at: Series1, width: float) -> Floats:
    """Return the mean of a channel over a window around each time."""
    running = np.concatenate([np.zeros((1, values.shape[1])), np.cumsum(values, axis=0)])
    first, last = rows_around(t, at, width)
    return (running[last] - running[first]) / (last - first)[:, None]


def rows_around(t: Series1, at: Series1, width: float) -> tuple[Ints, Ints]:
    """Return the rows of a channel in a window around each time: the first, and behind the last."""
    first = np.searchsorted(t, at - width / 2, side="left")
    last = np.maximum(np.searchsorted(t, at + width / 2, side="right"), first + 1)
    return np.minimum(first, len(t) - 1), np.minimum(last, len(t))


def sampled_motion(recording: Recording, testbed: Testbed) -> SampledMotion:
    """Return attitude and rate at common times."""
    attitude, rate = recording.attitude, recording.rate
    if attitude is None or len(attitude) < ENOUGH:
        assert rate is not None
        t, vectors = measured_at(rate.t, testbed.gyro), observed(recording, testbed)
        if vectors:
            return SampledMotion(t, *attitude_by_vectors(vectors, t, rate.values, testbed.gyro))
        return SampledMotion(t, integrate_rate(t, rate.values, level(testbed.up)), rate.values)
    t = measured_at(attitude.t, testbed.attitude)
    q, w = local_motion(t, attitude.values, half_window(t, attitude.values))
    if rate is not None and len(rate):
        rate_t = measured_at(rate.t, testbed.gyro)
        inside = (t >= rate_t[0]) & (t <= rate_t[-1])
        period = float(np.median(np.diff(t)))
        w = np.where(inside[:, None], averaged(rate_t, rate.values, t, period), w)
    return SampledMotion(t, q, w)
