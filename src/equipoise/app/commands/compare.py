"""`equipoise compare`: methods on the same records, laws on the same platforms."""

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from cyclopts import Parameter

from equipoise.app.arguments.options import (
    NOTHING_STATED,
    USUAL,
    Flag,
    Json,
    Names,
    On,
    Searching,
    Seeking,
    Spreading,
    Triple,
    Whole,
)
from equipoise.app.console.terminal import announced, busy, notice

if TYPE_CHECKING:
    from equipoise.app.runs.comparison import Compared, LawGoal


@Parameter(name="*")
@dataclass(frozen=True, slots=True)
class JudgingLaws:
    """What laws are to reach, and within what.

    Attributes
    ----------
    target_um
        Laws: target of the centre of mass, from the centre of rotation, body axes.
    tolerance_um
        Laws: tolerance around the target along each axis; verdicts refer to it.
    tilt_deg
        Laws: evaluate torque over all directions within this angle of level.
    require_torque
        Laws: wanted torque at most, rms over these directions, N m.
    max_time_s
        Laws: bench time of each run, verification included.
    """

    target_um: Triple = (0.0, 0.0, 0.0)
    tolerance_um: Triple = (2.0, 2.0, 3.0)
    tilt_deg: float = 20.0
    require_torque: float = 1e-5
    max_time_s: float = 600.0


AS_THEY_ARE = JudgingLaws()


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
    searching: Searching = USUAL,
    judging: JudgingLaws = AS_THEY_ARE,
    workers: Whole = 2,
    on: On = "local",
    resume: Path | None = None,
    json: Json = False,
    out: Path | None = None,
) -> int:
    """Compare estimation methods on the same records, or control laws on the same platforms.

    Platforms are simulated, and their truth judges. Exit code 1: no method can be recommended for
    the centre of mass, or no law.

    Parameters
    ----------
    testbed
        Testbed file, or a preset's name. Its [truth] defines the simulated platforms.
    methods
        Compare the methods of `equipoise methods`.
    laws
        Compare the laws of `equipoise laws`.
    only
        Methods and laws to compare, separated by commas; may be repeated. Default: all methods, and
        all laws for which the testbed has the devices.
    runs
        Number of platforms; each has one record for all methods and one balancing by each law.
    seed
        Seed of the first platform; the others follow.
    duration_s
        Methods: length of each record.
    move
        Methods: move of masses, "seconds: mass=mm mass=mm" from home. May be repeated.
    workers
        Processes to distribute the runs over.
    resume
        Folder that keeps each result as it arrives. Results that it has are not computed again, so
        an interrupted comparison continues and can be extended.
    out
        Folder for report, figures, compare.json, and methods.csv or laws.csv with one line per run.
    """
    from equipoise.app.arguments.checks import check_outputs, duration_of, positive, seed_of
    from equipoise.app.arguments.inputs import move_of, options_of, testbed_from
    from equipoise.app.arguments.many_runs import engine_from

    bed, first = announced(testbed_from(testbed)), seed_of(seed)
    seeds = range(first, first + int(positive("--runs", runs)))
    moves = [move_of(text, bed) for text in move]
    duration = duration_of("--duration-s", duration_s, bed)
    engine = engine_from(Spreading(workers, on))
    check_outputs(out)
    with busy("preparing", announce=False):
        from equipoise.app.engine.running import Running
        from equipoise.app.logbook.output import hand_over
        from equipoise.app.runs.comparison import Contest, names_of, run_all
        from equipoise.app.runs.terminal_waiting import AT_TERMINAL, budget_at_terminal
        from equipoise.app.views.study.comparison_report import output_of
        from equipoise.study.method_record import Scene

        options = options_of(seeking, budget_at_terminal(searching))
        goal, names = _goal(judging), names_of(bed, only, methods, laws)
        scene = Scene(bed, duration, moves, options)
        running = Running(engine, resume, notice)
    done = run_all(Contest(names, scene, seeds, goal), running, AT_TERMINAL)
    hand_over(output_of(done), json, out)
    return _code(done)


def _goal(judging: JudgingLaws) -> "LawGoal":
    """Return what laws are to reach, checked."""
    from equipoise.app.arguments.checks import not_negative, positive, tolerance, vector
    from equipoise.app.runs.comparison import LawGoal
    from equipoise.model.units import DEG, UM, in_si

    return LawGoal(
        vector("--target-um", judging.target_um, UM),
        tolerance("--tolerance-um", judging.tolerance_um, UM),
        in_si(not_negative("--tilt-deg", judging.tilt_deg), DEG),
        positive("--require-torque", judging.require_torque),
        positive("--max-time-s", judging.max_time_s),
    )


def _code(done: "Compared") -> int:
    """Return 0 if something can be recommended of each kind that was compared."""
    from equipoise.study.recommend import advised_law, advised_method

    method = done.methods is None or advised_method(done.methods.methods, "com").name is not None
    law = done.laws is None or advised_law(done.laws).name is not None
    return 0 if method and law else 1
