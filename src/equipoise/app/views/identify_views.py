"""An identification for terminal, JSON and report."""

from collections.abc import Sequence

from equipoise.app.console.rich_results import (
    estimate_tables,
    finding_line,
    residual_line,
    step_line,
)
from equipoise.app.console.terminal import stdout
from equipoise.app.figures.catalogue import of_estimate
from equipoise.app.figures.step_catalogue import Frame, pictures_of_steps
from equipoise.app.report.logbook_entry import Kept
from equipoise.app.report.run_record import Account, origin
from equipoise.app.runs.identification import Identification
from equipoise.app.text.json_document import View, estimate_json
from equipoise.app.views.plan_check import kept_json, kept_table, promise_sentences
from equipoise.model.finding import Finding
from equipoise.procedure.identification.record_courses import RecordCourses


def show_findings(findings: Sequence[Finding]) -> None:
    """Print what a recording holds and what is wrong with it."""
    console = stdout()
    for finding in findings:
        console.print(finding_line(finding))


def show_result(done: Identification) -> None:
    """Print what was done, the tables, what was not seen, and the sentence that sums it up."""
    console, estimate = stdout(), done.estimate
    console.print()
    for step in done.steps:
        console.print(step_line(step))
    for table in estimate_tables(estimate):
        console.print()
        console.print(table)
    if done.plan is not None and done.plan.com_sd is not None:
        console.print()
        console.print(kept_table(done.plan, estimate))
    console.print()
    for sentence in estimate.unobservable:
        console.print(f"! {sentence}", style="yellow", markup=False)
    if estimate.residual is not None:
        console.print(residual_line(estimate.residual), markup=False)
    for sentence in promise_sentences(done.plan, estimate):
        console.print(sentence, markup=False)
    style = "bold green" if estimate.outcome.usable else "bold red"
    console.print(estimate.outcome.sentence, style=style, markup=False)


def document_of(done: Identification) -> View:
    """Return the estimate as JSON, with the findings."""
    document = estimate_json(done.estimate, done.findings)
    return (
        document if done.plan is None else document | {"plan": kept_json(done.plan, done.estimate)}
    )


def kept_of(done: Identification) -> Kept:
    """Return what a logbook is told beside the report."""
    return Kept("identify", done.estimate.method, "recording", done.recording, is_file=True)


def account_of(done: Identification, courses: RecordCourses) -> Account:
    """Return the identification as a report."""
    return Account(
        title="Mass properties from a recording",
        requested={"recording": done.recording.source, "method": done.estimate.method},
        testbed=done.testbed,
        chapters={"Steps": done.steps},
        origin=origin(sha256=done.recording.sha256),
        findings=done.findings,
        estimate=done.estimate,
        pictures=list(of_estimate(done.recording, done.testbed, done.estimate, courses)),
        step_pictures=pictures_of_steps(
            done.steps, Frame(done.testbed, at_home=True, motions=courses.steps)
        ),
    )
