"""An assessment as one JSON document, SI units."""

from equipoise.app.report.run_record import Output
from equipoise.app.runs.assessment import AssessedPlatform
from equipoise.app.text.json_document import estimate_json
from equipoise.app.text.json_results import ASSESS
from equipoise.app.text.json_shape import View
from equipoise.app.views.assess_views import blocks, record_of
from equipoise.assessment.metrics.swing_height import Hanging
from equipoise.model.estimate import COM, Estimate
from equipoise.model.noise_corrected_series import NoiseCorrectedSeries
from equipoise.procedure.identification.assess import Assessment


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
    done, before = reported.done, reported.before
    found = ASSESS.write({
        **platform_of(done),
        "verdict": reported.steps[-1].verdict,
        "required": done.judged,
        "before": None if before is None else platform_of(before),
        "over_hours": reported.hours,
        "estimate": done.estimate,
    })  # fmt: skip
    return found | {"estimate": estimate_json(done.estimate, reported.findings)}


def platform_of(done: Assessment) -> View:
    """Return what the document says of one recording."""
    metrics = done.metrics
    return {
        "done": done,
        "torque": along_record(metrics.torque, metrics.torque_fit),
        "energy": along_record(metrics.energy, metrics.energy_fit),
        "swings": [swing_of(each, done.weight) for each in metrics.hanging],
    }


def along_record(series: NoiseCorrectedSeries | None, fit: Estimate | None) -> View | None:
    """Return a series, and the centre of mass that it shows, as the masses stand."""
    if series is None:
        return None
    if fit is None or not fit.outcome.usable:
        return {"series": series, "com": None, "com_covariance": None}
    return {"series": series, "com": fit.com, "com_covariance": fit.covariance_of(COM)}


def swing_of(hanging: Hanging, weight: float) -> View:
    """Return a swing and the distance that it shows; ``weight`` is m g, N."""
    return {
        "mode": {0: "slow", 1: "quick", None: "both"}[hanging.mode],
        "swing": hanging.swing,
        "distance": hanging.moment / weight,
        "distance_sd": hanging.sd / weight,
    }
