"""Whether a platform meets a requirement: passed, failed, or undecided by the record.

By the rule of ``model.criterion``; an undecided answer comes with the floor, the least value that
this record could have proven. Bounds are of a length, which counts every direction in which the
centre of mass may be off (``maths.gaussian_length``).
"""

from dataclasses import dataclass
from typing import Literal

from equipoise.maths.gaussian_length import Bounded
from equipoise.model.criterion import OFFSET, TORQUE, Criterion, VerdictOutcome
from equipoise.model.reasons.reason import Reason, sentence_of
from equipoise.model.reasons.verdict_reasons import VerdictReason as Why
from equipoise.model.verdict import outcome_of

Quantity = Literal["torque", "offset"]
JUDGED: dict[Quantity, Criterion] = {"torque": TORQUE, "offset": OFFSET}
FLOOR_BEYOND_LIMIT = {
    "torque": Why.TORQUE_FLOOR_BEYOND_LIMIT,
    "offset": Why.OFFSET_FLOOR_BEYOND_LIMIT,
}
TOO_NEAR_LIMIT = {"torque": Why.TORQUE_TOO_NEAR_LIMIT, "offset": Why.OFFSET_TOO_NEAR_LIMIT}


@dataclass(frozen=True, slots=True)
class Requirement:
    """A limit that must not be exceeded, in SI."""

    quantity: Quantity  # gravity's torque, rms over a range of tilts, or com's distance from target
    limit: float  # N m or m
    tilt: float = 0.0  # rad, of the range over which torque counts


@dataclass(frozen=True, slots=True)
class Judged:
    """A requirement, and the answer of a record."""

    requirement: Requirement
    found: Bounded
    reasons: tuple[Reason, ...]

    @property
    def outcome(self) -> VerdictOutcome:
        """Whether it is met."""
        return outcome_of(self.reasons)

    @property
    def sentence(self) -> str:
        """The reasons for a person."""
        return sentence_of(self.reasons)


def judged(requirement: Requirement, found: Bounded) -> Judged:
    """Return the answer with its reasons."""
    numbers = {"found": found.value, "low": found.low, "high": found.high,
               "limit": requirement.limit, "tilt": requirement.tilt}  # fmt: skip
    reasons = [JUDGED[requirement.quantity].answer(found, requirement.limit, numbers)]
    if outcome_of(reasons) is VerdictOutcome.UNDECIDED:
        reasons.append(doubt(requirement, found))
    return Judged(requirement, found, tuple(reasons))


def doubt(requirement: Requirement, found: Bounded) -> Reason:
    """Return why a record does not decide."""
    beyond = found.floor > requirement.limit
    codes = FLOOR_BEYOND_LIMIT if beyond else TOO_NEAR_LIMIT
    return Reason(codes[requirement.quantity], (), {"floor": found.floor})
