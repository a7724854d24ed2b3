"""`equipoise observe`: what a recording can and cannot show, before any estimate is believed."""

from pathlib import Path

from equipoise.app.arguments.estimated_terms import NOTHING_STATED, Seeking
from equipoise.app.arguments.recording_window import WHOLE, Reading
from equipoise.app.arguments.types import Flag
from equipoise.app.console.terminal import busy


def observe(
    file: str,
    /,
    *,
    testbed: str,
    seeking: Seeking = NOTHING_STATED,
    reading: Reading = WHOLE,
    json: Flag = False,
    out: Path | None = None,
) -> int:
    """Say what a recording can and cannot show: the least sd that any method can reach.

    Nothing is estimated. Motion and sensors decide, not what the rows happen to say.

    Parameters
    ----------
    file
        Recording, as CSV or Parquet.
    testbed
        Testbed file, or a preset's name; its sensors' noise counts.
    json
        Print one JSON document instead.
    out
        Folder for report and observe.json.
    """
    from equipoise.app.arguments.resolve import fitting_recording_of, spelt_out, testbed_of
    from equipoise.io.files.atomic_folder import check_folder

    bed, seeking = testbed_of(testbed), spelt_out(seeking)
    if out is not None:
        check_folder(out)
    recording = fitting_recording_of(file, reading, bed)
    with busy("following the motion"):
        from equipoise.app.runs.observation import run
        from equipoise.estimation.method_contract import Options

        done = run(recording, bed, Options(seeking.term, seeking.hold, seeking.prior))
    from equipoise.app.logbook.output import hand_over
    from equipoise.app.views.observe_views import output_of

    hand_over(output_of(done), json, out)
    return 0
