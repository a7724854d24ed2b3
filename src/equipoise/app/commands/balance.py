"""`equipoise balance`: look, move, look again, until the verdict passes."""

from collections.abc import Generator, Mapping
from contextlib import ExitStack, contextmanager
from pathlib import Path
from typing import TYPE_CHECKING

from equipoise.app.commands.by_hand import (
    MOVED,
    Asked,
    Manual,
    balance_by_hand,
    check_by_hand,
    is_by_hand,
)
from equipoise.app.commands.kinds import Flag, Triple, Whole
from equipoise.app.commands.reading import WHOLE, Reading
from equipoise.app.terminal import busy, stderr
from equipoise.model.errors import InputError

if TYPE_CHECKING:
    from equipoise.app.balancing import Balancing, Goal, Limits
    from equipoise.model.arrays import Vector3
    from equipoise.model.bench import Bench
    from equipoise.model.manoeuvre import Manoeuvre
    from equipoise.model.testbed import Testbed

Until = tuple[int | None, float | None, float]  # moves, s, s of holding


def balance(
    testbed: str,
    /,
    *,
    law: str = "look_and_move",
    seed: Whole = 1,
    plan: Path | None = None,
    target_um: Triple = (0.0, 0.0, -100.0),
    tolerance_um: Triple = (2.0, 2.0, 3.0),
    max_moves: Whole | None = None,
    max_time_s: float | None = None,
    hold_min: float = 0.0,
    by_hand: Manual = MOVED,
    reading: Reading = WHOLE,
    bench: Flag = False,
    record: Path | None = None,
    foxglove: Flag = False,
    yes: Flag = False,
    json: Flag = False,
    out: Path | None = None,
) -> int:
    """Balance a platform: look, move masses, look again; then test the result.

    The platform is simulated, or with --bench the real one that the testbed's [hardware] declares.
    With --manual a person places weights instead of masses that move, on a real platform if a
    --session is named. Ends with 1 when the verdict is that the platform is not balanced.

    Parameters
    ----------
    testbed
        Testbed file, or a preset's name. Its [truth] says what the simulated platform is like.
    law
        How to balance; `equipoise laws` lists them.
    seed
        Seed of all that is drawn: the same seed gives the same run.
    plan
        Plan file: begin with its manoeuvre, then balance on all that was recorded. Of
        look_and_move alone, without a hold.
    target_um
        Where the centre of mass is wanted, from the centre of rotation, body axes.
    tolerance_um
        How near to the target is near enough, along each axis.
    max_moves
        Moves of the masses before giving up: 3, or 10 before a hold. Of look_and_move alone.
    max_time_s
        Bench time before giving up: 120, or 600 before a hold or with another law.
    hold_min
        Then follow the drift and hold the balance for so many minutes. After look_and_move, which
        balances to a third of the tolerance before, since its errors stay; after momentum_buildup,
        whose masses follow the tilt too, by the sag that it found.
    bench
        Balance the real bench. The procedure is practised in simulation, then masses go home, then
        the platform is let go. Ctrl-C halts the masses and saves, a second one leaves.
    record
        With --bench: MCAP file to write as rows arrive, with every command and interlock.
    foxglove
        With --bench: also serve it live to Foxglove, Lichtblick or PlotJuggler, on this computer.
    yes
        With --bench: do not ask whether somebody holds the platform.
    json
        Print one JSON document instead.
    out
        Folder for figures, report.html and balance.json.
    """
    from equipoise.app.options import one_of, seed_of
    from equipoise.app.wiring import testbed_of
    from equipoise.io.whole_file import check_writable
    from equipoise.io.whole_folder import check_folder

    where = _where(target_um, tolerance_um)
    until = _until(max_moves, max_time_s, hold_min)
    _check_of_a_bench(bench, {"--record": record is not None, "--foxglove": foxglove, "--yes": yes})
    if is_by_hand(by_hand, reading):
        others = _of_moving_masses(law, plan, until) + ["--bench"] * bench
        check_by_hand(by_hand, reading, others)
        from equipoise.app.balancing import Goal

        goal, seed = Goal(*where), seed_of(seed)
        return balance_by_hand(Asked(testbed, goal, seed, by_hand, reading, json, out))
    bed, seed = testbed_of(testbed), seed_of(seed)
    planned = None if plan is None else _planned(plan, bed)
    if out is not None:
        check_folder(out)
    if record is not None:
        check_writable(record)
    with busy("preparing the bench", announce=False):
        from equipoise.app.balance_views import show_step
        from equipoise.app.balancing import Goal, Limits, run
        from equipoise.procedure.laws import CARDS

        limits = Limits(*until, one_of("--law", law, list(CARDS)), planned)
        goal = Goal(*where)
    if bench:
        _prepare(bed, goal, limits, yes)
    with _real(bed, record, foxglove) if bench else _simulated(bed, planned, seed) as platform:
        done = run(platform, goal, limits, None if json else show_step)
    _tell(done, seed, json, out)
    return 0 if done.verdict.passed else 1


