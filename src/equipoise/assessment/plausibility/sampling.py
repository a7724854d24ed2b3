"""Whether rows come at rates that sensors have, and fast enough for the motion.

A turn of half a revolution between two attitudes looks like one the other way round, so
attitudes must come well before that. A gyro beside them shows how it was.
"""

import numpy as np

from equipoise.assessment.record_checks.attitude_steps import steps
from equipoise.model.finding import Finding
from equipoise.model.reasons.finding_reasons import FindingReason as Why
from equipoise.model.reasons.reason import one_reason
from equipoise.model.recording import Samples

FASTEST, SLOWEST = 2e-5, 5.0  # s between rows; chosen: no sensor of a platform is outside
COARSE, ALIASED = np.radians(90.0), np.radians(170.0)  # turn from row to row (chosen)
FEWEST = 5  # rows (chosen)


def sampling_findings(attitude: Samples | None, rate: Samples | None) -> list[Finding]:
    """Return a clock that no sensor has, and attitudes too rare for the motion."""
    named = (("attitude", attitude), ("rate", rate))
    found = [f for name, channel in named for f in _clock(name, channel)]
    return found or ([] if rate is not None else _turns(attitude))


def _clock(name: str, channel: Samples | None) -> list[Finding]:
    if channel is None or len(channel) < FEWEST:
        return []
    period = channel.period
    if FASTEST <= period <= SLOWEST:
        return []
    reasons = one_reason(Why.IMPOSSIBLE_RATE, name, period=period)
    return [Finding("wrong", (*reasons, *one_reason(Why.READ_CLOCK)))]


def _turns(attitude: Samples | None) -> list[Finding]:
    if attitude is None or len(attitude) < FEWEST:
        return []
    _, turn = steps(attitude)
    usual = float(np.median(np.linalg.norm(turn, axis=1)))
    if usual < COARSE:
        return []
    kind = "wrong" if usual > ALIASED else "problem"
    return [Finding(kind, one_reason(Why.TOO_SLOW, turn=usual, interval=attitude.period))]
