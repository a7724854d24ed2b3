"""How much later the attitude is stamped than the gyro, by the motion that both measured.

    turn(t, t + D) / D = 1/D int w(s - lag) ds + zero        least squares in the lag and the zero

The turn between two attitudes is compared with the integral of the gyro (``gyro_consistency``).
A camera that is ``lag`` seconds late shows at t what the gyro showed at t - lag. Only motion whose
rate changes shows it. The sd is that of the fit, with the correlation that two turns have by the
attitude that they share. Middles of averaging windows count as the moments of rows.
"""

from dataclasses import dataclass

import numpy as np

from equipoise.assessment.record_checks.attitude_steps import steps
from equipoise.assessment.record_checks.gyro_consistency import (
    FEWEST,
    GAP,
    SURE,
    across_gap,
    integral,
    lag_of,
)
from equipoise.maths.straight_lines import read_at
from equipoise.model.arrays import Series1, Series3
from equipoise.model.finding import Finding
from equipoise.model.reasons.finding_reasons import FindingReason as Why
from equipoise.model.reasons.reason import one_reason
from equipoise.model.recording import Samples
from equipoise.model.testbed import AttitudeSensor, Gyro
from equipoise.sensors.timing import lateness

FARTHEST = 1.0  # s: later than this no camera is (chosen)
TRIED = 81  # lags from which the best is refined; chosen: one each 25 ms
ROUNDS = 6  # of refinement; chosen: the second changes nothing in smooth motion
VAGUE = 0.1  # s: an offset with a larger sd is not reported (chosen)
SURE_SD = 4.0  # sd from which an offset is one (chosen)
MATTERS = 0.005  # s: a smaller offset does no harm to slow platforms (chosen)


@dataclass(frozen=True, slots=True)
class ClockOffset:
    """How late the attitude is against the gyro."""

    lag: float  # s
    sd: float  # s


def offset_findings(
    reported: ClockOffset | None, camera: AttitudeSensor | None, gyro: Gyro | None
) -> list[Finding]:
    """Return the lag, and whether it is what the testbed's delays and averaging make of it."""
    if reported is None:
        return []
    wanted = lateness(camera) - lateness(gyro)
    wrong = abs(reported.lag - wanted) > max(SURE_SD * reported.sd, MATTERS)
    numbers = {"lag": reported.lag, "sd": reported.sd, "stated": wanted}
    code = Why.ATTITUDE_LATE_UNSTATED if wrong and (camera or gyro) else Why.ATTITUDE_LATE
    return [Finding("problem" if wrong else "content", one_reason(code, **numbers))]


def clock_offset(attitude: Samples, rate: Samples) -> ClockOffset | None:
    """Return the lag with its sd; None if the sensors or their motion do not show it."""
    if min(len(attitude), len(rate)) < FEWEST:
        return None
    pairs = _Pairs.of(attitude, rate)
    if len(pairs.start) < FEWEST:
        return None
    lags = np.linspace(-FARTHEST, FARTHEST, TRIED)
    lag = float(min(lags, key=lambda tried: float(np.sum(_left(pairs, rate, tried) ** 2))))
    for _ in range(ROUNDS):
        lag -= _step(pairs, rate, lag)
        if abs(lag) >= FARTHEST:
            return None
    left = _left(pairs, rate, lag)
    sd = _sd(_slope(pairs, rate, lag), left)
    likely = float(np.sum(left**2)) < (1.0 - SURE**2) * float(np.sum(pairs.centred**2))
    return ClockOffset(lag, sd) if sd < VAGUE and likely else None


@dataclass(frozen=True, slots=True, eq=False)
class _Pairs:
    """Turns between attitudes that the gyro covers, whatever the lag."""

    start: Series1  # s
    end: Series1  # s
    observed: Series3  # rad/s

    @property
    def centred(self) -> Series3:
        """Return the mean rates without what is common to all."""
        return self.observed - self.observed.mean(axis=0)

    @staticmethod
    def of(attitude: Samples, rate: Samples) -> "_Pairs":
        lag = lag_of(attitude)
        duration, turn = (values[::lag] for values in steps(attitude, lag))
        start = attitude.t[:-lag][::lag]
        end = start + duration
        use = (start - FARTHEST >= rate.t[0]) & (end + FARTHEST <= rate.t[-1])
        use &= duration < GAP * np.median(duration)
        use &= ~across_gap(rate, start - FARTHEST, end + FARTHEST)
        return _Pairs(start[use], end[use], (turn / duration[:, None])[use])


def _step(pairs: _Pairs, rate: Samples, lag: float) -> float:
    """Return by how much a lag is too long (s), to first order; infinite if nothing shows it."""
    slope = _slope(pairs, rate, lag)
    weight = float(np.sum(slope**2))
    return float(np.sum(slope * _left(pairs, rate, lag))) / weight if weight > 0 else np.inf


def _left(pairs: _Pairs, rate: Samples, lag: float) -> Series3:
    """Return what gyro and zero leave of the turns, rad/s."""
    length = (pairs.end - pairs.start)[:, None]
    response = (integral(rate, pairs.end - lag) - integral(rate, pairs.start - lag)) / length
    left = pairs.observed - response
    return left - left.mean(axis=0)


def _slope(pairs: _Pairs, rate: Samples, lag: float) -> Series3:
    """Return how that changes with the lag, rad/s^2."""
    length = (pairs.end - pairs.start)[:, None]
    first, last = (read_at(t - lag, rate.t, rate.values) for t in (pairs.start, pairs.end))
    slope = (last - first) / length
    return slope - slope.mean(axis=0)


def _sd(slope: Series3, left: Series3) -> float:
    """Return the sd of the lag, neighbours correlated; infinite if nothing shows it."""
    score, weight = np.sum(slope * left, axis=1), float(np.sum(slope**2))
    spread = float(score @ score + 2 * score[1:] @ score[:-1])
    most = float(np.sqrt(max(spread, 0.1 * float(score @ score))))
    return most / weight if weight > 0 else np.inf
