"""A step of a procedure. Terminal, report and log are views of one list of them."""

from dataclasses import dataclass
from typing import Literal

from equipoise.model.estimate import Estimate
from equipoise.model.following import Following
from equipoise.model.move import Move
from equipoise.model.placing import Placing
from equipoise.model.recording import Recording
from equipoise.model.verdict import Verdict

Kind = Literal["measurement", "estimate", "move", "place", "control", "verify", "stop"]


@dataclass(frozen=True, slots=True, eq=False)
class Step:
    """What was done, when on the bench's clock, and what came of it."""

    kind: Kind
    time: float  # s, bench time when the step ended
    sentence: str
    recording: Recording | None = None
    estimate: Estimate | None = None
    move: Move | None = None
    verdict: Verdict | None = None
    following: Following | None = None  # what masses can follow from now on
    placing: Placing | None = None  # of weights, by hand
