"""Rows that repeat the row before them: a camera that lost its target, a gyro that was not read.

By chance a row repeats the one before with a probability p, about the product over its axes of the
finest observed step over the typical step. A run of m repeats is named when n p^m is small:
slow motion in coarse steps repeats itself often, and then only long runs mean anything.
"""

import numpy as np
from numpy.typing import NDArray

from equipoise.assessment.record_checks.attitude_steps import steps
from equipoise.model.arrays import Series3
from equipoise.model.recording import Samples, runs

ALARMS = 0.1  # records without a frozen row in which one is named; chosen: one in ten


def frozen_attitudes(attitude: Samples) -> NDArray[np.bool_]:
    """Return the mask (n,) of attitude rows that repeat the one before and should not."""
    return _frozen(steps(attitude)[1])


def frozen_rates(rate: Samples) -> NDArray[np.bool_]:
    """Return the mask (n,) of gyro rows that repeat the one before and should not."""
    return _frozen(np.diff(rate.values, axis=0))


def _frozen(step: Series3) -> NDArray[np.bool_]:
    still = np.append(False, ~step.any(axis=1))
    chance = _chance(step)
    frozen = np.zeros(len(step) + 1, bool)
    for first, last in runs(still):
        if len(still) * chance ** (last - first + 1) < ALARMS:
            frozen[first : last + 1] = True
    return frozen


def _chance(step: Series3) -> float:
    """Return the probability of a repeat, by the steps that are no repeats."""
    size = np.abs(step[step.any(axis=1)])
    if not len(size):
        return 1.0
    finest = np.where(size > 0, size, np.inf).min(axis=0)
    typical = np.median(size, axis=0)
    axes = np.divide(finest, typical, out=np.ones(3), where=(typical > 0) & np.isfinite(finest))
    return float(np.prod(np.minimum(axes, 1.0)))
