"""What happened to the platform while it was watched, as findings."""

import math

import numpy as np

from equipoise.model.estimate import Estimate
from equipoise.model.event import Event
from equipoise.model.finding import Finding

NOT_SOUGHT = Finding(
    "content", "touches and parts that shift were not looked for: that takes a testbed."
)
MILLI, MICRO = 1e3, 1e6
UNCLEAR_TOUCH = "A part that shifted would explain it about as well: intervals allow for either."
UNCLEAR_STEP = "A touch would explain it about as well: intervals allow for either."


def event_findings(estimate: Estimate) -> list[Finding]:
    """Return the events that an estimate steps over, and what its model leaves open."""
    reported = [_impulse(e) if e.kind == "impulse" else _step(e) for e in estimate.events]
    return reported + [Finding("content", sentence) for sentence in estimate.unexplained]


def span_of(event: Event) -> tuple[float, float]:
    """Return when an event happened, one sd to either side, s."""
    return (event.t - event.t_sd, event.t + event.t_sd)


def _sizes(values: np.ndarray, factor: float) -> str:
    return ", ".join(f"{factor * x:.2g}" for x in values)


def _impulse(event: Event) -> Finding:
    """Return a touch: its impulse in laboratory axes, with its sd, and the place if it is told."""
    sd = math.sqrt(float(np.trace(event.covariance)) / 3)
    text = (
        f"at {event.t:.4g} s something gave the platform an impulse of "
        f"{MILLI * float(np.linalg.norm(event.size)):.2g} mN m s (laboratory x, y, z: "
        f"{_sizes(event.size, MILLI)}; sd {MILLI * sd:.1g})"
    )
    if event.azimuth is not None:
        text += (
            ", as a push from below does at the body azimuth "
            f"{math.degrees(event.azimuth):.0f} deg, or one from above opposite"
        )
    text += f". {UNCLEAR_TOUCH}" if event.unclear else "."
    return Finding("problem", text, span_of(event), "touch")


def _step(event: Event) -> Finding:
    """Return a step of the centre of mass, in body axes."""
    sd = np.sqrt(np.diag(event.covariance))
    text = (
        f"at {event.t:.4g} s the centre of mass moved by {_sizes(event.size, MICRO)} um "
        f"(body x, y, z; sd {_sizes(sd, MICRO)}): a part shifted."
    )
    text += f" {UNCLEAR_STEP}" if event.unclear else ""
    return Finding("problem", text, span_of(event), "shift")
