"""`equipoise compare`: methods on the same records, laws on the same platforms."""

from pathlib import Path
from typing import TYPE_CHECKING

from equipoise.app.commands.kinds import Flag, Names, Triple, Whole
from equipoise.app.commands.seeking import NOTHING_TOLD, Seeking
from equipoise.app.terminal import busy, tell_paths

if TYPE_CHECKING:
    from equipoise.app.comparison_report import Compared


def compare(
    testbed: str,
    /,
    *,
    methods: Flag = False,
    laws: Flag = False,
    only: Names = (),
    runs: Whole = 20,
    seed: Whole = 1,
    duration_s: float = 120.0,
    move: Names = (),
    seeking: Seeking = NOTHING_TOLD,
    target_um: Triple = (0.0, 0.0, 0.0),
    tolerance_um: Triple = (2.0, 2.0, 3.0),
    tilt_deg: float = 20.0,
    require_torque: float = 1e-5,
    max_time_s: float = 600.0,
    workers: Whole = 2,
    json: Flag = False,
    out: Path | None = None,
) -> int:
    """Run methods on the same records, or laws on the same platforms, and say which to take.

    Platforms are simulated, and their truth judges. Ends with 1 when no method, or no law, can be
    recommended for the centre of mass.

    Parameters
    ----------
    testbed
        Testbed file, or a preset's name. Its [truth] says what the simulated platforms are like.
    methods
        Compare methods of `equipoise methods`.
    laws
        Compare laws of `equipoise laws`.
    only
        Methods and laws to compare, one or several with commas; may be repeated. Of a kind that
        none is named of: all, of laws those that the testbed has the devices for.
    runs
        Platforms, each with one record for all methods and one balancing by each law.
    seed
        Seed of the first platform; the others follow.
    duration_s
        Methods: length of each record.
    move
        Methods: move of masses, "seconds: mass=mm mass=mm" from home. May be repeated.
    target_um
        Laws: where the centre of mass is wanted, from the centre of rotation, body axes.
    tolerance_um
        Laws: how near to the target is near enough, along each axis; verdicts are about it.
    tilt_deg
        Laws: torque counts over directions within so many degrees of level.
    require_torque
        Laws: torque that is wanted at most, rms over that range, N m.
    max_time_s
        Laws: bench time that each run may take, its proof included.
    workers
        Processes to spread the runs over.
    json
        Print one JSON document instead.
    out
        Folder for compare.html, compare.json, figures, and methods.csv or laws.csv, a line a run.
    """
    from equipoise.app.options import not_negative, positive, seed_of, tolerance, vector
    from equipoise.app.units import UM
    from equipoise.app.wiring import move_of, spelt_out, testbed_of
    from equipoise.io.whole_folder import check_folder
    from equipoise.model.errors import InputError

    if not (methods or laws):
        raise InputError("compare", "nothing to compare", "--methods or --laws")
    bed, first = testbed_of(testbed), seed_of(seed)
    seeds = range(first, first + int(positive("--runs", runs)))
    moves = [move_of(text, bed) for text in move]
    duration, seeking = positive("--duration-s", duration_s), spelt_out(seeking)
    goal = (
        vector("--target-um", target_um, 1 / UM),
        tolerance("--tolerance-um", tolerance_um, 1 / UM),
    )
    limits = (not_negative("--tilt-deg", tilt_deg), positive("--require-torque", require_torque))
    longest, many = positive("--max-time-s", max_time_s), int(positive("--workers", workers))
    if out is not None:
        check_folder(out)
    with busy("preparing", announce=False):
        from equipoise.app import comparing
        from equipoise.app.comparison_report import Compared
        from equipoise.estimation.method import Options
        from equipoise.study.method_record import Scene

        kinds = comparing.by_kind(only, methods, laws)
        names = comparing.chosen_methods(kinds[0]) if methods else ()
        cards = comparing.chosen(bed, kinds[1]) if laws else []
        options = Options(seeking.term, seeking.hold, seeking.prior)
    asked = {"platforms": f"{len(seeds)}, seeds {seeds[0]} to {seeds[-1]}"}
    measured = balanced = None
    if methods:
        scene = Scene(bed, duration, moves, options)
        measured = comparing.run_methods(scene, names, seeds, many)
        asked |= {"records": f"{duration:g} s; moves: {', '.join(move) or 'none'}"}
    if laws:
        balanced = comparing.run(comparing.Asked(bed, cards, seeds, *goal, *limits, longest), many)
        asked |= {"balancing": f"{longest:g} s at most, {require_torque:g} N m required"}
    done = Compared(bed, asked, measured, balanced)
    _tell(done, json, out)
    return _code(done)


def _tell(done: "Compared", json: bool, out: Path | None) -> None:
    """Print the result, and write it down if that is asked for."""
    from equipoise.app.comparison_report import document, files_of, show
    from equipoise.app.views_json import dump
    from equipoise.io.whole_folder import write_folder

    if json:
        print(dump(document(done)))
    else:
        show(done)
    if out is not None:
        with busy("drawing"):
            files = files_of(done)
        tell_paths(write_folder(out, files), json)


def _code(done: "Compared") -> int:
    """Return 0 if something can be recommended of each kind that was compared."""
    from equipoise.study.recommend import advised_method, reached

    methods = done.methods is None or advised_method(done.methods.methods, "com").name is not None
    return 0 if methods and (done.laws is None or reached(done.laws)) else 1
