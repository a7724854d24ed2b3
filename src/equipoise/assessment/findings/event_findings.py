"""What happened to the platform during the recording, as findings."""

import math

import numpy as np

from equipoise.model.estimate import Estimate
from equipoise.model.event import Event
from equipoise.model.finding import Finding
from equipoise.model.reasons.finding_reasons import FindingReason as Why
from equipoise.model.reasons.reason import axes_of, one_reason

NOT_SOUGHT = Finding("content", one_reason(Why.EVENTS_NOT_SOUGHT))


def event_findings(estimate: Estimate) -> list[Finding]:
    """Return the events that an estimate steps over, and what its model leaves open."""
    reported = [_impulse(e) if e.kind == "impulse" else _step(e) for e in estimate.events]
    return reported + [Finding("content", (reason,)) for reason in estimate.unexplained]


def span_of(event: Event) -> tuple[float, float]:
    """Return when an event happened, one sd to either side, s."""
    return (event.t - event.t_sd, event.t + event.t_sd)


def _impulse(event: Event) -> Finding:
    """Return a touch: its impulse in laboratory axes, with its sd, and the place if it is known."""
    numbers = axes_of("size", event.size) | {
        "t": event.t,
        "size": float(np.linalg.norm(event.size)),
        "sd": math.sqrt(float(np.trace(event.covariance)) / 3),
    }
    if event.azimuth is None:
        found = one_reason(Why.TOUCH, **numbers)
    else:
        found = one_reason(Why.PUSH, **numbers, azimuth=event.azimuth)
    found += one_reason(Why.TOUCH_UNCLEAR) if event.unclear else ()
    return Finding("problem", found, span_of(event), "touch")


def _step(event: Event) -> Finding:
    """Return a step of the centre of mass, in body axes."""
    sd = np.sqrt(np.diag(event.covariance))
    found = one_reason(Why.COM_STEP, **axes_of("size", event.size), **axes_of("sd", sd), t=event.t)
    found += one_reason(Why.COM_STEP_UNCLEAR) if event.unclear else ()
    return Finding("problem", found, span_of(event), "shift")
