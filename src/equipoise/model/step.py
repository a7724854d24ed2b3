"""A step of a procedure. Terminal, report and log are views of one list of them."""

from dataclasses import dataclass, field
from typing import Literal

from equipoise.model.estimate import Estimate
from equipoise.model.following import Following
from equipoise.model.move import Move
from equipoise.model.placing import Placing
from equipoise.model.reasons.reason import Coded, Reason
from equipoise.model.recording import Recording
from equipoise.model.testbed import Testbed
from equipoise.model.verdict import Verdict

Kind = Literal["measurement", "estimate", "move", "place", "control", "verify", "stop"]


@dataclass(frozen=True, slots=True, eq=False)
class Step(Coded):
    """What was done, when on the bench's clock, and what came of it."""

    kind: Kind
    time: float  # s, bench time when the step ended
    reasons: tuple[Reason, ...]  # what came of it, the main one first
    recording: Recording | None = field(default=None, repr=False)
    estimate: Estimate | None = field(default=None, repr=False)
    move: Move | None = field(default=None, repr=False)
    verdict: Verdict | None = field(default=None, repr=False)
    # what masses can follow from now on
    following: Following | None = field(default=None, repr=False)
    placing: Placing | None = field(default=None, repr=False)  # of weights, by hand
    known: Testbed | None = field(default=None, repr=False)  # from now on, as loaded by hand
