"""One platform balanced and then held while its centre of mass drifts, judged by the truth.

The true centre of mass is noted every second, whatever the procedure reads. What a hold comes to is
its greatest distance from the target, from the end of the balancing on.
"""

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import reduce

import numpy as np

from equipoise.actuators.sliding_masses import mass_maps
from equipoise.model.arrays import Vector3
from equipoise.model.recording import Recording, join
from equipoise.model.step import Step
from equipoise.model.testbed import Testbed
from equipoise.model.verdict import VerdictOutcome
from equipoise.procedure.balancing.hold import HoldOptions, balance_and_hold
from equipoise.simulation.bench import SimulatedBench

EVERY = 1.0  # s
ENOUGH = 1e-6  # s: a hold that ends so much early has lasted to its end


class TrueCourseBench(SimulatedBench):
    """A simulated bench that is read in pieces of a second, with the truth noted after each."""

    def __init__(self, testbed: Testbed, seed: int) -> None:
        super().__init__(testbed, seed)
        self.t: list[float] = []  # s
        self.coms: list[Vector3] = []  # m

    def read(self, duration: float) -> Recording:
        """Wait and return what was recorded, as the bench would."""
        parts = max(1, int(duration / EVERY))
        found: list[Recording] = []
        for _ in range(parts):
            found.append(super().read(duration / parts))
            self.t.append(self.time)
            self.coms.append(self.truth().com)
        return reduce(join, found)


@dataclass(frozen=True, slots=True, eq=False)
class HeldRun:
    """What a balancing and a hold came to."""

    seed: int
    held: bool  # to its end
    worst: Vector3  # m, greatest true distance from the target while holding
    at: float  # s since the hold began, of the worst
    start: Vector3  # m, true, from the target, as balancing left it
    began: float  # s, the hold
    moves: int  # while holding
    balanced: VerdictOutcome  # what the balancing before it came to
    last: Step
    tolerance: Vector3  # m

    @property
    def outcome(self) -> VerdictOutcome:
        """The last word."""
        return VerdictOutcome.UNDECIDED if self.last.verdict is None else self.last.verdict.outcome

    @property
    def well(self) -> bool:
        """Whether it was held within the tolerance along every axis, to the end."""
        return self.held and bool(np.all(self.worst <= self.tolerance))

    @property
    def false(self) -> bool:
        """Whether balancing or hold passed a platform that was outside the tolerance."""
        outside = bool(np.any(np.abs(self.start) > self.tolerance))
        passed = VerdictOutcome.PASSED
        return (self.balanced is passed and outside) or (self.outcome is passed and not self.well)


Through = Callable[[Iterator[Step], TrueCourseBench], Iterator[Step]]


def held_run(
    testbed: Testbed, holding: HoldOptions, seed: int, through: Through = lambda steps, _: steps
) -> HeldRun:
    """Return what balancing and holding a platform comes to; ``through`` lets others look on."""
    bench = TrueCourseBench(testbed, seed)
    steps = list(through(balance_and_hold(bench, holding.balancing, holding), bench))
    first = next(k for k, step in enumerate(steps) if step.verdict is not None)
    began, verdict = steps[first].time, steps[first].verdict
    assert verdict is not None
    t, off = np.array(bench.t), np.array(bench.coms) - holding.target
    away, times = np.abs(off[t > began]), t[t > began]
    nothing = np.full(3, np.nan)
    return HeldRun(
        seed,
        held=bench.time - began >= holding.duration - ENOUGH,
        worst=away.max(axis=0) if len(away) else nothing,
        at=float(times[away.max(axis=1).argmax()]) - began if len(away) else np.nan,
        start=off[t <= began][-1],
        began=began,
        moves=sum(step.kind == "move" for step in steps[first + 1 :]),
        balanced=verdict.outcome,
        last=steps[-1],
        tolerance=holding.tolerance,
    )


def rails_suffice(
    testbed: Testbed, drift: Vector3, target: Vector3, until: float, seed: int
) -> bool:
    """Say whether the masses can keep the target up to a time (s) under a drift (m/s)."""
    maps, ends = mass_maps(testbed.masses), np.array([m.travel[1] for m in testbed.masses])
    reach = ends @ np.abs(maps.first_moment) / testbed.body.mass
    first = SimulatedBench(testbed, seed).truth().com
    return bool(np.all(np.abs(target - first - until * drift) <= reach))
