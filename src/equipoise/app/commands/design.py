"""`equipoise design`: are masses and sensors good enough, what limits them, what to buy next."""

from pathlib import Path

from equipoise.app.arguments.environment import CALM, Exposure, surroundings_of
from equipoise.app.arguments.options import ALONE, Json, Several, Spreading, Triple, Whole
from equipoise.app.console.terminal import announced, busy


def design(
    testbed: str,
    /,
    *,
    record_s: Several = (30.0, 60.0, 120.0, 300.0),
    target_um: Triple = (0.0, 0.0, 0.0),
    tilt_deg: float = 20.0,
    moves: Whole = 2,
    misalignment_deg: float = 0.0,
    exposure: Exposure = CALM,
    require_torque: float | None = None,
    spreading: Spreading = ALONE,
    json: Json = False,
    out: Path | None = None,
) -> int:
    """Size the masses and sensors of a testbed: reach, resolution, achievable torque.

    The torque budget is for the shortest record. Exit code 1: the required torque cannot be met.

    Parameters
    ----------
    testbed
        Testbed file, or a preset's name.
    record_s
        Lengths of the records from which the centre of mass is estimated, s.
    target_um
        Target of the centre of mass, from the centre of rotation, body axes.
    tilt_deg
        Evaluate torque over all directions within this angle of level.
    moves
        Number of measure-and-move iterations.
    misalignment_deg
        Misalignment of the rails, one sd about each transverse axis.
    require_torque
        Maximum permitted residual torque, rms over these directions, N m, with 95 % of the
        platforms within reach of the masses.
    out
        Folder for report, figures and design.json.
    """
    from equipoise.app.arguments.checks import check_outputs, not_negative, positive, vector
    from equipoise.app.arguments.inputs import testbed_with_masses
    from equipoise.app.arguments.many_runs import engine_from
    from equipoise.model.units import DEG, UM, in_si

    lengths = [positive("--record-s", length) for length in record_s]
    target = vector("--target-um", target_um, UM)
    tilt = in_si(positive("--tilt-deg", tilt_deg), DEG)
    count = int(positive("--moves", moves))
    lean = in_si(not_negative("--misalignment-deg", misalignment_deg), DEG)
    positive("--require-torque", require_torque)
    around, bed = surroundings_of(exposure), announced(testbed_with_masses(testbed))
    engine = engine_from(spreading)
    check_outputs(out)
    with busy("computing"):
        from equipoise.app.engine.spread import spread_over
        from equipoise.app.logbook.output import hand_over
        from equipoise.app.views.design_views import output_of
        from equipoise.planning.sizing.case import Case
        from equipoise.planning.sizing.sizing import sized

        case = Case(bed, target, tilt, lengths[0], count, lean, around)
        with engine() as pool:
            found = sized(case, lengths, require_torque, spread_over(pool))
    hand_over(output_of(found), json, out)
    return 0 if found.verdict.passed else 1
