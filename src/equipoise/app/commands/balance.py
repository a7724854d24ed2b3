"""`equipoise balance`: estimate, move, estimate again, until the verdict passes."""

from contextlib import nullcontext
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

from equipoise.app.arguments.options import (
    ALONE,
    USUAL,
    WHOLE,
    Json,
    Reading,
    Searching,
    Spreading,
    Triple,
    Whole,
)
from equipoise.app.commands.by_hand import (
    MOVED,
    Manual,
    Request,
    balance_by_hand,
    check_by_hand,
    is_by_hand,
)
from equipoise.app.commands.by_hand_then_masses import Masses, balance_then_masses
from equipoise.app.commands.on_bench import SIMULATED, OnBench, check_on_bench, let_go, prepare
from equipoise.app.console.terminal import announced, busy, counted_pieces
from equipoise.model.errors import InputError

if TYPE_CHECKING:
    from equipoise.app.engine.pool import Engine
    from equipoise.app.runs.balancing import Balancing, Goal, Limits
    from equipoise.model.arrays import Vector3
    from equipoise.model.testbed import Testbed

NOT_BEGUN_BY_HAND = ("--plan", "--series")
Until = tuple[int | None, float | None, float]  # moves, s, s of holding


def balance(
    testbed: str,
    /,
    *,
    law: str = "measure_and_move",
    seed: Whole = 1,
    series: Whole | None = None,
    spreading: Spreading = ALONE,
    plan: Path | None = None,
    target_um: Triple = (0.0, 0.0, -100.0),
    tolerance_um: Triple = (2.0, 2.0, 3.0),
    max_moves: Whole | None = None,
    max_time_s: float | None = None,
    hold_min: float = 0.0,
    by_hand: Manual = MOVED,
    reading: Reading = WHOLE,
    searching: Searching = USUAL,
    on_bench: OnBench = SIMULATED,
    json: Json = False,
    out: Path | None = None,
) -> int:
    """Balance a platform: measure, move masses, and verify the result on fresh data.

    The platform is simulated; with --bench it is the real one of the testbed's [hardware]. With
    --manual a person places weights instead, on a real platform if --session names a file; with
    --then-masses only until the masses can correct the rest. Exit code 1: the verdict is that the
    platform is not balanced; 130, 143, 129: stopped by Ctrl-C, SIGTERM, SIGHUP.

    Parameters
    ----------
    testbed
        Testbed file, or a preset's name. Its [truth] defines the simulated platform.
    law
        Control law; `equipoise laws` lists them.
    seed
        Random seed; the same seed gives the same run.
    series
        Balance the simulated platform of the seed this many times, with consecutive seeds. The
        folder gets each recording as run_01.csv and so on.
    plan
        Plan file: start with its manoeuvre, then balance on everything recorded. For
        measure_and_move without a hold.
    target_um
        Target of the centre of mass, from the centre of rotation, body axes.
    tolerance_um
        Tolerance around the target along each axis.
    max_moves
        Maximum number of moves: 3, or 10 before a hold. For measure_and_move.
    max_time_s
        Maximum bench time: 120, or 600 before a hold or with another law.
    hold_min
        Then track the drift, declared or not, and hold the balance for this many minutes. After
        measure_and_move, which then measures to two fifths of the tolerance because its errors
        remain; or after momentum_buildup, whose masses also follow the tilt by the sag that it
        estimated.
    out
        Folder for report, figures and balance.json. If omitted: a folder of its own in
        equipoise-runs.
    """
    from equipoise.app.arguments.checks import check_outputs, one_of, seed_of
    from equipoise.app.arguments.inputs import plan_from, testbed_from

    where = _where(target_um, tolerance_um)
    until = _until(max_moves, max_time_s, hold_min)
    check_on_bench(on_bench)
    if is_by_hand(by_hand, reading):
        from equipoise.app.runs.balancing import Goal

        others = _of_moving_masses(law, plan, until, series)
        requested = Request(testbed, Goal(*where), seed_of(seed), by_hand, reading, json, out)
        return _by_hand(requested, others, Masses(law, until, searching, on_bench))
    runs, engine = _runs(series, on_bench, spreading)
    bed, seed = announced(testbed_from(testbed)), seed_of(seed)
    planned = None if plan is None else plan_from(plan, bed).manoeuvre
    check_outputs(out)
    with busy("preparing the bench", announce=False):
        from equipoise.app.logbook.output import hand_over_run
        from equipoise.app.runs.balancing import Goal, Limits
        from equipoise.app.runs.terminal_waiting import budget_at_terminal
        from equipoise.app.views.balancing.balance_views import output_of
        from equipoise.procedure.balancing.catalogue import CARDS

        budget = budget_at_terminal(searching)
        limits = Limits(*until, one_of("--law", law, list(CARDS)), planned, budget)
    if runs is not None:
        return _series(bed, Goal(*where), limits, (runs, seed), engine=engine, json=json, out=out)
    done = _run(bed, Goal(*where), limits, seed, on_bench, show=not json)
    hand_over_run(output_of(done), json, out, bed.name, below=True)
    return done.stopped_with or (0 if done.verdict.passed else 1)


