"""What a search may take: every loop says what it is at, and goes on only if it may.

Algorithms know no clock: whoever waits gives the budget, and says when it is spent. A search that
may not go on ends with the best that it has found; its estimate says what is ``unfinished``. What
remains then, a last fit and its intervals, is bounded by the number of rows.

Cannot end a descent before the next ``AT_ONCE`` node columns (``output_error.solution``) are done.
"""

from collections.abc import Callable
from dataclasses import replace
from enum import StrEnum

from equipoise.model.estimate import Estimate
from equipoise.model.outcome import Outcome
from equipoise.model.reasons.estimate_reasons import EstimateReason as Why
from equipoise.model.reasons.reason import Reason


class Stage(StrEnum):
    """What a search is at."""

    MOTION = "following the motion"
    NOISE = "weighing the noise"
    EVENTS = "seeking events"
    TERMS = "seeking terms"
    MODELS = "comparing models"
    DRIFT = "weighing the drift"
    RUNS = "fitting the runs together"
    INTERVALS = "trying the intervals"


Spent = Callable[[], bool]


def never() -> bool:
    """Say that a budget is not spent."""
    return False


def without_end() -> Spent:
    """Begin a budget that is never spent."""
    return never


def unwatched(_stage: Stage) -> None:
    """Leave it at that."""


class Budget:
    """What one search may take; it begins with the first question."""

    def __init__(self, begin: Callable[[], Spent], at: Callable[[Stage], None] = unwatched) -> None:
        self.begin, self._at = begin, at
        self._spent: Spent | None = None
        self.unfinished: tuple[Stage, ...] = ()  # that were not allowed to go on

    def allows(self, stage: Stage) -> bool:
        """Say whether a stage may go on; it is unfinished otherwise."""
        self._at(stage)
        if self._spent is None:
            self._spent = self.begin()
        if not self._spent():
            return True
        if stage not in self.unfinished:
            self.unfinished = (*self.unfinished, stage)
        return False

    def renewed(self) -> "Budget":
        """Return the same budget for another search."""
        return Budget(self.begin, self._at)


UNLIMITED = Budget(without_end)


def cut_short(
    estimate: Estimate, unfinished: tuple[Stage, ...], explained: bool = True
) -> Estimate:
    """Return the estimate with what its search did not finish.

    Where what is left is noise (``explained``), values hold, but an error that nobody sought may
    hide in them: intervals do not. Else the model lacks what moves the platform.
    """
    if not unfinished:
        return estimate
    names = tuple(stage.value for stage in unfinished)
    held = explained and estimate.outcome.usable
    why = Reason(Why.BUDGET_SPENT if held else Why.BUDGET_TOO_SMALL, names)
    return replace(estimate, outcome=Outcome((*estimate.outcome.reasons, why)))
