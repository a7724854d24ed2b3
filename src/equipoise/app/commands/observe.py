"""`equipoise observe`: what a recording can and cannot show, before any estimate is believed."""

from equipoise.app.commands.kinds import Flag, Names
from equipoise.app.terminal import busy


def observe(
    file: str,
    /,
    *,
    testbed: str,
    hold: Names = (),
    term: Names = (),
    prior: Flag = False,
    dialect: str | None = None,
    columns: str | None = None,
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
    hold
        Parameter taken as known, such as inertia_P_zz. May be repeated.
    term
        Torque to seek too: viscous, quadratic, constant, swirl, sag or drift. May be repeated.
    prior
        Count what the testbed states of inertia and centre of mass, with their sd.
    dialect
        How to read the table: native, optitrack or ros. Left out: by its header.
    columns
        Column map (TOML) for a table of any other kind.
    json
        Print one JSON document instead.
    """
    from equipoise.app.options import one_of
    from equipoise.app.wiring import fitting_recording_of, testbed_of
    from equipoise.model.estimate import COM, INERTIA
    from equipoise.model.torque_terms import expand

    bed, terms = testbed_of(testbed), expand(term, "--term")
    for name in hold:
        one_of("--hold", name, [*COM, *INERTIA])
    recording = fitting_recording_of(file, dialect, columns, bed)
    with busy("following the motion"):
        from equipoise.estimation.filter_observability import filters_along
        from equipoise.estimation.fisher import seen_along
        from equipoise.estimation.followed_motion import followed
        from equipoise.estimation.method import Options
        from equipoise.estimation.methods.trajectory import params_of
        from equipoise.procedure.sound_rows import sound

        sound_recording, as_seen = sound(recording, bed)
        asked = params_of(bed, Options(terms, hold, prior))
        motion = followed(sound_recording, as_seen, asked)
        seen, filters = seen_along(motion), filters_along(motion)
    from equipoise.app.observe_views import observe_json, show_observability
    from equipoise.app.views_json import dump

    if json:
        print(dump(observe_json(recording, seen, filters)))
    else:
        show_observability(seen, filters)
    return 0
