"""A record that is looked at before anything is fitted to it."""

from dataclasses import dataclass

from equipoise.assessment.findings.record_findings import findings
from equipoise.model.errors import Implausible
from equipoise.model.finding import Finding
from equipoise.model.recording import Recording
from equipoise.model.testbed import Testbed
from equipoise.procedure.identification.attitude_direction import direction_findings


@dataclass(frozen=True, slots=True)
class Gate:
    """What a record must pass before anything is fitted to it."""

    force: bool = False  # fit it whatever was found

    def findings(self, recording: Recording, testbed: Testbed) -> list[Finding]:
        """Return what a record holds.

        Raises Implausible for what no estimate can stand, unless it is forced.
        """
        found = [*findings(recording, testbed), *direction_findings(recording, testbed)]
        wrong = [reason for each in found if each.kind == "wrong" for reason in each.reasons]
        if wrong and not self.force:
            raise Implausible(recording.source or "recording", wrong)
        return found


CLOSED = Gate()
