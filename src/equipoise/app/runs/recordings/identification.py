"""One identification: what a recording holds, the steps of the procedure, the estimate."""

from collections.abc import Sequence
from dataclasses import dataclass

from equipoise.app.runs.recordings.plausible_record import CLOSED, Gate
from equipoise.app.runs.waiting import QUIET, Waiting
from equipoise.assessment.findings.event_findings import event_findings
from equipoise.model.estimate import Estimate
from equipoise.model.finding import Finding
from equipoise.model.manoeuvre import Plan
from equipoise.model.presentation import Plotted
from equipoise.model.recording import Recording
from equipoise.model.step import Step
from equipoise.model.testbed import Testbed
from equipoise.procedure.identification.identify import IdentifyOptions, identify
from equipoise.procedure.identification.record_courses import (
    RecordCourses,
    identification_courses,
)


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class Identification(Plotted):
    """What was done with a recording; the last step has the estimate that counts."""

    testbed: Testbed
    recording: Recording
    findings: Sequence[Finding]
    steps: Sequence[Step]
    plan: Plan | None = None  # that the recording was made by

    @property
    def estimate(self) -> Estimate:
        """Return the estimate of the last step."""
        found = self.steps[-1].estimate
        assert found is not None
        return found

    def courses(self) -> RecordCourses:
        """Return what the figures of its report draw along the recording."""
        return identification_courses(self.recording, self.testbed, self.steps)


def run(
    recording: Recording,
    testbed: Testbed,
    options: IdentifyOptions,
    waiting: Waiting = QUIET,
    gate: Gate = CLOSED,
) -> Identification:
    """Identify from a recording that fits the testbed and passes ``gate``.

    Raises InputError for a method or a held parameter that does not exist, Implausible for a record
    that no estimate can stand, unless it is forced.
    """
    with waiting.doing("examining the recording"):
        found = gate.findings(recording, testbed)
    steps = list(waiting.steps(identify(recording, testbed, options), "identifying"))
    last = steps[-1].estimate
    happened = [] if last is None else event_findings(last)
    return Identification(testbed, recording, [*found, *happened], steps)
