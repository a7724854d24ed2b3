"""One assessment: what a recording proves, beside an earlier one, and along its hours."""

from collections.abc import Generator, Sequence
from dataclasses import dataclass

from equipoise.app.runs.waiting import QUIET, Waiting
from equipoise.assessment.findings.record_findings import findings
from equipoise.model.estimate import Estimate
from equipoise.model.finding import Finding
from equipoise.model.presentation import Plotted
from equipoise.model.recording import Recording
from equipoise.model.step import Step
from equipoise.model.testbed import Testbed
from equipoise.model.verdict import Verdict
from equipoise.procedure.identification.assess import Assessment, AssessOptions, assess
from equipoise.procedure.identification.drift_metrics import OverHours, metrics_over_hours


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class AssessedPlatform(Plotted):
    """What a recording proves of a platform."""

    done: Assessment
    before: Assessment | None  # of a recording made earlier
    steps: Sequence[Step]
    findings: Sequence[Finding]
    hours: OverHours | None = None  # window by window along the recording

    @property
    def estimate(self) -> Estimate:
        """Return the estimate that the assessment rests on."""
        return self.done.estimate

    @property
    def verdict(self) -> Verdict | None:
        """Return the verdict on what was required; None where nothing was."""
        return self.steps[-1].verdict


@dataclass(frozen=True, slots=True, eq=False)
class Recordings:
    """What is assessed: a recording, one made earlier to compare it with, windows along it."""

    recording: Recording
    before: Recording | None = None
    windows: float | None = None  # s


def run(
    of: Recordings, testbed: Testbed, options: AssessOptions, waiting: Waiting = QUIET
) -> AssessedPlatform:
    """Assess a recording that fits the testbed."""
    done, steps = _assessed(of.recording, testbed, options, waiting)
    earlier = of.before
    before = None if earlier is None else _assessed(earlier, testbed, options, waiting)[0]
    hours = None if of.windows is None else _along(done, of.windows, waiting)
    return AssessedPlatform(done, before, steps, findings(of.recording, testbed), hours)


def _assessed(
    recording: Recording, testbed: Testbed, options: AssessOptions, waiting: Waiting
) -> tuple[Assessment, list[Step]]:
    """Return the assessment of one recording, and its steps."""
    found: list[Assessment] = []

    def procedure() -> Generator[Step]:
        found.append((yield from assess(recording, testbed, options)))

    steps = list(waiting.steps(procedure(), "assessing"))
    return found[0], steps


def _along(done: Assessment, seconds: float, waiting: Waiting) -> OverHours:
    """Return the centre of mass window by window, at the inertia that was found."""
    with waiting.doing("estimating window by window"):
        return metrics_over_hours(
            done.recording, done.testbed, seconds, done.estimate.outcome.usable
        )
