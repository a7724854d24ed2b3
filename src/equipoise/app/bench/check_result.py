"""What a check of a bench found, one sentence each."""

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class CheckResult:
    """One finding."""

    good: bool
    sentence: str
