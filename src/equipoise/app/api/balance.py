"""Balance: estimate, move masses, verify; on a simulated platform or a bench of one's own."""

from collections.abc import Callable
from dataclasses import replace

from equipoise.app.arguments import checks
from equipoise.app.arguments.inputs import AnyPlan, AnyTestbed, budget_from, plan_from, testbed_from
from equipoise.app.arguments.options import BUDGET_S
from equipoise.app.runs.balancing import Balancing, Goal, Limits, run
from equipoise.model.bench import Bench
from equipoise.model.step import Step
from equipoise.procedure.balancing.catalogue import CARDS, OWN
from equipoise.simulation.carried_out import bench_for


def balance(
    platform: Bench | AnyTestbed,
    *,
    law: str = OWN.name,
    seed: int = 1,
    plan: AnyPlan | None = None,
    target: checks.Triple = (0.0, 0.0, -100e-6),
    tolerance: checks.Triple = (2e-6, 2e-6, 3e-6),
    max_moves: int | None = None,
    max_time: float | None = None,
    hold: float = 0.0,
    budget_s: float = BUDGET_S,
    on_step: Callable[[Step], None] | None = None,
) -> Balancing:
    """Balance a platform, and test the result on what comes after.

    A bench is balanced as it is; of a testbed, a platform is simulated. The result has ``verdict``,
    ``estimate``, ``steps``, ``recording``, and ``truths`` when it was simulated. What stops a real
    bench is the last step.

    Parameters
    ----------
    platform
        Bench (``SimulatedBench``, ``open_bench``), or testbed, its file, or a preset's name.
    law
        How to balance, one of ``laws()``.
    seed
        Seed of a simulated platform: the same seed gives the same run.
    plan
        Plan to begin with, or its file. Of the law measure_and_move alone, without a hold.
    target
        Where the centre of mass is wanted, from the centre of rotation, body axes, m.
    tolerance
        How near to the target is near enough, along each axis, m.
    max_moves
        Moves of the masses before giving up: 3, or 10 before a hold. Of measure_and_move alone.
    max_time
        Bench time before giving up, s: 120, or 600 before a hold or with another law.
    hold
        Then follow the drift, declared or not, and hold the balance for this time, s.
    budget_s
        Processor time that a search may take, s; it ends then with the best that it has found.
    on_step
        Called with each step as it is done.

    Raises
    ------
    InputError
        For files that cannot be read, unknown names, and a testbed that lacks what the law needs.
    """
    limits = Limits(
        None if max_moves is None else int(checks.not_negative("max_moves", max_moves)),
        checks.positive("max_time", max_time),
        checks.not_negative("hold", hold),
        checks.one_of("law", law, list(CARDS)),
        budget=budget_from(budget_s),
    )
    goal = Goal(checks.vector("target", target, 1.0), checks.tolerance("tolerance", tolerance, 1.0))
    own = isinstance(platform, Bench)
    bed = platform.testbed if own else testbed_from(platform)
    if plan is not None:
        limits = replace(limits, plan=plan_from(plan, bed).manoeuvre)
    bench = platform if own else bench_for(bed, limits.plan, checks.seed_of(seed))
    return run(bench, goal, limits, on_step)
