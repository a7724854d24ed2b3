"""A verdict: a claim about the platform, tested on fresh data."""

from dataclasses import dataclass
from typing import Literal

from equipoise.model.arrays import Vector3

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


def outcome_of(verdict: Verdict) -> Word:
    """Return a verdict in a word."""
    if verdict.halted:
        return "halted"
    if verdict.passed:
        return "passed"
    return "failed" if verdict.sure else "cannot tell"
