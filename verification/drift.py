"""Balance, then hold for half an hour while the centre of mass drifts by 1 um a minute.

The bench is watched from outside: its true centre of mass is noted every second.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field, replace
from functools import partial

import numpy as np
from numpy.typing import NDArray

from equipoise.actuators.sliding_masses import com_shift, mass_maps
from equipoise.io.testbed.presets import read_preset
from equipoise.model.step import Step
from equipoise.model.testbed import Testbed
from equipoise.model.torque_terms import expand
from equipoise.procedure.balancing.hold import HoldOptions
from equipoise.procedure.steps.planned_move import stops_covariance
from equipoise.study.held_run import HeldRun, TrueCourseBench, held_run
from verification.result import Result, Row, Spread, at_most, in_turn, triple

DRIFT = 1e-6 / 60  # m/s
HOLD = 1800.0  # s
LIMIT = 3e-6  # m, per axis
HOLDING = HoldOptions(duration=HOLD)
TERMS = expand(("drift",))
Array = NDArray[np.float64]


@dataclass(frozen=True, slots=True, eq=False)
class Run:
    """One platform balanced and held, and the tracker's errors meanwhile."""

    run: HeldRun
    z: Array  # (n, 3) the tracker's errors in its own sd, at every move and the end
    error: Array  # (n, 3) m, the same


def drifting(seed: int) -> Testbed:
    """Return the preset with a drift in a random direction, to be looked for."""
    way = np.random.default_rng([seed, 2]).normal(size=3)
    drift = dict(zip(TERMS, DRIFT * way / np.linalg.norm(way), strict=True))
    testbed = read_preset("sputnix")
    return replace(testbed, disturbances=TERMS, truth=replace(testbed.truth, torque=drift))


@dataclass(slots=True, eq=False)
class Errors:
    """The tracker's errors (m) and in its own sd, noted as the steps of a hold pass."""

    error: list[Array] = field(default_factory=list)
    z: list[Array] = field(default_factory=list)

    def noted(self, steps: Iterator[Step], bench: TrueCourseBench) -> Iterator[Step]:
        """Yield the steps as they come; note errors from the end of the balancing on."""
        holds = False
        for step in steps:
            if holds:
                error, sd = error_of(step, bench)
                self.error.append(error)
                self.z.append(error / sd)
            holds = holds or step.verdict is not None
            yield step


def error_of(step: Step, bench: TrueCourseBench) -> tuple[Array, Array]:
    """Return the tracker's error at a step (m) and its sd, NaN when it says nothing."""
    true = bench.coms[-1]
    if step.move is not None and step.move.reason == "drift":
        maps, mass = mass_maps(bench.testbed.masses), bench.testbed.body.mass
        goal = np.array([step.move.targets[m.name] for m in bench.testbed.masses])
        now = step.recording.masses.values[-1]
        error = step.move.predicted_com - com_shift(maps, mass, goal - now) - true
        moving = goal != now
        added = stops_covariance(bench.testbed, moving)
        left = stops_covariance(bench.testbed, moving & (now != 0))
        known = step.move.predicted_covariance - added - left  # before the move
        return error, np.sqrt(np.diag(known))
    if step.verdict is not None and step.verdict.com is not None:
        return step.verdict.com - true, step.verdict.sd
    return np.full(3, np.nan), np.ones(3)


def held(hold: float, seed: int) -> Run:
    """Balance and hold the platform of one seed for so long (s)."""
    errors = Errors()
    run = held_run(drifting(seed), HoldOptions(duration=hold), seed, errors.noted)
    return Run(run, np.array(errors.z), np.array(errors.error))


def row_of(run: HeldRun) -> Row:
    """Return the row of one run."""
    quantity = f"seed {run.seed}: worst true distance, um ({run.moves} moves)"
    found = triple(1e6 * run.worst) if run.held else f"not held to the end: {run.last.sentence}"
    return Row(quantity, found, f"at most {1e6 * LIMIT:g} per axis", run.well)


def note_of(run: HeldRun) -> str:
    """Return what is to be said of a run that is not as wanted."""
    start = f"Seed {run.seed}: balancing left it {triple(1e6 * run.start)} um off; "
    if not run.held:
        return start + run.last.sentence
    return start + f"worst {run.at:.0f} s into the hold. {run.last.sentence}"


def measure(seeds: Sequence[int], spread: Spread = in_turn, hold: float = HOLD) -> Result:
    """Balance and hold one random platform for each seed."""
    runs = spread(partial(held, hold), seeds)
    whole = [each for each in runs if each.run.held]
    error = np.vstack([each.error for each in whole] or [np.full((1, 3), np.nan)])
    z = np.vstack([each.z for each in whole] or [np.full((1, 3), np.nan)])
    spread_of_z = float(np.sqrt(np.mean(z**2)))
    rms = triple(1e6 * np.sqrt(np.mean(error**2, axis=0)))
    rows = (
        *(row_of(each.run) for each in runs),
        at_most("the tracker's error, rms at moves and ends, worst axis, um",
                float(1e6 * np.sqrt(np.mean(error**2, axis=0)).max()), 1.0),
    )  # fmt: skip
    well = sum(row.ok for row in rows[:-1])
    notes = (
        f"{well} of {len(runs)} seeds as wanted.",
        f"The tracker's error is {rms} um rms, {spread_of_z:.2f} times its own sd.",
        *(note_of(each.run) for each in runs if not each.run.well),
    )
    claim = (
        "Preset sputnix with 1 um/min of drift in a random direction, declared "
        "under `[disturbance] consider`: balanced until it is known to "
        f"{1e6 * HOLDING.balancing.close[2]:g} um, with at most {HOLDING.balancing.max_moves} "
        f"moves and {HOLDING.balancing.max_time:g} s, then held for {hold / 60:.0f} min within "
        f"{1e6 * LIMIT:g} um of the target."
    )
    return Result("drift", claim, rows, notes)
