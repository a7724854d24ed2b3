"""One balancing run of one law on a simulated platform, judged by the truth.

    offset     |r - target| of the centre of mass as the masses stand, and its part along up
    torque     root mean square of m g |(r + C n) x n| over directions within a tilt of level, n
    followed   the same with masses that follow the tilt: sent, at each direction, to where
               ``control.follow`` wants them, by the real ones' steps and errors
    travel     sum of what the masses report to have gone

The law, and the verdict it ends with, know none of this.
"""

import math
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass

import numpy as np

from equipoise.control.laws.follow import shift_at
from equipoise.dynamics.sag_trim import downs, residual_torque
from equipoise.maths.linalg import skew
from equipoise.model.arrays import Floats, Vector3
from equipoise.model.bench import Bench
from equipoise.model.following import Following
from equipoise.model.reasons.step_reasons import StepReason
from equipoise.model.recording import Recording, Samples
from equipoise.model.step import Step
from equipoise.model.testbed import Testbed
from equipoise.model.verdict import Verdict
from equipoise.procedure.balancing.allocation import opened_hands, send, travel_time
from equipoise.procedure.balancing.balance import BalanceOptions
from equipoise.procedure.balancing.catalogue import balanced_by
from equipoise.procedure.steps.sampler import last_row
from equipoise.simulation.bench import SimulatedBench

STOPPED = 0.2  # s, chosen: masses that should have arrived, have


@dataclass(frozen=True, slots=True, eq=False)
class LawRun:
    """What a run came to."""

    law: str
    seed: int
    offset: Vector3  # m, from the target
    torque: float  # N m, rms over the tilt range
    followed: float | None  # N m, with masses that follow; None: the law does not command them
    torque_before: float  # N m, standing, before the run
    time: float  # s on the bench's clock
    travel: float  # m
    late: bool  # its time was used up
    verdict: Verdict

    @property
    def left(self) -> float:
        """The torque that the procedure leaves, N m: with masses that follow, if they can."""
        return self.torque if self.followed is None else self.followed


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
    """A simulated bench that counts how far its masses go (m) and how often they are sent."""

    def __init__(self, testbed: Testbed, seed: int) -> None:
        super().__init__(testbed, seed)
        self.travel = 0.0
        self.moves, self.sent = 0, 0.0  # s, when the last one began

    def move(self, targets: Mapping[str, float], speed: float = math.inf) -> None:
        """Move, and count."""
        super().move(targets, speed)
        self.moves, self.sent = self.moves + 1, self.time

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
    weight = testbed.weight
    return weight * residual_torque(bench.com, bench.sag, testbed.up, tilt)


def followed_torque(bench: SimulatedBench, following: Following, tilt: float) -> float:
    """Return the torque (N m) really left, rms within a tilt (rad), by masses that follow."""
    testbed, square = bench.testbed, 0.0
    here = last_row(bench.read(STOPPED).masses, np.zeros(len(testbed.masses)))
    hands = opened_hands(testbed, here)
    directions, weights = downs(testbed.up, tilt)
    for down, weight in zip(directions, weights, strict=True):
        hands = send(bench, shift_at(following, down, bench.time), here, hands)
        wait = travel_time(testbed, hands.goal, here) + STOPPED
        here = last_row(bench.read(wait).masses, here)
        lever: Floats = skew(bench.com + bench.sag @ down) @ down
        square += float(weight[0]) * float(lever @ lever)
    return testbed.weight * square**0.5


def ran_out(step: Step) -> bool:
    """Say whether a law was at work until its time was used up."""
    codes = [reason.code for reason in step.reasons]
    return StepReason.LAW_RAN in codes and StepReason.TIME_USED_UP in codes


def law_run(task: Task) -> LawRun:
    """Return what one run comes to."""
    return judged_run(task, lambda bench: balanced_by(task.law, bench, task.options, task.max_time))


def judged_run(task: Task, balancing: Callable[[Bench], Iterator[Step]]) -> LawRun:
    """Return what a way to balance comes to; ``task.law`` is its name."""
    bench = CountedBench(task.testbed, task.seed)
    before = rms_torque(bench, task.tilt)
    verdict, following, late = Verdict(()), None, False
    for step in balancing(bench):
        late = late or ran_out(step)
        verdict, following = step.verdict or verdict, step.following or following
    return LawRun(
        law=task.law,
        seed=task.seed,
        offset=bench.truth().com - task.options.target,
        torque=rms_torque(bench, task.tilt),
        torque_before=before,
        time=bench.time,
        travel=bench.travel,
        late=late or bench.time >= task.max_time,
        verdict=verdict,
        followed=None if following is None else followed_torque(bench, following, task.tilt),
    )
