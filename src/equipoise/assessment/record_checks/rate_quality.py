"""What a gyro's own numbers show: coarse steps, a first row of zeros, a dead axis, its noise."""

import numpy as np

from equipoise.assessment.record_checks.quantisation import THIRD, quantisation_findings
from equipoise.assessment.record_checks.robust_scatter import robust_sd
from equipoise.model.arrays import Series1
from equipoise.model.finding import Finding
from equipoise.model.reasons.finding_reasons import FindingReason as Why
from equipoise.model.reasons.reason import one_reason
from equipoise.model.recording import Samples


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
