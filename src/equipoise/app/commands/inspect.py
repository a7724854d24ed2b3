"""`equipoise inspect`: what a file holds and what is wrong with it."""

from pathlib import Path
from typing import TYPE_CHECKING

from equipoise.app.arguments.options import USUAL, WHOLE, Json, Reading, Searching
from equipoise.app.console.terminal import show_paths

if TYPE_CHECKING:
    from equipoise.model.finding import Finding
    from equipoise.model.testbed import Testbed


def inspect(
    file: str,
    /,
    *,
    testbed: str | None = None,
    searching: Searching = USUAL,
    reading: Reading = WHOLE,
    json: Json = False,
    figure: Path | None = None,
) -> int:
    """Summarise a recording: channels, rates, gaps, faults.

    Lines marked '!' name what impairs an estimate, lines marked '~' corrections.

    Parameters
    ----------
    file
        Recording.
    testbed
        Testbed file, or a preset's name: adds checks that depend on it, such as the vertical axis,
        and events: contacts and shifted parts.
    figure
        Figure of the record and its findings to write, such as record.png.
    """
    from equipoise.app.arguments.inputs import recording_of, testbed_from
    from equipoise.app.logbook.output import print_result
    from equipoise.app.text.json_document import recording_json
    from equipoise.app.text.run_blocks import finding_items
    from equipoise.assessment.findings.event_findings import NOT_SOUGHT
    from equipoise.assessment.findings.record_findings import findings

    bed = None if testbed is None else testbed_from(testbed)
    recording = recording_of(file, reading)
    found = [*findings(recording, bed)]
    found += [NOT_SOUGHT] if bed is None else _happened(file, reading, bed, searching)
    if figure is not None:
        from equipoise.app.figures.base.files import write_figure
        from equipoise.app.figures.recording.record import draw

        write_figure(draw(recording, found, None if bed is None else bed.up), figure)
    print_result(recording_json(recording, found), finding_items(found), json)
    if figure is not None and not json:
        show_paths([figure])
    return 0


def _happened(
    file: str, reading: Reading, testbed: "Testbed", searching: Searching
) -> "list[Finding]":
    """Return what a fit of the record stepped over, and how well it explains the rest."""
    from equipoise.app.arguments.inputs import fitting_recording_of
    from equipoise.app.console.terminal import watched
    from equipoise.app.runs.terminal_waiting import budget_at_terminal
    from equipoise.assessment.findings.event_findings import event_findings
    from equipoise.model.finding import Finding
    from equipoise.procedure.identification.identify import IdentifyOptions, identify

    recording = fitting_recording_of(file, reading, testbed)
    options = IdentifyOptions("trajectory", budget=budget_at_terminal(searching))
    *_, last = watched(identify(recording, testbed, options), "fitting")
    if last.estimate is None:
        return []
    outcome = last.estimate.outcome
    kind = "content" if outcome.usable else "problem"
    return [*event_findings(last.estimate), Finding(kind, outcome.reasons)]
