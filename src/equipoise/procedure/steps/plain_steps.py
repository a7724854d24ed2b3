"""Steps that procedures report alike: a record that was made, an estimate from one."""

from equipoise.model.estimate import Estimate
from equipoise.model.reasons.reason import Reason, one_reason
from equipoise.model.reasons.step_reasons import StepReason
from equipoise.model.recording import Recording
from equipoise.model.step import Step
from equipoise.model.verdict import Verdict
from equipoise.procedure.steps.joint_fit import Knowledge
from equipoise.procedure.steps.verify import at


def measurement_step(
    time: float, recording: Recording, code: StepReason = StepReason.OBSERVED
) -> Step:
    """Return the step of a record at a time, s."""
    start, end = recording.span
    return Step("measurement", time, one_reason(code, duration=end - start), recording=recording)


def verdict_step(
    time: float,
    verdict: Verdict,
    reasons: tuple[Reason, ...],
    recording: Recording,
    estimate: Estimate | None = None,
) -> Step:
    """Return the verification, or the stop where the verdict is another."""
    kind = "verify" if verdict.passed else "stop"
    return Step(kind, time, reasons, recording, estimate, verdict=verdict)


def com_step(time: float, knowledge: Knowledge, news: tuple[Reason, ...] = ()) -> Step:
    """Return the step of what is known of the centre of mass, and what is new of the model."""
    reasons = (*one_reason(StepReason.COM_AT, **at(knowledge.com, knowledge.sd)), *news)
    return Step("estimate", time, reasons, knowledge.recording, knowledge.estimate)


def estimate_step(time: float, estimate: Estimate) -> Step:
    """Return the step of an estimate at a time, s."""
    reasons = (*one_reason(StepReason.ESTIMATED_BY, estimate.method), *estimate.outcome.reasons)
    return Step("estimate", time, reasons, estimate=estimate)
