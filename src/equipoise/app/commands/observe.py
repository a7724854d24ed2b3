"""`equipoise observe`: what a recording can and cannot show, before any estimate is believed."""

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
    """
    from equipoise.app.arguments.resolve import fitting_recording_of, spelt_out, testbed_of

    bed, seeking = testbed_of(testbed), spelt_out(seeking)
    recording = fitting_recording_of(file, reading, bed)
    with busy("following the motion"):
        from equipoise.app.runs.observation import run
        from equipoise.estimation.method_contract import Options

        done = run(recording, bed, Options(seeking.term, seeking.hold, seeking.prior))
    from equipoise.app.text.json_document import dump
    from equipoise.app.views.observe_views import observe_json, show_observability

    if json:
        print(dump(observe_json(done)))
    else:
        show_observability(done)
    return 0
