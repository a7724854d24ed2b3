"""A verdict: a claim about the platform, tested on fresh data.

It passes by the rule of ``model.criterion`` alone. It fails by that rule too, or where data
contradict what the claim rests on: a misfit, a move that led elsewhere.
"""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass

from equipoise.model.arrays import Vector3
from equipoise.model.criterion import CRITERIA, VerdictOutcome
from equipoise.model.estimate import NORMAL_95
from equipoise.model.reasons.reason import Coded, Reason
from equipoise.model.reasons.verdict_reasons import VerdictReason as Why

OUTCOMES: Mapping[VerdictOutcome, tuple[Why, ...]] = {
    VerdictOutcome.PASSED: (
        *(each.proven for each in CRITERIA),
        Why.NOTHING_REQUIRED,
        Why.RUNS_AGREE,
        Why.EVERY_RUN_PASSED,
    ),
    VerdictOutcome.UNDECIDED: (
        *(each.undecided for each in CRITERIA),
        Why.ESTIMATE_UNUSABLE,
        Why.RUNS_INCOMPARABLE,
        Why.RUNS_NOT_FITTED,
    ),
    VerdictOutcome.FAILED: (
        *(each.refuted for each in CRITERIA),
        Why.RECORD_MISFITS,
        Why.MOVE_MISSED,
        Why.RAILS_ENDED,
        Why.OUT_OF_REACH,
        Why.MET_BY_ONE_CHANGE,
        Why.MET_BY_CHANGES,
        Why.RUNS_SCATTER,
        Why.SOME_RUNS_FAILED,
    ),
    VerdictOutcome.HALTED: (
        Why.TILTED,
        Why.BENCH_STOPPED,
        Why.STOPPED_BY_HAND,
        Why.STOPPED_BY_SIGNAL,
    ),
}


def outcome_of(reasons: Iterable[Reason]) -> VerdictOutcome:
    """Return what a claim came to; reasons that are not a verdict's decide nothing."""
    codes = {reason.code for reason in reasons}
    found = [outcome for outcome, causes in OUTCOMES.items() if codes & set(causes)]
    return found[-1] if found else VerdictOutcome.UNDECIDED


@dataclass(frozen=True, slots=True, eq=False)
class Verdict(Coded):
    """What a claim came to, why, the main reason first, and the numbers behind it."""

    reasons: tuple[Reason, ...]
    com: Vector3 | None = None  # m, as the masses stand
    sd: Vector3 | None = None  # m

    @property
    def outcome(self) -> VerdictOutcome:
        """What the claim came to."""
        return outcome_of(self.reasons)

    @property
    def passed(self) -> bool:
        """Whether the claim holds for sure."""
        return self.outcome is VerdictOutcome.PASSED

    @property
    def noise_floor(self) -> Vector3 | None:
        """Return 1.96 sd (m): along an axis, a smaller offset is not significant (95 %)."""
        return None if self.sd is None else NORMAL_95 * self.sd
