"""Balance, then hold for half an hour while the centre of mass drifts by 1 um a minute.

The bench is watched from outside: its true centre of mass is noted every second.
"""

from collections.abc import Iterator, Sequence
from dataclasses import replace
from functools import partial, reduce
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from equipoise.actuators.sliding_masses import com_shift, mass_maps
from equipoise.app.bench.bench_proxy import RecordedBench
from equipoise.io.testbed.presets import read_preset
from equipoise.model.recording import Recording, join
from equipoise.model.step import Step
from equipoise.model.testbed import Testbed
from equipoise.model.torque_terms import expand
from equipoise.model.verdict import VerdictOutcome
from equipoise.procedure.balancing.hold import HoldOptions, balance_and_hold
from equipoise.procedure.steps.planned_move import stops_covariance
from equipoise.simulation.bench import SimulatedBench
from verification.result import Result, Row, Spread, at_most, in_turn, triple

DRIFT = 1e-6 / 60  # m/s
HOLD = 1800.0  # s
LIMIT = 3e-6  # m, per axis
EVERY = 1.0  # s
HOLDING = HoldOptions(duration=HOLD)
TERMS = expand(("drift",))
Array = NDArray[np.float64]


class Watched(RecordedBench):
    """A bench that is read in pieces of a second, with the truth noted after each."""

    def __init__(self, bench: SimulatedBench) -> None:
        """Watch a bench."""
        super().__init__(bench)
        self._truth = bench.truth
        self.t: list[float] = []
        self.com: list[Array] = []

    def read(self, duration: float) -> Recording:
        """Wait and return what was recorded, as the bench would."""
        parts = max(1, int(duration / EVERY))
        found: list[Recording] = []
        for _ in range(parts):
            found.append(super().read(duration / parts))
            self.t.append(self.time)
            self.com.append(self._truth().com)
        return reduce(join, found)


class Run(NamedTuple):
    """One platform balanced and held."""

    seed: int
    held: bool  # to the end of the half hour
    worst: Array  # m, greatest true distance from the target while holding
    moves: int
    z: Array  # (n, 3) the tracker's errors in its own sd, at every move and the end
    error: Array  # (n, 3) m, the same
    at: float  # s since the hold began, of the worst
    start: Array  # m, true, from the target, as balancing left it
    sentence: str
    outcome: VerdictOutcome
    began: float  # s, the hold
    balanced: VerdictOutcome  # what balancing before it came to

    @property
    def well(self) -> bool:
        """Whether it was held within the limit on every axis, to the end."""
        return self.held and bool(np.all(self.worst <= LIMIT))


def drifting(seed: int) -> Testbed:
    """Return the preset with a drift in a random direction, to be looked for."""
    way = np.random.default_rng([seed, 2]).normal(size=3)
    drift = dict(zip(TERMS, DRIFT * way / np.linalg.norm(way), strict=True))
    testbed = read_preset("sputnix")
    return replace(testbed, disturbances=TERMS, truth=replace(testbed.truth, torque=drift))


def posteriors(steps: Iterator[Step], bench: Watched) -> Iterator[tuple[Step, Array, Array]]:
    """Yield each step with the tracker's error in m and in its own sd, NaN when it says nothing."""
    maps, mass = mass_maps(bench.testbed.masses), bench.testbed.body.mass
    nothing = np.full(3, np.nan)
    for step in steps:
        true = bench.com[-1] if bench.com else nothing
        if step.move is not None and step.move.reason == "drift":
            goal = np.array([step.move.targets[m.name] for m in bench.testbed.masses])
            now = step.recording.masses.values[-1]
            error = step.move.predicted_com - com_shift(maps, mass, goal - now) - true
            moving = goal != now
            added = stops_covariance(bench.testbed, moving)
            left = stops_covariance(bench.testbed, moving & (now != 0))
            known = step.move.predicted_covariance - added - left  # before the move
            yield step, error, error / np.sqrt(np.diag(known))
        elif step.verdict is not None and step.verdict.com is not None:
            yield step, step.verdict.com - true, (step.verdict.com - true) / step.verdict.sd
        else:
            yield step, nothing, nothing


