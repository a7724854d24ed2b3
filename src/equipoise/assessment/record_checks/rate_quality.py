"""What a gyro's own numbers show: coarse steps, a first row of zeros, a dead axis, its noise.

Rounding to steps of d adds an error of d / sqrt(12). Noise of half a step and more makes it white;
below that it follows the motion, and rows that stand still show nothing.
"""

import math

import numpy as np

from equipoise.assessment.record_checks.robust_scatter import robust_sd
from equipoise.model.arrays import Series1
from equipoise.model.finding import Finding
from equipoise.model.reasons.finding_reasons import FindingReason as Why
from equipoise.model.reasons.reason import one_reason
from equipoise.model.recording import Samples

MANY = 0.5  # share of rows with a value of their own above which nothing is quantised (chosen)
WHOLE = 1e-3  # of a step, by which values may miss whole multiples of it (chosen: rounding)
COARSE = 2.0  # sd of the noise: finer steps are smeared by it and do no harm
FEWEST = 20  # rows for a verdict on quantisation (chosen)
THIRD = math.sqrt(20)  # sd of the third difference of unit white noise


def rate_findings(rate: Samples | None) -> list[Finding]:
    """Return what is odd about a gyro, and how noisy it is."""
    if rate is None or len(rate) < 4:
        return []
    axes = list(zip("xyz", rate.values.T, strict=True))
    return [
        *(f for name, x in axes for f in _dead(name, x)),
        *quantisation_findings(rate),
        *_zero_start(rate),
        _noise(rate),
    ]


def _dead(name: str, x: Series1) -> list[Finding]:
    if np.ptp(x) > 0:
        return []
    return [Finding("problem", one_reason(Why.DEAD_AXIS, name, rate=float(x[0])))]


def _zero_start(rate: Samples) -> list[Finding]:
    """Return a finding when the first row is exactly zero and the next is far from it."""
    if rate.values[0].any() or not rate.values[1:4].any():
        return []
    typical = np.median(np.abs(np.diff(rate.values[1:], axis=0)))
    if np.abs(rate.values[1]).max() <= 3 * typical:
        return []
    return [Finding("problem", one_reason(Why.ZERO_START), (float(rate.t[0]), float(rate.t[1])))]


def rate_noise(rate: Samples) -> float:
    """Return the white noise, rad/s per axis and sample, at most; 0 if steps are coarser."""
    third = np.diff(rate.values, n=3, axis=0)
    spread = robust_sd(third) / THIRD
    return float(np.sqrt(np.mean(spread**2)))


def _noise(rate: Samples) -> Finding:
    return Finding("content", one_reason(Why.GYRO_NOISE, noise=rate_noise(rate)))


def quantisation_findings(rate: Samples) -> list[Finding]:
    """Return the step of each axis that has one: a problem where it is above the noise."""
    return [f for name, x in zip("xyz", rate.values.T, strict=True) for f in _quantised(name, x)]


def step_of(x: Series1) -> float | None:
    """Return the step that all values are whole multiples of apart, None if there is none."""
    levels = np.unique(x)
    if len(x) < FEWEST or not 1 < len(levels) < MANY * len(x):
        return None
    gaps = np.diff(levels)
    # Values that went through a change of unit differ in the last bits: those are no steps.
    gaps = gaps[gaps > 1e-9 * np.abs(levels).max()]
    step = float(gaps.min(initial=np.inf))
    if np.isinf(step):
        return None
    return step if np.abs(gaps / step - np.round(gaps / step)).max() < WHOLE else None


def _quantised(name: str, x: Series1) -> list[Finding]:
    step = step_of(x)
    if step is None:
        return []
    found = one_reason(Why.QUANTISED, name, step=step)
    noise = float(np.std(np.diff(x, n=3))) / THIRD
    return [Finding("problem" if step > COARSE * noise else "content", found)]
