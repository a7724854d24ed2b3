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
from equipoise.model.bench import Bench
from equipoise.model.devices import Lamp, ReactionWheel
from equipoise.model.testbed import Testbed
from equipoise.procedure.balancing.balance import balance
from equipoise.procedure.balancing.hold import HoldOptions, begun, hold
from equipoise.procedure.balancing.motion_budget import MotionBudget
from equipoise.procedure.balancing.permission import Permission, Schedule
from equipoise.simulation.draw_truth import draw_truth
from tests.oracle.mujoco_experiment import ExperimentBench, Surroundings, torque_by_moves
from tests.oracle.mujoco_live import platform_of

Array = NDArray[np.float64]
LASTS = 1800.0  # s
LIMIT = 3e-6  # m, per axis
BUDGET = MotionBudget(torque=2e-6)  # N m
TARGET = np.array([0.0, 0.0, -15e-6])  # m
LAMP = Lamp(3.0, 120.0)
THERMAL = 1e-6  # m/K
LEFT_ALONE = Schedule(lambda: Permission.HOLD)


class Run(NamedTuple):
    """One platform, kept or left alone."""

    seed: int
    balanced: bool
    passed: bool
    outcome: str
    worst: Array  # m, greatest true distance from the target along each axis
    added: float  # N m, by moves, the greatest rms of a second
    pointing: float  # rad, rms
    moves: int
    sentence: str


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


def bench_of(seed: int) -> ExperimentBench:
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
    return ExperimentBench(testbed, platform, Surroundings(drift, thermal, lamp), seed)


def kept(lasts: float, alone: bool, seed: int) -> Run:
    """Balance a platform, let its experiment begin, and keep it balanced or leave it alone."""
    bench = bench_of(seed)
    options = HoldOptions(TARGET, np.full(3, LIMIT), duration=lasts, every=1.0, motion=BUDGET,
                          schedule=LEFT_ALONE if alone else Schedule())  # fmt: skip
    *steps, knowledge = _run(balance(bench, options.balancing))
    first = steps[-1].verdict
    bench.begin()
    steps = list(hold(bench, begun(knowledge, bench.testbed), options))
    last = steps[-1].verdict
    away = np.abs(np.array(bench.coms) - TARGET)
    return Run(
        seed, bool(first and first.passed), last.passed, str(last.outcome), away.max(axis=0),
        float(torque_by_moves(bench).max()), float(np.sqrt(np.mean(np.square(bench.error)))),
        sum(step.kind == "move" for step in steps), last.sentence,
    )  # fmt: skip


def _run(steps):
    """Yield the steps of a generator, and what it returns."""
    knowledge = yield from steps
    yield knowledge