def held(hold: float, seed: int) -> Run:
    """Balance and hold the platform of one seed for so long (s)."""
    return watched_hold(drifting(seed), hold, seed)


def watched_hold(testbed: Testbed, hold: float, seed: int) -> Run:
    """Balance and hold a platform for so long (s); watch its truth."""
    holding = HoldOptions(duration=hold)
    bench = Watched(SimulatedBench(testbed, seed))
    began, moves, last, balanced = np.inf, 0, None, VerdictOutcome.UNDECIDED
    errors, zs = [np.full(3, np.nan)], [np.full(3, np.nan)]
    for step, error, z in posteriors(balance_and_hold(bench, holding.balancing, holding), bench):
        if np.isfinite(began):
            moves += step.kind == "move"
            errors.append(error)
            zs.append(z)
        elif step.verdict is not None:
            began, balanced = step.time, step.verdict.outcome
        last = step
    while_held = np.array(bench.t) > began
    off = np.abs(np.array(bench.com)[while_held] - HOLDING.target)
    worst = off.max(axis=0) if len(off) else np.full(3, np.nan)
    at = np.array(bench.t)[while_held][off.max(axis=1).argmax()] - began if len(off) else np.nan
    start = np.array(bench.com)[~while_held][-1] - HOLDING.target
    done = bench.time - began >= hold - 1e-6
    z, error = np.array(zs)[1:], np.array(errors)[1:]
    return Run(seed, done, worst, moves, z, error, at, start, last.sentence,
               last.verdict.outcome, began, balanced)  # fmt: skip


def row_of(run: Run) -> Row:
    """Return the row of one run."""
    quantity = f"seed {run.seed}: worst true distance, um ({run.moves} moves)"
    found = triple(1e6 * run.worst) if run.held else f"not held to the end: {run.sentence}"
    return Row(quantity, found, f"at most {1e6 * LIMIT:g} per axis", run.well)


def note_of(run: Run) -> str:
    """Return what is to be said of a run that is not as wanted."""
    start = f"Seed {run.seed}: balancing left it {triple(1e6 * run.start)} um off; "
    if not run.held:
        return start + run.sentence
    mean, sds = 1e6 * np.mean(run.error[:, 2]), np.mean(run.z[:, 2])
    return start + (
        f"worst {run.at:.0f} s into the hold; the tracker's error in z is {mean:.2f} um on "
        f"average, {sds:.1f} of its sd. {run.sentence}"
    )


def measure(seeds: Sequence[int], spread: Spread = in_turn, hold: float = HOLD) -> Result:
    """Balance and hold one random platform for each seed."""
    runs = spread(partial(held, hold), seeds)
    error = np.vstack([run.error for run in runs if run.held] or [np.full((1, 3), np.nan)])
    z = np.vstack([run.z for run in runs if run.held] or [np.full((1, 3), np.nan)])
    spread_of_z = float(np.sqrt(np.mean(z**2)))
    rms = triple(1e6 * np.sqrt(np.mean(error**2, axis=0)))
    rows = (
        *(row_of(run) for run in runs),
        at_most("the tracker's error, rms at moves and ends, worst axis, um",
                float(1e6 * np.sqrt(np.mean(error**2, axis=0)).max()), 1.0),
    )  # fmt: skip
    well = sum(row.ok for row in rows[:-1])
    notes = (
        f"{well} of {len(runs)} seeds as wanted.",
        f"The tracker's error is {rms} um rms, {spread_of_z:.2f} times its own sd.",
        *(note_of(run) for run in runs if not row_of(run).ok),
    )
    claim = (
        "Preset sputnix with 1 um/min of drift in a random direction, declared "
        "under `[disturbance] consider`: balanced until it is known to "
        f"{1e6 * HOLDING.balancing.close[2]:g} um, with at most {HOLDING.balancing.max_moves} "
        f"moves and {HOLDING.balancing.max_time:g} s, then held for {hold / 60:.0f} min within "
        f"{1e6 * LIMIT:g} um of the target."
    )
    return Result("drift", claim, rows, notes)
