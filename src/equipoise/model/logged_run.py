"""What a logbook knows of one run."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from enum import StrEnum
from typing import Literal

from equipoise.model.estimate import Parameter
from equipoise.model.verdict import VerdictOutcome

RUN = "run.json"  # the file that a run's folder has when the run is whole
Kind = Literal["balance", "identify"]


class Usability(StrEnum):
    """Whether an estimate may be used, of a run without a verdict."""

    USABLE = "usable"
    NOT_USABLE = "not_usable"


Ending = VerdictOutcome | Usability


def ending_of(code: str) -> Ending:
    """Return the ending of a code; ValueError if there is none."""
    return Usability(code) if code in list(Usability) else VerdictOutcome(code)


@dataclass(frozen=True, slots=True)
class LoggedRun:
    """One run: of which platform, how it was built then, by what, and what came of it."""

    name: str  # of its folder; in a logbook with the month's: 2026-11/2026-11-28_09-00-00_balance_a
    kind: Kind
    made_at: str  # ISO 8601 with its offset from UTC
    platform: str
    configuration: str  # SHA-256 of the testbed's text
    method: str  # of estimation, or law of balancing
    bench: str  # simulated, real, recording
    outcome: Ending
    sentence: str
    parameters: tuple[Parameter, ...] = ()  # of the last estimate, SI, masses at home
    standing: tuple[Parameter, ...] = ()  # centre of mass as judged, masses as they stand, SI
    temperature: float | None = None  # degC, mean of the recording's
    provenance: Mapping[str, str] = field(default_factory=dict[str, str])


@dataclass(frozen=True, slots=True)
class Build:
    """One testbed file that a platform has had, and the runs that were made with it."""

    platform: str
    configuration: str  # SHA-256 of the testbed's text
    first: float  # s since 1970, of the first run
    last: float
    runs: int
