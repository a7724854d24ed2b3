"""Outcomes, verdicts and steps for tests to which their reasons do not matter."""

from equipoise.model.estimate import Estimate
from equipoise.model.outcome import Outcome, outcome
from equipoise.model.reasons.estimate_reasons import EstimateReason
from equipoise.model.reasons.reason import one_reason
from equipoise.model.reasons.step_reasons import StepReason
from equipoise.model.reasons.verdict_reasons import VerdictReason
from equipoise.model.verdict import Verdict


def of_use(usable: bool = True) -> Outcome:
    """Return the outcome of an estimate that may be used, or may not."""
    return outcome(EstimateReason.LINEAR if usable else EstimateReason.HARDLY_MOVED)


def verdict(passed: bool, com=None, sd=None) -> Verdict:
    """Return a verdict that passed or failed."""
    code = VerdictReason.NOTHING_REQUIRED if passed else VerdictReason.RECORD_MISFITS
    return Verdict(one_reason(code, expected=1e-6), com, sd)


def undecided(com=None, sd=None) -> Verdict:
    """Return a verdict that cannot tell."""
    return Verdict(one_reason(VerdictReason.ESTIMATE_UNUSABLE), com, sd)


def halted() -> Verdict:
    """Return the verdict on a run that was broken off."""
    return Verdict(one_reason(VerdictReason.TILTED))


def codes_of(estimate: Estimate) -> list[str]:
    """Return the codes of an outcome's reasons."""
    return [reason.code for reason in estimate.outcome.reasons]


OBSERVED = one_reason(StepReason.OBSERVED, duration=1.0)
