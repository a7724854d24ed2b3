"""One balancing run of one law on a simulated platform, judged by the truth.

    offset     |r - target| of the centre of mass as the masses stand, and its part along up
    torque     root mean square of m g |(r + C n) x n| over directions within a tilt of level
    travel     sum of what the masses report to have gone

The law, and the verdict it ends with, know none of this.
"""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from equipoise.dynamics.sag_trim import residual_torque
from equipoise.model.arrays import Floats, Vector3
from equipoise.model.recording import Recording, Samples
from equipoise.model.step import Step
from equipoise.model.testbed import Testbed
from equipoise.model.verdict import Verdict
from equipoise.procedure.balance import BalanceOptions
from equipoise.procedure.laws import balanced_by
from equipoise.simulation.bench import SimulatedBench


@dataclass(frozen=True, slots=True, eq=False)
class LawRun:
    """What a run came to."""

    law: str
    seed: int
    offset: Vector3  # m, from the target
    torque: float  # N m, rms over the tilt range
    torque_before: float  # N m, the same before the run
    time: float  # s on the bench's clock
    travel: float  # m
    verdict: Verdict


@dataclass(frozen=True, slots=True, eq=False)
class Task:
    """What is to be run."""

    law: str
    testbed: Testbed
    seed: int
    options: BalanceOptions
    max_time: float  # s
    tilt: float  # rad, of the range over which the torque counts


class CountedBench(SimulatedBench):
    """A simulated bench that counts how far its masses go, m."""

    def __init__(self, testbed: Testbed, seed: int) -> None:
        super().__init__(testbed, seed)
        self.travel = 0.0

    def read(self, duration: float) -> Recording:
        """Read, and count."""
        fresh = super().read(duration)
        self.travel += gone(fresh.masses)
        return fresh


def gone(masses: Samples | None) -> float:
    """Return the sum of the ways of all masses over a record, m."""
    return 0.0 if masses is None else float(np.abs(np.diff(masses.values, axis=0)).sum())


def rms_torque(bench: SimulatedBench, tilt: float) -> float:
    """Return the torque (N m) that the platform really leaves, rms within a tilt (rad)."""
    testbed = bench.testbed
    weight = testbed.body.mass * testbed.gravity
    return weight * residual_torque(bench.com, bench.sag, testbed.up, tilt)


def law_run(task: Task) -> LawRun:
    """Return what one run comes to."""
    bench = CountedBench(task.testbed, task.seed)
    before = rms_torque(bench, task.tilt)
    steps: Iterator[Step] = balanced_by(task.law, bench, task.options, task.max_time)
    verdict = Verdict(False, "no verdict", sure=False)
    for step in steps:
        verdict = step.verdict or verdict
    offset: Floats = bench.truth().com - task.options.target
    after = rms_torque(bench, task.tilt)
    return LawRun(task.law, task.seed, offset, after, before, bench.time, bench.travel, verdict)
