"""`equipoise identify`: mass properties from a recording."""

from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

from equipoise.app.arguments.estimated_terms import NOTHING_STATED, Seeking
from equipoise.app.arguments.recording_window import WHOLE, Reading
from equipoise.app.arguments.types import Flag
from equipoise.app.console.terminal import busy

if TYPE_CHECKING:
    from equipoise.app.runs.identification import Identification


def identify(
    file: str,
    /,
    *,
    testbed: str,
    method: str = "auto",
    robust: Flag = False,
    plan: Path | None = None,
    seeking: Seeking = NOTHING_STATED,
    reading: Reading = WHOLE,
    json: Flag = False,
    out: Path | None = None,
) -> int:
    """Estimate centre of mass and inertia from a recording, and say what it cannot show.

    Ends with 1 when the estimate is not usable; the sentence under the tables says why.

    Parameters
    ----------
    file
        Recording, as CSV or Parquet.
    testbed
        Testbed file, or a preset's name.
    method
        auto, or one of those that `equipoise methods` lists.
    robust
        Give rows that stand far off less weight.
    plan
        Plan file that the recording was made by: what it predicted is compared with what is found.
    json
        Print one JSON document instead.
    out
        Folder for report, figures and estimate.json; else one of its own in equipoise-runs.
    """
    from equipoise.app.arguments.checks import one_of
    from equipoise.app.arguments.resolve import fitting_recording_of, spelt_out, testbed_of
    from equipoise.io.documents.plan_file import read_plan
    from equipoise.io.files.atomic_folder import check_folder

    bed, seeking = testbed_of(testbed), spelt_out(seeking)
    if out is not None:
        check_folder(out)
    recording = fitting_recording_of(file, reading, bed)
    planned = None if plan is None else read_plan(plan, bed)
    with busy("identifying", announce=False):
        from equipoise.app.console.waiting import AT_TERMINAL
        from equipoise.app.runs.identification import run
        from equipoise.app.views.identify_views import show_findings
        from equipoise.estimation.methods.registry import METHODS
        from equipoise.procedure.identification.identify import IdentifyOptions

    one_of("--method", method, ["auto", *METHODS])
    options = IdentifyOptions(method, seeking.term, seeking.hold, seeking.prior, robust)
    show = None if json else show_findings
    done = replace(run(recording, bed, options, AT_TERMINAL, show), plan=planned)
    _report(done, json, out)
    return 0 if done.estimate.outcome.usable else 1


def _report(done: "Identification", json: bool, out: Path | None) -> None:
    """Print the result, and write it down if that is asked for."""
    from equipoise.app.logbook.output import hand_over, keep
    from equipoise.app.report.write import write_run
    from equipoise.app.views.identify_views import account_of, document_of, kept_of, show_result
    from equipoise.procedure.identification.record_courses import identification_courses

    document = document_of(done)

    def written(folder: Path) -> list[Path]:
        courses = identification_courses(done.recording, done.testbed, done.steps)
        account = account_of(done, courses)
        return write_run(account, document, "estimate", kept_of(done), folder)

    hand_over(document, lambda: show_result(done), written, json, out)
    if out is None:
        keep(written, "identify", done.testbed.name)
