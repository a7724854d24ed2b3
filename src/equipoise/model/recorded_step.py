"""A step of an earlier run, or an event of a recording, as a file keeps it."""

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class RecordedStep:
    """What was done or noted, when on the recording's clock, and what came of it."""

    kind: str  # of a Step, or of an event: "mark", "interlock", "start" ...
    time: float  # s
    sentence: str  # for people; no program reads it
    outcome: str | None = None  # of the verdict, where the step has one
