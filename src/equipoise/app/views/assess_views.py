"""An assessment for terminal, JSON and report."""

from collections.abc import Iterator

import numpy as np

from equipoise.app.charts.catalogue import charts_of_assessment
from equipoise.app.charts.of_correlation import correlations_of
from equipoise.app.figures.balancing import com_over_hours, residual_torque, torque_in_range
from equipoise.app.figures.catalogue import Picture
from equipoise.app.figures.recording import swing_spectrum
from equipoise.app.figures.step_catalogue import Frame, pictures_of_steps
from equipoise.app.report.build import estimate_sections, findings_section, steps_section
from equipoise.app.report.run_record import Output, RunRecord, origin
from equipoise.app.runs.recordings.assessment import AssessedPlatform
from equipoise.app.text.blocks import Blocks, Section, paragraphs
from equipoise.app.text.estimate_text import outcome_claim, unobservable_items
from equipoise.app.text.json_document import estimate_json
from equipoise.app.text.json_results import ASSESS
from equipoise.app.text.json_shape import View
from equipoise.app.text.run_blocks import recording_blocks, verdict_blocks
from equipoise.app.views.assess_tables import (
    change_table,
    check_items,
    hours_table,
    measurements_table,
    range_table,
    torque_table,
)
from equipoise.assessment.metrics.swing_height import Hanging
from equipoise.model.estimate import COM, Estimate
from equipoise.model.noise_corrected_series import NoiseCorrectedSeries
from equipoise.model.units import UM
from equipoise.procedure.identification.assess import Assessment


def output_of(reported: AssessedPlatform) -> Output:
    """Return all that is handed over."""
    return Output(
        "assess",
        document(reported),
        blocks(reported),
        lambda: record_of(reported),
    )


def blocks(reported: AssessedPlatform) -> Blocks:
    """Return tables and the verdict, what it rests on, and what the recording contains."""
    return (
        *tables_of(reported),
        *conclusion(reported),
        *paragraphs("" if reported.steps[-1].verdict else reported.steps[-1].sentence),
        *unobservable_items(reported.done.estimate),
        *recording_blocks(reported.findings),
    )


def tables_of(reported: AssessedPlatform) -> Blocks:
    """Return tables and cross-checks; where the fit is of no use, the residual torque alone."""
    done = reported.done
    usable = ()
    if done.estimate.outcome.usable:
        usable = (range_table(done), measurements_table(done), *check_items(done))
    before = () if reported.before is None else (change_table(reported.before, done),)
    hours = () if reported.hours is None else (hours_table(reported.hours),)
    return (*usable, torque_table(done), *before, *hours)


def record_of(reported: AssessedPlatform) -> RunRecord:
    """Return the assessment as a report."""
    done = reported.done
    shown = pictures_of_steps(reported.steps, Frame(done.testbed))
    return RunRecord(
        title="Assessment",
        requested=requested(reported),
        testbed=done.testbed,
        conclusion=conclusion(reported),
        sections=(
            *findings_section(reported.findings),
            steps_section("Steps", reported.steps, shown),
            Section("Results", tables_of(reported)),
            *estimate_sections(done.estimate, done.testbed, *correlations_of(done.estimate)),
        ),
        origin=origin(sha256=done.recording.sha256),
        figures=list(pictures_of(reported)),
        step_figures=tuple(shown.values()),
        charts=charts_of_assessment(done.recording, done.testbed, done.estimate),
    )


def conclusion(reported: AssessedPlatform) -> Blocks:
    """Return the verdict and the noise floor, or without one what the estimate comes to."""
    verdict = reported.steps[-1].verdict
    return (outcome_claim(reported.done.estimate),) if verdict is None else verdict_blocks(verdict)


def requested(reported: AssessedPlatform) -> dict[str, str]:
    """Return what was requested, as texts."""
    done, before, options = reported.done, reported.before, reported.done.options
    texts = {
        "recording": done.recording.source,
        "target": f"({', '.join(f'{x / UM:g}' for x in options.target)}) um",
        "range of tilts": f"{np.degrees(options.tilt):g} deg",
    }
    if before is not None:
        texts["before"] = before.recording.source
    return texts | {f"required {n}": each.sentence for n, each in enumerate(done.judged, 1)}


def pictures_of(reported: AssessedPlatform) -> Iterator[Picture]:
    """Yield the figures."""
    done, hours = reported.done, reported.hours
    if done.estimate.outcome.usable:
        yield Picture("torque_in_range", torque_in_range.CAPTION, torque_in_range.draw(done))
    if done.metrics.torque is not None:
        yield Picture(
            "residual_torque", residual_torque.CAPTION, residual_torque.draw(done.metrics.torque)
        )
    if done.metrics.spectrum is not None:
        yield Picture("swing_spectrum", swing_spectrum.CAPTION, swing_spectrum.draw(done))
    if hours is not None and hours.wander is not None:
        drawn = com_over_hours.draw(hours, hours.wander)
        yield Picture("com_over_hours", com_over_hours.CAPTION, drawn)


def document(reported: AssessedPlatform) -> View:
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
        "swings": [swing_of(each, done.testbed.weight) for each in metrics.hanging],
        "cross_checks": done.checks,
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
