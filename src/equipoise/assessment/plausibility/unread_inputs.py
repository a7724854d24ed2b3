"""Whether a table says more of what acted on the platform than was read of it.

A record whose wheels ran is none of a free swing, and a fit of one is wrong. A column that is
constant acts on nothing.
"""

from collections.abc import Mapping, Sequence
from itertools import groupby

from equipoise.model.finding import Finding
from equipoise.model.reasons.finding_reasons import FindingReason as Why
from equipoise.model.reasons.reason import Reason, one_reason
from equipoise.model.unread_input import InputKind, UnreadInput

NAMED = 5  # columns of a kind that are named one by one; chosen: a screen
# In a column map, and in a testbed file.
DEVICES: Mapping[InputKind, tuple[str, str]] = {
    InputKind.WHEEL: ('[[device]], reports = "wheel"', "[[reaction_wheel]]"),
    InputKind.GIMBAL: ('[[device]], reports = "gimbal"', "[[control_moment_gyro]]"),
    InputKind.DIPOLE: ('[[device]], reports = "dipole"', "[[magnetorquer]]"),
    InputKind.CAGE: ('[[device]], reports = "cage"', "[[coil_pair]]"),
    InputKind.JET: ('[[device]], reports = "jet"', "[[jet_pair]]"),
    InputKind.MASS: ("[[mass]]", "[[sliding_mass]]"),
}
TRIADS = (InputKind.MOMENTUM, InputKind.TORQUE)


def unread_findings(unread: Sequence[UnreadInput]) -> list[Finding]:
    """Return a problem for each kind of input of which columns change and are not read."""
    ordered = sorted(unread, key=lambda each: each.kind)
    return [_of_kind(kind, tuple(each)) for kind, each in groupby(ordered, lambda e: e.kind)]


def _of_kind(kind: InputKind, columns: tuple[UnreadInput, ...]) -> Finding:
    found: list[Reason] = []
    for each in columns[:NAMED]:
        found += one_reason(Why.INPUT_UNREAD, each.column, low=each.low, high=each.high)
    if len(columns) > NAMED:
        found += one_reason(Why.MORE_INPUTS_UNREAD, kind, count=len(columns) - NAMED)
    return Finding("problem", (*found, *_remedy(kind)))


def _remedy(kind: InputKind) -> tuple[Reason, ...]:
    if kind in DEVICES:
        return one_reason(Why.READ_DEVICE, *DEVICES[kind])
    return one_reason(Why.READ_TRIAD, kind) if kind in TRIADS else one_reason(Why.READ_REPORTS)
