"""A verdict: a claim about the platform, tested on fresh data."""

from dataclasses import dataclass
from typing import Literal

from equipoise.model.arrays import Vector3
from equipoise.model.estimate import NORMAL_95

Word = Literal["passed", "failed", "cannot tell", "halted"]


@dataclass(frozen=True, slots=True, eq=False)
class Verdict:
    """Pass, fail or cannot tell (neither passed nor sure), with the numbers behind it."""

    passed: bool
    sentence: str
    com: Vector3 | None = None  # m, as the masses stand
    sd: Vector3 | None = None  # m
    sure: bool = True  # False: the data do not tell
    halted: bool = False  # True: the run was broken off, for safety

    @property
    def noise_floor(self) -> Vector3 | None:
        """Return 1.96 sd (m): along an axis, a smaller offset cannot be told from none (95 %)."""
        return None if self.sd is None else NORMAL_95 * self.sd


def outcome_of(verdict: Verdict) -> Word:
    """Return a verdict in a word."""
    if verdict.halted:
        return "halted"
    if verdict.passed:
        return "passed"
    return "failed" if verdict.sure else "cannot tell"
