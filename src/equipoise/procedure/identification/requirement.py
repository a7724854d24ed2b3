"""Whether a platform meets a requirement: passed, failed, or the record cannot tell.

    passed        the 97.5 % upper bound is within the limit
    failed        the lower bound of the 95 % interval is beyond it
    cannot tell   neither; with the floor, the least value that this record could have proven

A platform just at its limit passes in at most 2.5 % of records, however good or poor they are:
bounds are of a length, which counts every direction in which the centre of mass may be off
(``maths.gaussian_length``).
"""

from dataclasses import dataclass

from equipoise.maths.gaussian_length import Bounded

WHOLE, MOST = 100.0, 1e6  # between them numbers are shown whole, without an exponent
PASSED, FAILED, OPEN = "Passed", "Failed", "Cannot tell"


@dataclass(frozen=True, slots=True)
class Requirement:
    """What must not be exceeded, in SI, and how it is told to people."""

    what: str
    limit: float
    unit: str  # as shown
    factor: float  # shown units in one of SI


@dataclass(frozen=True, slots=True)
class Judged:
    """A requirement, and what a record says of it."""

    requirement: Requirement
    found: Bounded
    answer: str  # one of the three above
    sentence: str


def judged(requirement: Requirement, found: Bounded) -> Judged:
    """Return the answer with its sentence."""
    answer = answer_of(requirement.limit, found)
    reported = (
        f"{answer}: {requirement.what} is {shown(requirement, found.value)} "
        f"(95 %: {shown(requirement, found.low)} to {shown(requirement, found.high)}); "
        f"at most {shown(requirement, requirement.limit)} is wanted."
    )
    if answer == OPEN:
        reported += f" {doubt(requirement, found)}"
    return Judged(requirement, found, answer, reported)


def answer_of(limit: float, found: Bounded) -> str:
    """Return the answer."""
    if found.high <= limit:
        return PASSED
    return FAILED if found.low > limit else OPEN


def doubt(requirement: Requirement, found: Bounded) -> str:
    """Say why a record cannot tell."""
    floor = shown(requirement, found.floor)
    if found.floor > requirement.limit:
        return (
            f"The floor of this recording is {floor}: even a perfect platform would not pass. "
            "Record longer, with larger swings about both axes, or with better sensors."
        )
    return f"The floor of this recording is {floor}: the value is too near to the limit to be sure."


def shown(requirement: Requirement, value: float) -> str:
    """Return a value in the unit of the bench."""
    size = value * requirement.factor
    text = f"{size:.0f}" if WHOLE <= size < MOST else f"{size:.3g}"
    return f"{text} {requirement.unit}"


def verdict_answer(answers: list[str]) -> str:
    """Return what several answers come to: failed if one is, passed if all are."""
    if FAILED in answers:
        return FAILED
    return PASSED if all(answer == PASSED for answer in answers) else OPEN
