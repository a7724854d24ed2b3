"""How far the platform tilts, and how fast it spins about the laboratory's vertical."""

import math

import numpy as np

from equipoise.assessment.record_checks.attitude_steps import even_steps
from equipoise.maths.attitude import tilt, to_matrix
from equipoise.model.arrays import Series1, Vector3
from equipoise.model.finding import Finding
from equipoise.model.reasons.finding_reasons import FindingReason as Why
from equipoise.model.reasons.reason import one_reason
from equipoise.model.recording import Samples

UPRIGHT = math.radians(60)  # chosen: no table on a hemisphere swings about a tilt beyond this
SHARE = 0.1  # of the record at either end over which a spin is taken (chosen)
AXES = {
    sign + "xyz"[i]: (1.0 if sign == "" else -1.0) * np.eye(3)[i]
    for i in range(3)
    for sign in ("", "-")
}


def motion_findings(attitude: Samples | None, up: Vector3 | None) -> list[Finding]:
    """Return tilt range and spin; without a testbed the most upright body axis is taken as up."""
    if attitude is None or len(attitude) < 3:
        return []
    guess = most_upright(attitude)
    axis = AXES[guess] if up is None else up
    angles = tilt(attitude.values, axis)
    return [_tilt(angles, guess, up is not None), *_frame(angles, guess), _spin(attitude)]


def most_upright(attitude: Samples) -> str:
    """Return the body axis that stays nearest the vertical."""
    return min(AXES, key=lambda name: float(np.median(tilt(attitude.values, AXES[name]))))


def _tilt(angles: np.ndarray, guess: str, reported: bool) -> Finding:
    numbers = {"low": float(angles.min()), "high": float(angles.max())}
    if reported:
        return Finding("motion", one_reason(Why.TILT_RANGE, **numbers))
    return Finding("motion", one_reason(Why.TILT_RANGE_OF_AXIS, guess, **numbers))


def _frame(angles: np.ndarray, guess: str) -> list[Finding]:
    middle = float(np.median(angles))
    if middle < UPRIGHT:
        return []
    return [Finding("problem", one_reason(Why.GRAVITY_NOT_DOWN, guess, tilt=middle))]


def heading_rate(attitude: Samples) -> tuple[Series1, Series1]:
    """Return times (s) and the rate about the laboratory's vertical (rad/s) between even rows."""
    middle, rate = even_steps(attitude)
    at = np.searchsorted(attitude.t, middle) - 1
    return middle, np.einsum("ni,ni->n", to_matrix(attitude.values[at])[:, 2, :], rate)


def _spin(attitude: Samples) -> Finding:
    """Return the rate about the vertical at both ends of the record."""
    _, vertical = heading_rate(attitude)
    n = max(1, int(SHARE * len(vertical)))
    first, last = (float(np.median(part)) for part in (vertical[:n], vertical[-n:]))
    limit = math.pi / attitude.period
    return Finding("motion", one_reason(Why.SPIN, first=first, last=last, limit=limit))
