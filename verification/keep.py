"""Keep a platform balanced while an ADCS experiment points it: MuJoCo bodies as the truth.

The same platform is balanced once and then left alone: what its experiment points worse by is what
keeping is worth.
"""

from collections.abc import Sequence
from dataclasses import replace
from functools import partial
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from equipoise.io.testbed.presets import read_preset
from equipoise.model.devices import Lamp, ReactionWheel
from equipoise.model.testbed import Testbed
from equipoise.model.verdict import Verdict
from equipoise.procedure.balancing.balance import balance
from equipoise.procedure.balancing.hold import HoldOptions, begun, hold
from equipoise.procedure.balancing.motion_budget import MotionBudget
from equipoise.procedure.steps.joint_fit import Knowledge
from tests.oracle.mujoco_bench import Platform
from tests.oracle.mujoco_experiment import ExperimentBench, Surroundings, torque_by_moves
from tests.oracle.mujoco_live import platform_of
from verification.result import Result, Row, Spread, at_least, at_most, in_turn, triple

Array = NDArray[np.float64]
LASTS = 1800.0  # s
LIMIT = 3e-6  # m, per axis
BUDGET = MotionBudget(torque=2e-6)  # N m
TARGET = np.array([0.0, 0.0, -15e-6])  # m
LAMP = Lamp(3.0, 120.0)
THERMAL = 1e-6  # m/K


class Run(NamedTuple):
    """One platform, kept or left alone."""

    seed: int
    balanced: bool
    outcome: str
    worst: Array  # m, greatest true distance from the target along each axis
    added: float  # N m, by moves, the greatest rms of a second
    pointing: float  # rad, rms
    moves: int
    sentence: str

    @property
    def well(self) -> bool:
        """Say whether it was within the limit all the time."""
        return bool(np.all(self.worst <= LIMIT))

    @property
    def false(self) -> bool:
        """Say whether the verdict passed what was not within the limit, or failed what was."""
        return (self.outcome == "passed" and not self.well) or (
            self.outcome == "failed" and self.well
        )


def bed() -> Testbed:
    """Return the 4 kg preset with wheels of a small satellite and a lamp."""
    preset = read_preset("nanosat")
    wheels = tuple(
        ReactionWheel(name, axis, 1e-3, 800.0, 0.01)
        for name, axis in zip(("wx", "wy", "wz"), np.eye(3), strict=True)
    )
    masses = tuple(replace(mass, accuracy=1e-6) for mass in preset.masses)
    return replace(preset, wheels=wheels, masses=masses, lamp=LAMP, hardware=None,
                   inertia_sd=0.03)  # fmt: skip


def drawn(seed: int) -> tuple[Testbed, Platform, Surroundings]:
    """Return a platform with a drift of 1 to 4 um/min and a lamp that goes on twice."""
    testbed, rng = bed(), np.random.default_rng([seed, 41])
    way, warm = rng.normal(size=(2, 3))
    drift = rng.uniform(1e-6, 4e-6) / 60 * way / np.linalg.norm(way)
    thermal = THERMAL * warm / np.linalg.norm(warm)
    on = rng.uniform(200.0, 600.0), rng.uniform(1300.0, 1700.0)
    lamp = tuple((a, a + 400.0) for a in on)
    off = 1 + 0.03 * rng.normal(size=(3, 3))
    J = testbed.body.inertia_P * (off + off.T) / 2
    com = rng.uniform([-30e-6, -30e-6, -120e-6], [30e-6, 30e-6, -60e-6])
    tilt, rate = 0.05 * rng.normal(size=3), np.radians(rng.uniform(-0.3, 0.3, 3))
    platform = platform_of(testbed, com, J, tilt, rate)
    return testbed, platform, Surroundings(drift, thermal, lamp)


def bench_of(seed: int) -> ExperimentBench:
    """Return a bench of such a platform."""
    return ExperimentBench(*drawn(seed), seed)


def kept(lasts: float, task: tuple[int, bool]) -> Run:
    """Balance a platform, let its experiment begin, and keep it balanced or leave it alone."""
    seed, alone = task
    bench = bench_of(seed)
    options = HoldOptions(TARGET, np.full(3, LIMIT), duration=lasts, every=1.0, motion=BUDGET)
    first, knowledge = balanced(bench, options)
    bench.begin()
    if alone:
        bench.read(lasts)
        steps, last = [], Verdict(())
    else:
        steps = list(hold(bench, begun(knowledge, bench.testbed), options))
        assert steps[-1].verdict is not None
        last = steps[-1].verdict
    away = np.abs(np.array(bench.coms) - TARGET)
    return Run(
        seed, first, str(last.outcome), away.max(axis=0), float(torque_by_moves(bench).max()),
        float(np.sqrt(np.mean(np.square(bench.error)))),
        sum(step.kind == "move" for step in steps), last.sentence,
    )  # fmt: skip


def balanced(bench: ExperimentBench, options: HoldOptions) -> tuple[bool, Knowledge]:
    """Balance a platform; return whether that passed, and what is known then."""
    steps, passed = balance(bench, options.balancing), False
    while True:
        try:
            step = next(steps)
        except StopIteration as end:
            return passed, end.value
        passed = step.verdict is not None and step.verdict.passed


def measure(seeds: Sequence[int], spread: Spread = in_turn, lasts: float = LASTS) -> Result:
    """Keep one platform for each seed, and leave its twin alone."""
    tasks = [(seed, alone) for seed in seeds for alone in (False, True)]
    runs: list[Run] = spread(partial(kept, lasts), tasks)
    held, left = runs[::2], runs[1::2]
    n = len(held)
    well, false = sum(run.well for run in held), sum(run.false for run in held)
    worst = np.array([run.worst for run in held])
    ratio = np.array([b.pointing / a.pointing for a, b in zip(held, left, strict=True)])
    rms = [float(np.sqrt(np.mean([run.pointing**2 for run in each]))) for each in (held, left)]
    outcomes = {o: sum(run.outcome == o for run in held) for o in ("passed", "undecided", "failed")}
    rows = (
        at_least(f"within {1e6 * LIMIT:g} um on every axis all the time, share", well / n, 0.95),
        at_most("verdicts that are false, share", false / n, 0.025),
        at_most("torque added by moves, rms in the worst second, uN m",
                1e6 * max(run.added for run in held), 1e6 * BUDGET.torque),
        at_least("pointing error left alone over kept, rms of all", rms[1] / rms[0], 3.0),
        at_least("the same, least of all platforms", float(ratio.min()), 3.0),
        Row("greatest true distance, um: median of platforms; worst",
            "; ".join(triple(1e6 * each) for each in (np.median(worst, axis=0), worst.max(axis=0))),
            "", True),
        Row("verdicts", ", ".join(f"{count} {name}" for name, count in outcomes.items()), "", True),
    )  # fmt: skip
    notes = [f"Seed {run.seed}: worst {triple(1e6 * run.worst)} um. {run.sentence}"
             for run in held if not run.well or run.false]  # fmt: skip
    claim = (
        f"`keep` on {n} platforms of MuJoCo bodies, preset nanosat with three wheels, inertia 3 % "
        "off: a quaternion PD controller without knowledge of gravity torque points it elsewhere "
        f"each minute (8 deg of tilt) for {lasts / 60:.0f} min, while the centre of mass drifts by "
        "1 to 4 um/min and a lamp that goes on twice moves it by 3 um. Each platform is balanced "
        "first; its twin is then left alone."
    )
    return Result("keep", claim, rows, tuple(notes))
