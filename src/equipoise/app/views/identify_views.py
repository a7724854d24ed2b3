"""An identification for terminal, JSON and report."""

from equipoise.app.charts.catalogue import charts_of_estimate
from equipoise.app.charts.of_correlation import correlations_of
from equipoise.app.figures.catalogue import of_estimate
from equipoise.app.figures.step_catalogue import Frame, pictures_of_steps
from equipoise.app.report.build import estimate_sections, findings_section, steps_section
from equipoise.app.report.run_record import Logged, Output, RunRecord, origin
from equipoise.app.runs.recordings.identification import Identification
from equipoise.app.text.blocks import Blocks, paragraphs
from equipoise.app.text.estimate_text import (
    estimate_tables,
    outcome_claim,
    residual_line,
    unobservable_items,
)
from equipoise.app.text.json_document import estimate_json
from equipoise.app.text.json_shape import View
from equipoise.app.text.run_blocks import recording_blocks
from equipoise.app.views.plan_check import kept_json, plan_blocks
from equipoise.procedure.identification.record_courses import RecordCourses


def output_of(done: Identification) -> Output:
    """Return all that is handed over."""
    return Output(
        "estimate",
        document(done),
        blocks(done),
        lambda: record_of(done, done.courses()),
        logged_of(done),
    )


def blocks(done: Identification) -> Blocks:
    """Return the estimate and its outcome, what it rests on, and what the recording contains."""
    estimate = done.estimate
    return (
        *estimate_tables(estimate),
        outcome_claim(estimate),
        *unobservable_items(estimate),
        *paragraphs(residual_line(estimate.residual)),
        *plan_blocks(done.plan, estimate),
        *recording_blocks(done.findings),
    )


def document(done: Identification) -> View:
    """Return the estimate as JSON, with the findings."""
    checked = None if done.plan is None else kept_json(done.plan, done.estimate)
    return estimate_json(done.estimate, done.findings, checked)


def logged_of(done: Identification, is_file: bool = True) -> Logged:
    """Return what a logbook keeps beside the report."""
    method, recording = done.estimate.method, done.recording
    return Logged("identify", method, "recording", recording, done.estimate, is_file=is_file)


def record_of(done: Identification, courses: RecordCourses) -> RunRecord:
    """Return the identification as a report."""
    shown = pictures_of_steps(done.steps, Frame(done.testbed, at_home=True))
    return RunRecord(
        title="Mass properties from a recording",
        requested={"recording": done.recording.source, "method": done.estimate.method},
        testbed=done.testbed,
        conclusion=(outcome_claim(done.estimate),),
        sections=(
            *findings_section(done.findings),
            steps_section("Steps", done.steps, shown),
            *estimate_sections(
                done.estimate,
                done.testbed,
                *plan_blocks(done.plan, done.estimate),
                *correlations_of(done.estimate),
            ),
        ),
        origin=origin(sha256=done.recording.sha256),
        figures=list(of_estimate(done.recording, done.estimate, courses)),
        step_figures=tuple(shown.values()),
        charts=charts_of_estimate(done.recording, done.testbed, done.estimate, courses),
    )
