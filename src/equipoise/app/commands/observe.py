"""`equipoise observe`: what a recording can and cannot show, before any estimate is believed."""

from equipoise.app.commands.kinds import Flag
from equipoise.app.commands.reading import WHOLE, Reading
from equipoise.app.commands.seeking import NOTHING_TOLD, Seeking
from equipoise.app.terminal import busy


def observe(
    file: str,
    /,
    *,
    testbed: str,
    seeking: Seeking = NOTHING_TOLD,
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
    from equipoise.app.wiring import fitting_recording_of, spelt_out, testbed_of

    bed, seeking = testbed_of(testbed), spelt_out(seeking)
    recording = fitting_recording_of(file, reading, bed)
    with busy("following the motion"):
        from equipoise.estimation.filter_observability import filters_along
        from equipoise.estimation.fisher import seen_along
        from equipoise.estimation.followed_motion import followed
        from equipoise.estimation.method import Options
        from equipoise.estimation.methods.trajectory import params_of
        from equipoise.procedure.sound_rows import sound

        sound_recording, as_seen = sound(recording, bed)
        asked = params_of(bed, Options(seeking.term, seeking.hold, seeking.prior))
        motion = followed(sound_recording, as_seen, asked)
        seen, filters = seen_along(motion), filters_along(motion)
    from equipoise.app.observe_views import observe_json, show_observability
    from equipoise.app.views_json import dump

    if json:
        print(dump(observe_json(recording, seen, filters)))
    else:
        show_observability(seen, filters)
    return 0
