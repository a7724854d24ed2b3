"""Attitude and rate at common times, from whatever sensors there are: input of the linear methods.

With a camera, at the camera's times: the attitude smoothed, the rate from the gyro (averaged over
one camera period) or else from the attitude itself. With a gyro alone, at the gyro's times: the
attitude is integrated from level, as a platform on an air bearing is within its tilt limit of it.
"""

from typing import NamedTuple

import numpy as np

from equipoise.maths.attitude import exponential, level, normalise
from equipoise.maths.compiled import kernel
from equipoise.maths.local_motion import half_window, local_motion
from equipoise.model.arrays import Floats, Quaternion, Series1, Series3, Series4
from equipoise.model.recording import Recording
from equipoise.model.testbed import Testbed
from equipoise.sensors.timing import measured_at


class SampledMotion(NamedTuple):
    """What the linear methods take."""

    t: Series1
    q: Series4
    w: Series3


@kernel
def _integrate(q: Floats, half_turns: Floats) -> None:
    for i in range(1, q.shape[0]):
        a, b = q[i - 1], half_turns[i - 1]
        q[i, 0] = a[0] * b[0] - a[1] * b[1] - a[2] * b[2] - a[3] * b[3]
        q[i, 1] = a[0] * b[1] + a[1] * b[0] + a[2] * b[3] - a[3] * b[2]
        q[i, 2] = a[0] * b[2] - a[1] * b[3] + a[2] * b[0] + a[3] * b[1]
        q[i, 3] = a[0] * b[3] + a[1] * b[2] - a[2] * b[1] + a[3] * b[0]


def integrate_rate(t: Series1, w: Series3, q0: Quaternion) -> Series4:
    """Return the attitudes that rates w (rad/s) lead to from q0."""
    q = np.zeros((len(t), 4))
    q[0] = q0
    _integrate(q, exponential(0.5 * (w[1:] + w[:-1]) * np.diff(t)[:, None]))
    return normalise(q)


def averaged(t: Series1, values: Floats, at: Series1, width: float) -> Floats:
    """Return the mean of a channel over a window around each time."""
    running = np.concatenate([np.zeros((1, values.shape[1])), np.cumsum(values, axis=0)])
    first = np.searchsorted(t, at - width / 2, side="left")
    last = np.maximum(np.searchsorted(t, at + width / 2, side="right"), first + 1)
    last, first = np.minimum(last, len(t)), np.minimum(first, len(t) - 1)
    return (running[last] - running[first]) / (last - first)[:, None]


def sampled_motion(recording: Recording, testbed: Testbed) -> SampledMotion:
    """Return attitude and rate at common times."""
    attitude, rate = recording.attitude, recording.rate
    if attitude is None or len(attitude) < 4:
        assert rate is not None
        t = measured_at(rate.t, testbed.gyro)
        return SampledMotion(t, integrate_rate(t, rate.values, level(testbed.up)), rate.values)
    t = measured_at(attitude.t, testbed.attitude)
    q, w = local_motion(t, attitude.values, half_window(t, attitude.values))
    if rate is not None and len(rate):
        observed = measured_at(rate.t, testbed.gyro)
        inside = (t >= observed[0]) & (t <= observed[-1])
        period = float(np.median(np.diff(t)))
        w = np.where(inside[:, None], averaged(observed, rate.values, t, period), w)
    return SampledMotion(t, q, w)
