"""The turn from each attitude to the next, as a rotation vector in body axes."""

import numpy as np

from equipoise.maths.attitude import difference
from equipoise.model.arrays import Series1, Series3
from equipoise.model.recording import Samples

EVEN = 0.2  # of the median interval; steps beyond this are left out of averages (chosen)


def steps(attitude: Samples, lag: int = 1) -> tuple[Series1, Series3]:
    """Return the durations (s) and turns (rad) over ``lag`` rows."""
    q = attitude.values
    return attitude.t[lag:] - attitude.t[:-lag], difference(q[lag:], q[:-lag])


def even_steps(attitude: Samples) -> tuple[Series1, Series3]:
    """Return the times (s) and turn rates (rad/s) of steps as long as most are."""
    duration, turn = steps(attitude)
    even = np.abs(duration / attitude.period - 1) < EVEN
    middle = 0.5 * (attitude.t[1:] + attitude.t[:-1])
    return middle[even], turn[even] / duration[even, None]
