"""An assessment as one JSON document, SI units."""

from equipoise.app.report.run_record import Output
from equipoise.app.runs.assessment import AssessedPlatform
from equipoise.app.text.json_document import (
    View,
    estimate_json,
    numbers,
    reasons_json,
    verdict_json,
)
from equipoise.app.views.assess_views import blocks, record_of
from equipoise.assessment.metrics.swing_height import Hanging
from equipoise.model.estimate import COM, Estimate
from equipoise.model.noise_corrected_series import NoiseCorrectedSeries
from equipoise.procedure.identification.assess import Assessment
from equipoise.procedure.identification.drift_metrics import OverHours
from equipoise.procedure.identification.requirement import Judged

SCHEMA = "equipoise/assess/1"


def output_of(reported: AssessedPlatform) -> Output:
    """Return all that is handed over."""
    return Output(
        "assess",
        document_of(reported),
        blocks(reported),
        lambda: record_of(reported, reported.courses()),
    )


def document_of(reported: AssessedPlatform) -> View:
    """Return the assessment; what the recording before showed beside it."""
    done, before, verdict = reported.done, reported.before, reported.steps[-1].verdict
    return {
        "schema": SCHEMA,
        "verdict": None if verdict is None else verdict_json(verdict),
        "required": [judged_json(each) for each in done.judged],
        **platform_json(done),
        "before": None if before is None else platform_json(before),
        "over_hours": None if reported.hours is None else hours_json(reported.hours),
        "estimate": estimate_json(done.estimate, reported.findings),
    }


def platform_json(done: Assessment) -> View:
    """Return what one recording shows of the platform."""
    metrics, torque = done.metrics, done.torque
    return {
        "com": {
            "value": numbers(done.com),
            "covariance": numbers(done.com_covariance),
            "covariance_at_inertia": numbers(done.com_unscaled),
            "distance_from_target": done.offset._asdict(),
        },
        "torque_in_range": {
            "tilt": torque.tilt,
            "rms": torque.rms._asdict(),
            "greatest": torque.worst,
            "greatest_high": torque.worst_high,
        },
        "inertia_sd": done.inertia_sd,
        "metrics": {
            "duration": metrics.duration,
            "window": metrics.window,
            "torque": residual_torque_json(metrics.torque, metrics.torque_fit),
            "energy": residual_torque_json(metrics.energy, metrics.energy_fit),
            "swings": [hanging_json(each, done.weight) for each in metrics.hanging],
            "no_period": metrics.quiet,
        },
    }


def hours_json(hours: OverHours) -> View:
    """Return looks along a recording, and what they come to."""
    wander = hours.wander
    found = {"t": numbers(hours.t), "com": numbers(hours.com), "sd": numbers(hours.sd),
             "left_out": hours.left_out}  # fmt: skip
    if wander is None:
        return found
    return found | {
        "drift": numbers(wander.drift),
        "drift_sd": numbers(wander.drift_sd),
        "walk": numbers(wander.walk),
        "allan": {
            "span": numbers(wander.span),
            "deviation": numbers(wander.deviation),
            "relative_sd": numbers(wander.error),
            "measurements_alone": numbers(wander.measurements_alone),
        },
    }


def judged_json(judged: Judged) -> View:
    """Return a requirement and its answer."""
    return {
        "quantity": judged.requirement.quantity,
        "limit": judged.requirement.limit,
        "outcome": judged.outcome,
        "reasons": reasons_json(judged.reasons),
        "sentence": judged.sentence,
    }


def residual_torque_json(
    observed: NoiseCorrectedSeries | None, fit: Estimate | None
) -> View | None:
    """Return what was felt, and the centre of mass that it tells, as the masses stand."""
    if observed is None:
        return None
    usable = fit is not None and fit.outcome.usable
    return {
        "rms": observed.rms,
        "rms_sd": observed.rms_sd,
        "greatest": observed.greatest,
        "noise": observed.noise,
        "com": numbers(fit.com) if usable and fit is not None else None,
        "com_covariance": numbers(fit.covariance_of(COM)) if usable and fit is not None else None,
    }


def hanging_json(hanging: Hanging, weight: float) -> View:
    """Return a swing and the distance that it tells."""
    swing = hanging.swing
    return {
        "mode": {0: "slow", 1: "quick", None: "both"}[hanging.mode],
        "frequency": swing.frequency,
        "frequency_sd": swing.sd,
        "period": 1 / swing.frequency,
        "amplitude": swing.amplitude,
        "decay": swing.decay,
        "distance": hanging.moment / weight,
        "distance_sd": hanging.sd / weight,
    }