def _by_hand(requested: Request, others: list[str], masses: Masses) -> int:
    """Balance by hand alone, or by hand first; ``others`` are options given of moving masses."""
    both = requested.by.then_masses
    left = [name for name in others if name in NOT_BEGUN_BY_HAND or not both]
    alone = ["--bench"] * (masses.on_bench.bench and not both)
    check_by_hand(requested.by, requested.reading, left + alone)
    return balance_then_masses(requested, masses) if both else balance_by_hand(requested)


def _runs(
    series: int | None, on_bench: OnBench, spreading: Spreading
) -> "tuple[int | None, Engine]":
    """Return how many runs a series has, and what they are spread over, checked."""
    from equipoise.app.arguments.checks import positive
    from equipoise.app.arguments.many_runs import check_one_piece, engine_from

    if series is not None and on_bench.bench:
        raise InputError("--series", "a real bench", "a simulated platform")
    engine = engine_from(spreading)
    if series is None:
        check_one_piece(spreading, "--series, whose runs are spread")
        return None, engine
    return int(positive("--series", series)), engine


def _series(
    bed: "Testbed",
    goal: "Goal",
    limits: "Limits",
    seeds: tuple[int, int],
    *,
    engine: "Engine",
    json: bool,
    out: Path | None,
) -> int:
    """Balance one simulated platform several times."""
    from equipoise.app.engine.spread import spread_over
    from equipoise.app.logbook.output import hand_over_run
    from equipoise.app.runs.balance_series import run_series
    from equipoise.app.views.balancing.balance_series_views import output_of

    with engine() as pool:
        spread = spread_over(pool, partial(counted_pieces, f"balancing {seeds[0]} runs"))
        done = run_series(bed, goal, limits, seeds, spread)
    hand_over_run(output_of(done), json, out, bed.name, below=True)
    return 0 if done.verdict.passed else 1


def _run(
    bed: "Testbed", goal: "Goal", limits: "Limits", seed: int, on_bench: OnBench, *, show: bool
) -> "Balancing":
    """Balance the simulated platform, or the real one, and show each step."""
    with busy("preparing the bench", announce=False):
        from equipoise.app.runs.balancing import run
        from equipoise.app.runs.terminal_balancing import at_terminal
        from equipoise.app.runs.terminal_waiting import show_step
        from equipoise.simulation.carried_out import bench_for

        simulated = None if on_bench.bench else bench_for(bed, limits.plan, seed)
    if simulated is None:
        prepare(bed, goal, limits, on_bench)
    with let_go(bed, on_bench) if simulated is None else nullcontext(simulated) as bench:
        return run(bench, goal, limits, show_step if show else None, at_terminal(bed))


def _where(target_um: Triple, tolerance_um: Triple) -> "tuple[Vector3, Vector3]":
    """Return target and tolerance, m, checked."""
    from equipoise.app.arguments.checks import tolerance, vector
    from equipoise.model.units import UM

    target = vector("--target-um", target_um, UM)
    return target, tolerance("--tolerance-um", tolerance_um, UM)


def _until(max_moves: int | None, max_time_s: float | None, hold_min: float) -> Until:
    """Return moves and time (s) before giving up, and how long to hold (s), checked."""
    from equipoise.app.arguments.checks import not_negative, positive
    from equipoise.model.units import MINUTE

    not_negative("--max-moves", max_moves)
    return (
        max_moves,
        positive("--max-time-s", max_time_s),
        not_negative("--hold-min", hold_min) * MINUTE,
    )


def _of_moving_masses(law: str, plan: Path | None, until: Until, series: int | None) -> list[str]:
    """Return the options given that are not for a balancing by hand."""
    moves, longest, hold = until
    others = {"--law": law != "measure_and_move", "--max-moves": moves is not None,
              "--max-time-s": longest is not None, "--hold-min": hold > 0,
              "--plan": plan is not None, "--series": series is not None}  # fmt: skip
    return [name for name, given in others.items() if given]
