"""`equipoise compare`: every law on the same platforms."""

from pathlib import Path

from equipoise.app.commands.kinds import Flag, Names, Triple, Whole
from equipoise.app.terminal import busy, stdout, tell_paths


def compare(
    testbed: str,
    /,
    *,
    laws: Flag = False,
    only: Names = (),
    runs: Whole = 20,
    seed: Whole = 1,
    target_um: Triple = (0.0, 0.0, 0.0),
    tolerance_um: Triple = (2.0, 2.0, 3.0),
    tilt_deg: float = 20.0,
    require_torque: float = 1e-5,
    max_time_s: float = 600.0,
    workers: Whole = 2,
    json: Flag = False,
    out: Path | None = None,
) -> int:
    """Run balancing laws on the same simulated platforms, and tell what each leaves.

    Ends with 1 when no law reaches the required torque in 95 % of its runs.

    Parameters
    ----------
    testbed
        Testbed file, or a preset's name. Its [truth] says what the simulated platforms are like.
    laws
        Compare balancing laws.
    only
        Laws to compare. Left out: all that the testbed has the devices for.
    runs
        Platforms that each law balances.
    seed
        Seed of the first platform; the others follow.
    target_um
        Where the centre of mass is wanted, from the centre of rotation, body axes.
    tolerance_um
        How near to the target is near enough, along each axis; verdicts are about it.
    tilt_deg
        Torque counts over directions within so many degrees of level.
    require_torque
        Torque that is wanted at most, rms over that range, N m.
    max_time_s
        Bench time that each run may take, its proof included.
    workers
        Processes to spread the runs over.
    json
        Print one JSON document instead.
    out
        Folder for compare.json and laws.csv, one line a run.
    """
    from equipoise.app.options import not_negative, positive, seed_of, tolerance, vector
    from equipoise.app.units import UM
    from equipoise.app.wiring import testbed_of
    from equipoise.io.whole_folder import check_folder
    from equipoise.model.errors import InputError

    if not laws:
        raise InputError("compare", "nothing to compare", "--laws")
    bed, first = testbed_of(testbed), seed_of(seed)
    count = int(positive("--runs", runs))
    goal = (
        vector("--target-um", target_um, 1 / UM),
        tolerance("--tolerance-um", tolerance_um, 1 / UM),
    )
    limits = (not_negative("--tilt-deg", tilt_deg), positive("--require-torque", require_torque))
    longest, many = positive("--max-time-s", max_time_s), int(positive("--workers", workers))
    if out is not None:
        check_folder(out)
    with busy("preparing", announce=False):
        from equipoise.app.comparing import Asked, chosen, run
        from equipoise.app.law_views import comparison_json, comparison_table, files_of
        from equipoise.app.views_json import dump
        from equipoise.io.whole_folder import write_folder

        asked = Asked(bed, chosen(bed, only), range(first, first + count), *goal, *limits, longest)
    found = run(asked, many)
    if json:
        print(dump(comparison_json(found)))
    else:
        stdout().print(comparison_table(found))
    if out is not None:
        tell_paths(write_folder(out, files_of(found)), json)
    return 0 if any(law.within >= 0.95 * law.runs for law in found.laws) else 1
