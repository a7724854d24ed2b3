"""Channels, their rates and spans, and where they fall silent."""

import numpy as np

from equipoise.assessment.record_checks.robust_scatter import robust_sd
from equipoise.model.finding import Finding
from equipoise.model.reasons.finding_reasons import FindingReason as Why
from equipoise.model.reasons.reason import one_reason
from equipoise.model.recording import CHANNELS, Recording, Samples

GAP = 3.0  # median intervals; chosen: one missed row makes 2, two make 3
NAMED = 5  # gaps that are named one by one; chosen: a screen
SPOKEN = {"momentum": "stored momentum", "torque": "known torque", "field": "magnetic field",
          "torque_by_cause": "torque by cause"}  # fmt: skip
UNEVEN = 0.1  # of the median interval, as a robust scatter, before it is reported (chosen)


def content_findings(recording: Recording) -> list[Finding]:
    """Return what was recorded, then the gaps of the sensors."""
    named = [(SPOKEN.get(name, name), getattr(recording, name)) for name in CHANNELS]
    parts = {"masses": recording.mass_names, "devices": recording.device_names}
    present = [(name, c) for name, c in named if c is not None and len(c)]
    absent = [name for name in ("attitude", "rate") if name not in dict(present)]
    content = [_content(name, channel, parts.get(name, ())) for name, channel in present]
    content += [Finding("content", one_reason(Why.NOT_RECORDED, name)) for name in absent]
    sensors = [(name, c) for name, c in present if name in ("attitude", "rate")]
    return content + [gap for name, c in sensors for gap in _timing(name, c)]


def _content(name: str, channel: Samples, parts: tuple[str, ...]) -> Finding:
    first, last = float(channel.t[0]), float(channel.t[-1])
    if len(channel) < 2:
        return Finding("content", one_reason(Why.SINGLE_ROW, name, first=first), (first, last))
    code = Why.CHANNEL_OF_PARTS if parts else Why.CHANNEL
    numbers = {"rows": len(channel), "first": first, "last": last, "rate": 1 / channel.period}
    return Finding("content", one_reason(code, name, *parts, **numbers), (first, last))


def _timing(name: str, channel: Samples) -> list[Finding]:
    if len(channel) < 2:
        return []
    return _gaps(name, channel) + _unevenness(name, channel)


def _gaps(name: str, channel: Samples) -> list[Finding]:
    """Return the longest gaps in order of time, and how many more there are."""
    t, steps = channel.t, np.diff(channel.t)
    where = np.flatnonzero(steps > GAP * channel.period)
    longest = np.sort(where[np.argsort(-steps[where], kind="stable")][:NAMED])
    found = [
        Finding(
            "problem",
            one_reason(Why.GAP, name, gap=float(steps[i]), t=float(t[i])),
            (float(t[i]), float(t[i + 1])),
            "gap",
        )
        for i in longest
    ]
    if len(where) > NAMED:
        found.append(Finding("problem", one_reason(Why.MORE_GAPS, name, count=len(where) - NAMED)))
    return found


def _unevenness(name: str, channel: Samples) -> list[Finding]:
    middle = channel.period
    scatter = float(robust_sd(np.diff(channel.t) - middle))
    if scatter < UNEVEN * middle:
        return []
    numbers = {"scatter": scatter, "interval": middle}
    return [Finding("problem", one_reason(Why.UNEVEN_INTERVALS, name, **numbers))]
