"""`equipoise observe`: what a recording can and cannot show, before anything is estimated."""

from pathlib import Path

from equipoise.app.arguments.options import (
    NOTHING_STATED,
    USUAL,
    WHOLE,
    Json,
    Reading,
    Searching,
    Seeking,
)
from equipoise.app.console.terminal import announced, busy


def observe(
    file: str,
    /,
    *,
    testbed: str,
    seeking: Seeking = NOTHING_STATED,
    searching: Searching = USUAL,
    reading: Reading = WHOLE,
    json: Json = False,
    out: Path | None = None,
) -> int:
    """Compute the Cramer-Rao bound: what a recording can determine at best.

    Nothing is estimated: motion and sensor noise determine the bound.

    Parameters
    ----------
    file
        Recording.
    testbed
        Testbed file, or a preset's name, with the sensor noise.
    out
        Folder for report and observe.json.
    """
    from equipoise.app.arguments.checks import check_outputs
    from equipoise.app.arguments.inputs import fitting_recording_of, options_of, testbed_from
    from equipoise.app.runs.terminal_waiting import budget_at_terminal

    bed = announced(testbed_from(testbed))
    options = options_of(seeking, budget_at_terminal(searching))
    check_outputs(out)
    recording = fitting_recording_of(file, reading, bed)
    with busy("following the motion"):
        from equipoise.app.runs.recordings.observation import run

        done = run(recording, bed, options)
    from equipoise.app.logbook.output import hand_over
    from equipoise.app.views.observe_views import output_of

    hand_over(output_of(done), json, out)
    return 0