def _where(target_um: Triple, tolerance_um: Triple) -> "tuple[Vector3, Vector3]":
    """Return target and tolerance, m, checked."""
    from equipoise.app.options import tolerance, vector
    from equipoise.app.units import UM

    target = vector("--target-um", target_um, 1 / UM)
    return target, tolerance("--tolerance-um", tolerance_um, 1 / UM)


def _check_of_a_bench(bench: bool, given: Mapping[str, bool]) -> None:
    """Refuse what only a real bench takes."""
    for option in (option for option, is_given in given.items() if is_given and not bench):
        raise InputError(option, "no --bench", "a real bench")


def _until(max_moves: int | None, max_time_s: float | None, hold_min: float) -> Until:
    """Return moves and time (s) before giving up, and how long to hold (s), checked."""
    from equipoise.app.options import not_negative, positive

    moves = None if max_moves is None else int(not_negative("--max-moves", max_moves))
    longest = None if max_time_s is None else positive("--max-time-s", max_time_s)
    return moves, longest, not_negative("--hold-min", hold_min) * 60


def _of_moving_masses(law: str, plan: Path | None, until: Until) -> list[str]:
    """Return the options given that are not for a balancing by hand."""
    moves, longest, hold = until
    others = {"--law": law != "look_and_move", "--max-moves": moves is not None,
              "--max-time-s": longest is not None, "--hold-min": hold > 0,
              "--plan": plan is not None}  # fmt: skip
    return [name for name, given in others.items() if given]


def _planned(plan: Path, bed: "Testbed") -> "Manoeuvre":
    """Return the manoeuvre of a plan file."""
    from equipoise.io.plan_file import read_plan

    return read_plan(plan, bed).manoeuvre


@contextmanager
def _simulated(bed: "Testbed", planned: "Manoeuvre | None", seed: int) -> "Generator[Bench]":
    """Return the simulated platform, let go as planned if there is a plan."""
    with busy("preparing the bench", announce=False):
        from equipoise.simulation.bench import SimulatedBench
        from equipoise.simulation.carried_out import bench_for

        bench = SimulatedBench(bed, seed) if planned is None else bench_for(bed, planned, seed)
    yield bench


def _prepare(bed: "Testbed", goal: "Goal", limits: "Limits", yes: bool) -> None:
    """Practise in simulation, say what comes of it, and ask whether the platform is held."""
    from equipoise.app.asking import agreed
    from equipoise.app.practice import practised

    with busy("practising on a simulated platform", announce=True):
        verdict = practised(bed, goal, limits)
    if verdict is not None and not verdict.passed:
        stderr().print(f"In practice, simulated: {verdict.sentence}", markup=False)
    question = "The masses will go home. Is the platform held level, and their way free?"
    if not yes and not agreed(question):
        raise InputError("the platform", "not ready", "somebody who holds it; then yes, or --yes")


@contextmanager
def _real(bed: "Testbed", record: Path | None, foxglove: bool) -> "Generator[Bench]":
    """Return the real platform, masses at home, let go, and every sensor giving rows."""
    from equipoise.app.kept_bench import Wanted, real_bench

    def let_go() -> None:
        stderr().print("Masses are at home: let the platform go.", style="bold")

    with ExitStack() as held:
        with busy("the masses go home", announce=True):
            bench = held.enter_context(real_bench(Wanted(bed, record, foxglove), let_go))
        yield bench


def _tell(done: "Balancing", seed: int, json: bool, out: Path | None) -> None:
    """Print the result, and write it down if that is asked for."""
    from equipoise.app.archive import write_account
    from equipoise.app.balance_views import account_of, document_of, show_result
    from equipoise.app.handing_over import hand_over

    document = document_of(done, seed)

    def written(folder: Path) -> list[Path]:
        return write_account(account_of(done, seed), document, "balance", folder)

    hand_over(document, lambda: show_result(done), written, json, out)
