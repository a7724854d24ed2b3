"""What a gyro's own numbers tell: coarse steps, a first row of zeros, a dead axis, its noise."""

import math

import numpy as np

from equipoise.assessment.finding import Finding
from equipoise.model.arrays import Series1
from equipoise.model.recording import Samples

MANY = 0.5  # share of rows with a value of their own above which nothing is quantised (chosen)
WHOLE = 1e-3  # of a step, by which values may miss whole multiples of it (chosen: rounding)
COARSE = 2.0  # sd of the noise: finer steps are smeared by it and do no harm
FEWEST = 20  # rows that quantisation is told from (chosen)
THIRD = math.sqrt(20)  # sd of the third difference of unit white noise
ROBUST_SD = 1.4826  # median absolute deviation to sd, for normal scatter


def rate_findings(rate: Samples | None) -> list[Finding]:
    """Return what is odd about a gyro, and how noisy it is."""
    if rate is None or len(rate) < 4:
        return []
    axes = list(zip("xyz", rate.values.T, strict=True))
    return [
        *(f for name, x in axes for f in _dead(name, x)),
        *(f for name, x in axes for f in _quantised(name, x)),
        *_zero_start(rate),
        _noise(rate),
    ]


def step_of(x: Series1) -> float | None:
    """Return the step that all values are whole multiples of apart, None if there is none."""
    levels = np.unique(x)
    if len(x) < FEWEST or not 1 < len(levels) < MANY * len(x):
        return None
    gaps = np.diff(levels)
    # Values that went through a change of unit differ in the last bits: those are no steps.
    gaps = gaps[gaps > 1e-9 * np.abs(levels).max()]
    step = float(gaps.min())
    return step if np.abs(gaps / step - np.round(gaps / step)).max() < WHOLE else None


def _quantised(name: str, x: Series1) -> list[Finding]:
    step = step_of(x)
    if step is None:
        return []
    text = f"gyro {name} comes in steps of {math.degrees(step):.3g} deg/s."
    noise = float(np.std(np.diff(x, n=3))) / THIRD
    return [Finding("problem" if step > COARSE * noise else "content", text)]


def _dead(name: str, x: Series1) -> list[Finding]:
    if np.ptp(x) > 0:
        return []
    return [Finding("problem", f"gyro {name} is {math.degrees(x[0]):.3g} deg/s in every row.")]


def _zero_start(rate: Samples) -> list[Finding]:
    """Return a finding when the first row is exactly zero and the next is far from it."""
    if rate.values[0].any() or not rate.values[1:4].any():
        return []
    typical = np.median(np.abs(np.diff(rate.values[1:], axis=0)))
    if np.abs(rate.values[1]).max() <= 3 * typical:
        return []
    text = "rates start at exactly zero: they look like backward differences, not like a gyro."
    return [Finding("problem", text, (float(rate.t[0]), float(rate.t[1])))]


def _noise(rate: Samples) -> Finding:
    third = np.diff(rate.values, n=3, axis=0)
    spread = ROBUST_SD * np.median(np.abs(third), axis=0) / THIRD
    noise = math.degrees(float(np.sqrt(np.mean(spread**2))))
    return Finding("content", f"gyro noise: {noise:.2g} deg/s per axis at most, white part.")
