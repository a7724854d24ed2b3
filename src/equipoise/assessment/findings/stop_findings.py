"""When the platform met its stop: what no estimate models."""

from collections.abc import Sequence

from equipoise.model.finding import Finding
from equipoise.model.reasons.finding_reasons import FindingReason as Why
from equipoise.model.reasons.reason import one_reason
from equipoise.model.recording import Samples
from equipoise.model.testbed import Testbed
from equipoise.sensors.at_stop import BRIEF, Span, spans_at_stop

NAMED = 5  # touches that are named one by one; chosen: a screen


def stop_findings(attitude: Samples | None, testbed: Testbed | None) -> list[Finding]:
    """Return when a record's platform was at its stop; only a testbed says where that is."""
    if attitude is None or testbed is None:
        return []
    return touch_findings(spans_at_stop(attitude, testbed), testbed.tilt_limit)


def touch_findings(spans: Sequence[Span], limit: float) -> list[Finding]:
    """Return the touches of the stop at a tilt limit (rad), each from a time to a time (s)."""
    found = [_touch(span, limit) for span in spans[:NAMED]]
    if len(spans) > NAMED:
        found.append(Finding("problem", one_reason(Why.MORE_TOUCHES, count=len(spans) - NAMED)))
    return found


def _touch(span: Span, limit: float) -> Finding:
    """Return a touch, or that it lies there."""
    start, end = span
    if end - start < BRIEF:
        about = one_reason(Why.MEETS_STOP, t=start, limit=limit)
    else:
        about = one_reason(Why.LIES_ON_STOP, start=start, end=end, limit=limit)
    return Finding("problem", about, span, "stop")
