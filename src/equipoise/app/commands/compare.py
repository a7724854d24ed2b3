"""`equipoise compare`: methods on the same records, laws on the same platforms."""

from pathlib import Path
from typing import TYPE_CHECKING

from equipoise.app.arguments.estimated_terms import NOTHING_STATED, Seeking
from equipoise.app.arguments.law_comparison import AS_THEY_ARE, JudgingLaws
from equipoise.app.arguments.types import Flag, Names, Whole
from equipoise.app.console.terminal import busy

if TYPE_CHECKING:
    from equipoise.app.views.comparison_report import Compared
    from equipoise.model.arrays import Vector3
    from equipoise.model.testbed import Testbed
    from equipoise.simulation.record import Moves
    from equipoise.study.method_record import Scene

    Goal = tuple[Vector3, Vector3, float, float, float]


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
    seeking: Seeking = NOTHING_STATED,
    judging: JudgingLaws = AS_THEY_ARE,
    workers: Whole = 2,
    json: Flag = False,
    out: Path | None = None,
) -> int:
    """Run methods on the same records, or laws on the same platforms, and say which to take.

    Platforms are simulated, and their truth judges. Ends with 1 when no method can be recommended
    for the centre of mass, or no law.

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
    workers
        Processes to spread the runs over.
    json
        Print one JSON document instead.
    out
        Folder for the report, figures, compare.json, and methods.csv or laws.csv, a line a run.
    """
    from equipoise.app.arguments.checks import positive
    from equipoise.app.arguments.resolve import move_of, spelt_out, testbed_of
    from equipoise.io.files.atomic_folder import check_folder
    from equipoise.model.errors import InputError

    if not (methods or laws):
        raise InputError("compare", "nothing to compare", "--methods or --laws")
    bed, seeds = testbed_of(testbed), _seeds(seed, runs)
    moves = [move_of(text, bed) for text in move]
    duration, seeking = positive("--duration-s", duration_s), spelt_out(seeking)
    many, goal = int(positive("--workers", workers)), _goal(judging)
    if out is not None:
        check_folder(out)
    with busy("preparing", announce=False):
        from equipoise.app.runs import comparison
        from equipoise.app.views.comparison_report import Compared

        kinds = comparison.by_kind(only, methods, laws)
        names = comparison.chosen_methods(kinds[0]) if methods else ()
        cards = comparison.chosen(bed, kinds[1]) if laws else []
        scene = _scene(bed, duration, moves, seeking)
    measured = comparison.run_methods(scene, names, seeds, many) if methods else None
    balanced = comparison.run(comparison.Request(bed, cards, seeds, *goal), many) if laws else None
    done = Compared(bed, _requested(seeds, duration, move, goal), measured, balanced)
    _report(done, json, out)
    return _code(done)


def _seeds(seed: int, runs: int) -> range:
    """Return the platforms' seeds, checked."""
    from equipoise.app.arguments.checks import positive, seed_of

    first = seed_of(seed)
    return range(first, first + int(positive("--runs", runs)))


def _scene(bed: "Testbed", duration: float, moves: "Moves", seeking: Seeking) -> "Scene":
    """Return what methods are compared on, and what they are asked."""
    from equipoise.estimation.method_contract import Options
    from equipoise.study.method_record import Scene

    return Scene(bed, duration, moves, Options(seeking.term, seeking.hold, seeking.prior))


def _requested(seeds: range, duration: float, moves: Names, goal: "Goal") -> dict[str, str]:
    """Return what was asked, as the report has it."""
    *_, torque, time = goal
    return {
        "platforms": f"{len(seeds)}, seeds {seeds[0]} to {seeds[-1]}",
        "records": f"{duration:g} s; moves: {', '.join(moves) or 'none'}",
        "laws": f"{time:g} s at most, {torque:g} N m required",
    }


def _goal(judging: JudgingLaws) -> "Goal":
    """Return target and tolerance (m), tilt (deg), torque (N m) and time (s), checked."""
    from equipoise.app.arguments.checks import not_negative, positive, tolerance, vector
    from equipoise.app.text.units import UM

    return (
        vector("--target-um", judging.target_um, 1 / UM),
        tolerance("--tolerance-um", judging.tolerance_um, 1 / UM),
        not_negative("--tilt-deg", judging.tilt_deg),
        positive("--require-torque", judging.require_torque),
        positive("--max-time-s", judging.max_time_s),
    )


def _report(done: "Compared", json: bool, out: Path | None) -> None:
    """Print the result, and write it down if that is asked for."""
    from equipoise.app.logbook.output import hand_over
    from equipoise.app.views.comparison_report import document, files_of, show
    from equipoise.io.files.atomic_folder import write_folder

    def written(folder: Path) -> list[Path]:
        return write_folder(folder, files_of(done))

    hand_over(document(done), lambda: show(done), written, json, out)


def _code(done: "Compared") -> int:
    """Return 0 if something can be recommended of each kind that was compared."""
    from equipoise.study.recommend import advised_law, advised_method

    method = done.methods is None or advised_method(done.methods.methods, "com").name is not None
    law = done.laws is None or advised_law(done.laws).name is not None
    return 0 if method and law else 1
