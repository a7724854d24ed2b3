"""The one rule by which data prove, refute or leave open that something is within its limit.

    claim        s(x) <= limit,   s the size of what is uncertain, x
    passed       high <= limit    high: 97.5 % of what x may be is no larger
    failed       low > limit      low: the lower end of the 95 % interval of s
    undecided    neither

Of platforms beyond the limit, P(high <= limit) <= 2.5 % pass: ``high`` exceeds the true size in
97.5 % of records. Where the prior is right it holds the other way round, too: of those that pass,
at most 2.5 % are beyond, P(s > limit | data) <= 2.5 %.

Claims that must hold together (``jointly``: every instant of a hold) pass if each of them does. Of
those a false one passes as rarely as if it were alone.

Every verdict of the package that can pass is one of ``CRITERIA``; no code that passes is named
elsewhere. Bounds come from ``maths.gaussian_length`` and the like, which know the covariance. The
rule cannot see whether that is right.
"""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from enum import StrEnum
from typing import NamedTuple, Protocol, runtime_checkable

from equipoise.model.reasons.reason import Number, Reason
from equipoise.model.reasons.verdict_reasons import VerdictReason as Why


class VerdictOutcome(StrEnum):
    """What a claim came to; of several, the last of this list counts."""

    PASSED = "passed"
    UNDECIDED = "undecided"
    FAILED = "failed"
    HALTED = "halted"  # the run was broken off, for safety


@runtime_checkable
class Bounds(Protocol):
    """A size with its 95 % bounds."""

    @property
    def low(self) -> float:
        """The lower end."""
        ...

    @property
    def high(self) -> float:
        """The upper end."""
        ...


class Interval(NamedTuple):
    """A size's 95 % bounds alone."""

    low: float
    high: float


def decided(found: Bounds, limit: float) -> VerdictOutcome:
    """Return whether a size is within its limit; NaN bounds decide nothing."""
    if found.low > limit:
        return VerdictOutcome.FAILED
    return VerdictOutcome.PASSED if found.high <= limit else VerdictOutcome.UNDECIDED


def jointly(found: Iterable[Bounds]) -> Interval:
    """Return the bounds of the greatest of several sizes, each of which is within its own."""
    every = tuple(found)
    return Interval(max(each.low for each in every), max(each.high for each in every))


@dataclass(frozen=True, slots=True)
class Criterion:
    """A claim that can be judged, and the code of each answer."""

    name: str
    proven: Why
    undecided: Why
    refuted: Why

    def code_of(self, outcome: VerdictOutcome) -> Why:
        """Return the code of an answer of ``decided``."""
        codes = {VerdictOutcome.PASSED: self.proven, VerdictOutcome.FAILED: self.refuted}
        return codes.get(outcome, self.undecided)

    def answer(self, found: Bounds, limit: float, numbers: Mapping[str, Number],
               names: tuple[str, ...] = ()) -> Reason:  # fmt: skip
        """Return the answer with its numbers; ``names`` of what is beyond the limit or open."""
        outcome = decided(found, limit)
        shown = () if outcome is VerdictOutcome.PASSED else names
        return Reason(self.code_of(outcome), shown, numbers)


BALANCED = Criterion("balanced", Why.WITHIN_TOLERANCE, Why.TOO_UNCERTAIN, Why.OUTSIDE_TOLERANCE)
HELD = Criterion("held", Why.HELD, Why.HOLD_UNDECIDED, Why.NOT_HELD)
TORQUE = Criterion("torque", Why.TORQUE_MET, Why.TORQUE_UNDECIDED, Why.TORQUE_EXCEEDED)
OFFSET = Criterion("offset", Why.OFFSET_MET, Why.OFFSET_UNDECIDED, Why.OFFSET_EXCEEDED)
DESIGN = Criterion("design", Why.REQUIREMENT_MET, Why.EXPECTED_NEAR_LIMIT, Why.MET_BY_NO_CHANGE)
CRITERIA = (BALANCED, HELD, TORQUE, OFFSET, DESIGN)
