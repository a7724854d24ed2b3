"""Keep: masses keep a platform balanced while an experiment runs on it."""

from collections.abc import Callable, Sequence
from pathlib import Path

from equipoise.app.arguments import checks
from equipoise.app.arguments.inputs import AnyTestbed, testbed_from
from equipoise.app.runs.balancing import Goal
from equipoise.app.runs.keeping import Keeping, Session, interrupted, options_for, run
from equipoise.model.bench import Bench
from equipoise.model.permission import Experiment
from equipoise.model.step import Step
from equipoise.procedure.balancing.hold import HoldOptions
from equipoise.procedure.balancing.motion_budget import USUAL, MotionBudget
from equipoise.procedure.balancing.schedule import Schedule, always_free
from equipoise.simulation.bench import SimulatedBench

WEEK = 7 * 24 * 3600.0  # s


def keep(
    platform: Bench | AnyTestbed,
    duration: float,
    *,
    seed: int = 1,
    target: checks.Triple = (0.0, 0.0, -100e-6),
    tolerance: checks.Triple = (3e-6, 3e-6, 3e-6),
    torque: float = USUAL.torque,
    torque_rate: float | None = None,
    experiment: Experiment = always_free,
    quiet: Sequence[tuple[float, float]] = (),
    folder: str | Path | None = None,
    resume: str | Path | None = None,
    on_step: Callable[[Step], None] | None = None,
) -> Keeping:
    """Balance a platform, then keep it balanced while an experiment runs on it.

    Masses follow drift and heat by as much as they may; the verdict states whether the centre of
    mass was within tolerance all the time. Moves are counted, not listed.

    Parameters
    ----------
    platform
        Bench (``SimulatedBench``, ``open_bench``), or testbed, its file, or a preset's name.
    duration
        How long to keep the balance, s.
    seed
        Seed of a simulated platform.
    target
        Where the centre of mass is wanted, from the centre of rotation, body axes, m.
    tolerance
        How near to the target is near enough, along each axis, m.
    torque
        What moving masses may add, rms in any second, N m.
    torque_rate
        How fast they may change the torque of gravity, N m/s; None: as fast as ``torque`` allows.
    experiment
        Called between measurements: what masses may do now (``free``, ``hold`` or ``done``).
    quiet
        Begin and end of times in which masses stand still, s of bench time.
    folder
        Where to save each minute what a later call needs to go on.
    resume
        Folder of an interrupted call: go on with its target and the time that was left.
    on_step
        Called with each step as it is done.

    Raises
    ------
    InputError
        For files that cannot be read, and masses that do not stand where they stood.
    """
    lasts = checks.between("duration", duration, 0.0, WEEK)
    rate = checks.positive("torque_rate", torque_rate)
    budget = MotionBudget(checks.positive("torque", torque))
    budget = budget if rate is None else MotionBudget(budget.torque, rate)
    wanted = HoldOptions(duration=lasts, motion=budget, schedule=Schedule(experiment, quiet))
    goal = Goal(checks.vector("target", target, 1.0), checks.tolerance("tolerance", tolerance, 1.0))
    own = isinstance(platform, Bench)
    bed = platform.testbed if own else testbed_from(platform)
    start = None if resume is None else interrupted(Path(resume), bed)
    options, standing = options_for(goal, lasts, wanted), None
    if start is not None:
        options, standing = start.options(wanted), start.standing(bed)
    if folder is not None:
        Path(folder).mkdir(parents=True, exist_ok=True)
    bench = platform if own else SimulatedBench(bed, checks.seed_of(seed), standing)
    place = None if folder is None else Path(folder)
    return run(bench, Session(options, start, place), on_step)
