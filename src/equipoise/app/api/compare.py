"""Compare: methods on the same recordings, laws on the same platforms."""

import warnings
from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path

from equipoise.app.arguments import checks
from equipoise.app.arguments.inputs import TILT, AnyTestbed, budget_from, options_from, testbed_from
from equipoise.app.arguments.many_runs import engine_from
from equipoise.app.arguments.options import BUDGET_S, Spreading
from equipoise.app.engine.choice import LOCAL
from equipoise.app.engine.running import Running
from equipoise.app.runs.comparison import Compared, Contest, LawGoal, names_of, run_all
from equipoise.study.method_record import Scene


def compare(
    testbed: AnyTestbed,
    *,
    methods: bool = False,
    laws: bool = False,
    only: Sequence[str] = (),
    runs: int = 20,
    seed: int = 1,
    duration: float = 120.0,
    moves: Sequence[tuple[float, Mapping[str, float]]] = (),
    terms: Sequence[str] = (),
    hold: Sequence[str] = (),
    use_prior: bool = False,
    budget_s: float = BUDGET_S,
    target: checks.Triple = (0.0, 0.0, 0.0),
    tolerance: checks.Triple = (2e-6, 2e-6, 3e-6),
    tilt: float = TILT,
    require_torque: float = 1e-5,
    max_time: float = 600.0,
    workers: int = 1,
    on: str = LOCAL,
    resume: str | Path | None = None,
) -> Compared:
    """Run methods on the same recordings, or laws on the same platforms; the truth judges.

    Platforms are simulated. The result has ``methods`` and ``laws``, None where not requested.

    Parameters
    ----------
    testbed
        Testbed, its file, or a preset's name. Its [truth] says what the platforms are like.
    methods
        Compare methods.
    laws
        Compare laws.
    only
        Methods and laws to compare. Of a kind of which none is named: all that can be.
    runs
        Platforms, each with one recording for all methods and one balancing by each law.
    seed
        Seed of the first platform; the others follow.
    duration
        Methods: length of each recording, s.
    moves
        Methods: moves of masses, each a time (s) and displacements from home (m) by mass.
    terms
        Methods: torques to estimate too.
    hold
        Methods: parameters to keep at the testbed's value.
    use_prior
        Methods: use the testbed's inertia and centre of mass with their sd.
    budget_s
        Processor time that a search may take, s; it ends then with the best that it has found.
    target
        Laws: where the centre of mass is wanted, from the centre of rotation, body axes, m.
    tolerance
        Laws: how near to the target is near enough, along each axis, m.
    tilt
        Laws: torque counts over directions within this angle of level, rad.
    require_torque
        Laws: torque that is wanted at most, rms over that range, N m.
    max_time
        Laws: bench time that each run may take, s.
    workers
        Processes to spread the runs over. More than one needs a script whose start is guarded by
        ``if __name__ == "__main__":``.
    on
        Where to run: local, dask-local, or dask://HOST:PORT of a scheduler that runs.
    resume
        Folder that keeps each result as it comes; of those that it has none is computed again.
        Needs the extra ``parquet``. A file of it that cannot be read is warned of.

    Raises
    ------
    InputError
        For nothing to compare, unknown names, laws that the testbed lacks a device for; a scheduler
        that does not answer; a folder with the results of another comparison.
    """
    bed, first = testbed_from(testbed), checks.seed_of(seed)
    seeds = range(first, first + int(checks.positive("runs", runs)))
    requested = replace(options_from(terms, hold, use_prior), budget=budget_from(budget_s))
    scene = Scene(bed, checks.duration_of("duration", duration, bed), tuple(moves), requested)
    goal = LawGoal(
        checks.vector("target", target, 1.0),
        checks.tolerance("tolerance", tolerance, 1.0),
        checks.not_negative("tilt", tilt),
        checks.positive("require_torque", require_torque),
        checks.positive("max_time", max_time),
    )
    engine = engine_from(Spreading(workers, on))
    running = Running(engine, None if resume is None else Path(resume), warnings.warn)
    return run_all(Contest(names_of(bed, only, methods, laws), scene, seeds, goal), running)
