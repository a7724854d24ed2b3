"""Whether gyro and attitude show the same rotation: signs, axes, units, zero.

The turn between two attitudes is compared with the integral of the gyro between their times. They
are taken far enough apart for the turn to stand out from the noise, near enough for it to be small.
"""

import math

import numpy as np
from numpy.typing import NDArray

from equipoise.assessment.record_checks.attitude_noise import attitude_noise
from equipoise.assessment.record_checks.attitude_steps import steps
from equipoise.maths.straight_lines import read_at
from equipoise.model.arrays import Floats, Matrix3, Series3
from equipoise.model.finding import Finding
from equipoise.model.reasons.finding_reasons import FindingReason as Why
from equipoise.model.reasons.reason import axes_of, one_reason
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


def agreement_findings(attitude: Samples | None, rate: Samples | None) -> list[Finding]:
    """Return disagreements of sign, axis, scale and zero, or that there are none."""
    if attitude is None or rate is None or min(len(attitude), len(rate)) < FEWEST:
        return []
    camera, gyro = rate_pairs(attitude, rate)
    if len(camera) < FEWEST:
        return [Finding("problem", one_reason(Why.NO_OVERLAP))]
    if _repeats(camera, gyro):
        return [Finding("problem", one_reason(Why.RATES_DERIVED))]
    likeness = correlation(gyro, camera)
    turned = np.std(gyro, axis=0) > ABOVE * _noise(attitude)
    wrong = [f for axis in np.flatnonzero(turned) for f in _axis(int(axis), likeness, camera, gyro)]
    if wrong:
        return wrong
    return _zero(likeness, camera, gyro)


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


def correlation(gyro: Series3, camera: Series3) -> Matrix3:
    """Return the correlation of each gyro axis (row) with each attitude axis (column)."""
    a, b = gyro - gyro.mean(axis=0), camera - camera.mean(axis=0)
    scale = np.outer(np.linalg.norm(a, axis=0), np.linalg.norm(b, axis=0))
    return (a.T @ b) / np.where(scale > 0, scale, np.inf)


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


def _noise(attitude: Samples) -> float:
    """Return the noise of rates from attitudes, rad/s; 0 where there are too few rows for it."""
    return math.sqrt(2) * (attitude_noise(attitude) or 0.0) / (lag_of(attitude) * attitude.period)


def _repeats(camera: Series3, gyro: Series3) -> bool:
    return bool(np.abs(camera - gyro).max() < 1e-9 * np.abs(camera).max())


def _axis(axis: int, likeness: Matrix3, camera: Series3, gyro: Series3) -> list[Finding]:
    """Return what is wrong with one gyro axis."""
    name, row = "xyz"[axis], likeness[axis]
    other = int(np.argmax(np.abs(row)))
    if row[axis] < -SURE:
        wrong = one_reason(Why.OPPOSITE_SIGN, name, correlation=float(row[axis]))
    elif other != axis and abs(row[other]) > SURE and abs(row[axis]) < UNSURE:
        code = Why.OTHER_AXIS if row[other] > 0 else Why.OTHER_AXIS_REVERSED
        wrong = one_reason(code, name, "xyz"[other], correlation=float(row[other]))
    elif row[axis] > SURE and abs(_slope(axis, camera, gyro) - 1) > OFF:
        wrong = one_reason(Why.OTHER_SCALE, name, scale=_slope(axis, camera, gyro))
    else:
        return []
    return [Finding("problem", wrong)]


def _slope(axis: int, camera: Series3, gyro: Series3) -> float:
    """Return the gyro's scale against the attitude's."""
    return float(np.std(gyro[:, axis]) / np.std(camera[:, axis]))


def _zero(likeness: Matrix3, camera: Series3, gyro: Series3) -> list[Finding]:
    """Return the gyro's zero and that its axes agree, if the motion suffices."""
    offset = np.median(gyro - camera, axis=0)
    reported = [name for name, c in zip("xyz", np.diag(likeness), strict=True) if c > SURE]
    agree = (
        one_reason(Why.SENSORS_AGREE, *reported) if reported else one_reason(Why.TOO_LITTLE_MOTION)
    )
    found = [Finding("content", agree)]
    if np.abs(offset).max() > ZERO_OFF:
        found.append(Finding("content", one_reason(Why.GYRO_ZERO, **axes_of("zero", offset))))
    return found
