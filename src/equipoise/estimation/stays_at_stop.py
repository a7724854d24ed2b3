"""Whether a platform lay on its stop for a while: what presses it then is no part of any model.

A swing turns within 2 % of its greatest tilt for 0.4 of the time w^-1 = sqrt(J / m g |r|) in which
it turns by a radian. A stay that is longer is none; one that is not may be, as far as a fit follows
it without a push.

Cannot see a stay without a camera, nor tell one from a cone of the stop's tilt.
"""

from collections.abc import Iterable
from dataclasses import replace

import numpy as np

from equipoise.maths.attitude import tilt
from equipoise.model.estimate import COM, INERTIA, Estimate
from equipoise.model.outcome import Outcome
from equipoise.model.reasons.estimate_reasons import EstimateReason as Why
from equipoise.model.reasons.reason import Reason
from equipoise.model.recording import Recording, Samples
from equipoise.model.testbed import AT_STOP, Testbed
from equipoise.sensors.at_stop import BRIEF, Span, spans_at_stop


def stays(recording: Recording, testbed: Testbed) -> list[Span]:
    """Return from when to when (s) the platform stays at the tilt of its stop."""
    attitude = recording.attitude
    if attitude is None:
        return []
    spans = [(a, b) for a, b in spans_at_stop(attitude, testbed) if b - a >= BRIEF]
    return [span for span in spans if not is_beyond(attitude, span, testbed)]


def is_beyond(attitude: Samples, span: Span, testbed: Testbed) -> bool:
    """Say whether rows tilt farther than the stop lets them, so that it is elsewhere than stated.

    The bound is as far beyond the limit as rows at the stop may be below.
    """
    start, end = span
    rows = attitude.where((attitude.t >= start) & (attitude.t <= end))
    return bool(np.median(tilt(rows.values, testbed.up)) * AT_STOP > testbed.tilt_limit)


def longest_without(recording: Recording, spans: Iterable[Span]) -> Span:
    """Return the longest part of a record that none of some spans touches, s."""
    first, last = recording.span
    begins, ends = [first, *(end for _, end in spans)], [*(start for start, _ in spans), last]
    return max(zip(begins, ends, strict=True), key=lambda part: part[1] - part[0])


def stay_reasons(recording: Recording, spans: list[Span]) -> tuple[Reason, ...]:
    """Return that the platform lay on its stop, the longest time, and which part is without."""
    if not spans:
        return ()
    start, end = max(spans, key=lambda span: span[1] - span[0])
    first, last = longest_without(recording, spans)
    numbers = {"start": start, "end": end, "first": first, "last": last}
    return (Reason(Why.LAY_ON_STOP, (), numbers),)


def swing_time(estimate: Estimate, testbed: Testbed) -> float:
    """Return w^-1 (s) by what an estimate has, else by the testbed's body."""
    body = testbed.body
    if all(map(estimate.has, COM)):
        body = replace(body, com=estimate.com)
    if all(map(estimate.has, INERTIA)):
        body = replace(body, inertia_P=estimate.inertia_P)
    return body.swing_time(testbed.gravity)


def judged_by_stays(estimate: Estimate, recording: Recording, testbed: Testbed) -> Estimate:
    """Return an estimate of a record, rejected where the platform lay on its stop for long."""
    if not estimate.outcome.usable:
        return estimate
    least = swing_time(estimate, testbed)
    long = [(start, end) for start, end in stays(recording, testbed) if end - start > least]
    reasons = (*estimate.outcome.reasons, *stay_reasons(recording, long))
    return replace(estimate, outcome=Outcome(reasons))
