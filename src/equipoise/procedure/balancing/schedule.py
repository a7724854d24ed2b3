"""When masses may move: as the experiment on the platform allows, and not in quiet hours.

An experiment may say at any time that masses must stand, that they may move again, and that it is
over. Who reads that from a socket or a file is not known here.
"""

from collections.abc import Sequence
from dataclasses import dataclass

from equipoise.model.errors import InputError
from equipoise.model.permission import Experiment, Permission
from equipoise.model.reasons.reason import Reason, one_reason
from equipoise.model.reasons.step_reasons import StepReason


def always_free() -> Permission:
    """Let masses move at any time."""
    return Permission.FREE


@dataclass(frozen=True, slots=True)
class Schedule:
    """Who decides when masses may move."""

    experiment: Experiment = always_free
    quiet: Sequence[tuple[float, float]] = ()  # s, bench time: begin and end of each quiet time

    def at(self, t: float) -> tuple[Permission, tuple[Reason, ...]]:
        """Return what masses may do at a time (s), and why."""
        wanted = permission_of(self.experiment())
        if wanted is Permission.DONE:
            return wanted, one_reason(StepReason.EXPERIMENT_DONE)
        if wanted is Permission.HOLD:
            return wanted, one_reason(StepReason.EXPERIMENT_HOLDS)
        if any(begin <= t < end for begin, end in self.quiet):
            return Permission.HOLD, one_reason(StepReason.QUIET_TIME)
        return wanted, one_reason(StepReason.MASSES_FREE)


ALWAYS = Schedule()


def permission_of(word: str) -> Permission:
    """Return what an experiment states; InputError for a word that states nothing."""
    try:
        return Permission(word)
    except ValueError:
        raise InputError("experiment", ascii(word), ", ".join(Permission)) from None
