"""The noise of an attitude sensor, estimated from differences of neighbouring rows.

The k-th difference of white noise with variance s^2 has variance s^2 C(2k, k) (20 s^2 for the
third), while that of a smooth motion dies away with k. The least over several k is an upper bound
that is close when the sensor is fast against the motion.
"""

import math

import numpy as np

from equipoise.assessment.record_checks.attitude_steps import EVEN, steps
from equipoise.assessment.record_checks.robust_scatter import robust_sd
from equipoise.model.arrays import Series3
from equipoise.model.finding import Finding
from equipoise.model.reasons.finding_reasons import FindingReason as Why
from equipoise.model.reasons.reason import one_reason
from equipoise.model.recording import Samples

ORDERS = range(3, 8)  # chosen: beyond, neighbouring differences are all but the same number
FEWEST = 20  # differences that a scatter is estimated from (chosen)


def noise_findings(attitude: Samples | None) -> list[Finding]:
    """Return the noise in deg per axis, if the record is long enough to show it."""
    noise = None if attitude is None else attitude_noise(attitude)
    if noise is None:
        return []
    return [Finding("content", one_reason(Why.ATTITUDE_NOISE, noise=noise))]


def attitude_noise(attitude: Samples) -> float | None:
    """Return the white noise, rad per axis and sample; None if there are too few even rows."""
    if len(attitude) < FEWEST + max(ORDERS):
        return None
    duration, turn = steps(attitude)
    even = np.abs(duration / attitude.period - 1) < EVEN
    turn = np.where(even[:, None], turn, np.nan)  # a difference across a gap is no difference
    found = [_scatter(turn, order) for order in ORDERS]
    reported = [noise for noise in found if noise is not None]
    return min(reported, default=None)


def _scatter(turn: Series3, order: int) -> float | None:
    """Return the noise by differences of one order; a turn is the first difference already."""
    high = np.diff(turn, n=order - 1, axis=0)
    high = high[~np.isnan(high).any(axis=1)]
    if len(high) < FEWEST:
        return None
    spread = robust_sd(high) / math.sqrt(math.comb(2 * order, order))
    return float(np.sqrt(np.mean(spread**2)))
