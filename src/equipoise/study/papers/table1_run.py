"""One run of table 1 of da Silva et al. (2021) on one platform, judged by the truth.

Torque is root mean square over directions within a tilt of level, as in ``study.law_run``.
"""

from collections.abc import Callable, Iterator, Mapping, Sequence
from itertools import islice
from typing import NamedTuple

import numpy as np

from equipoise.control.elements.attitude_pid import Gains
from equipoise.estimation.method_contract import Options, estimated
from equipoise.estimation.methods.registry import METHODS
from equipoise.maths.attitude import exponential, level, multiply
from equipoise.maths.axes_across import axes_across
from equipoise.model.arrays import Quaternion, Vector3
from equipoise.model.bench import Bench
from equipoise.model.mass_properties import MassProperties
from equipoise.model.step import Step
from equipoise.model.testbed import Testbed
from equipoise.model.units import UM
from equipoise.procedure.balancing.balance import BalanceOptions
from equipoise.procedure.balancing.run_law import LawOptions, run_law
from equipoise.simulation.hands import SimulatedHands
from equipoise.study.law_run import Task, judged_run, law_run
from equipoise.study.manual_run import manual_run, torque_of
from equipoise.study.papers.compensation import compensation
from equipoise.study.papers.gyro_slew import slewed
from equipoise.study.papers.run_engine import Spread
from equipoise.study.papers.table1 import Entry, Left, Trial, Way, trials_of

LONGEST = 1200.0  # s on the bench's clock, chosen: an adaptive law takes a quarter of an hour
SHORT = 600.0  # s, chosen: of measure_and_move
MOVES = 8  # chosen: of measure_and_move
ROUNDS = 6  # placings, chosen
HEADING, LEAN = float(np.radians(70.0)), float(np.radians(20.0))  # rad, chosen: of a slew's end
SLEW = 60.0  # s, chosen: until the platform rests
FREQUENCY, DAMPING, INTEGRAL = 0.3, 0.7, 0.05  # rad/s, -, rad/s, chosen: of a slew
MOST = 0.05  # N m, chosen: twice the torque of an offset that a person leaves on a large table


class Ran(NamedTuple):
    """What an entry's own method left of each platform, and ours; by hand these are one."""

    entry: Entry
    own: Sequence[Left]
    best: Sequence[Left]


def task_of(trial: Trial) -> Task:
    """Return what ``study.law_run`` is to run; the centre of mass goes to that of rotation."""
    tolerance = np.array(trial.entry.tolerance) * UM
    options = BalanceOptions(np.zeros(3), tolerance, MOVES, SHORT)
    name = trial.procedure.name
    return Task(name, trial.testbed, trial.seed, options, LONGEST, trial.entry.tilt)


def by_law(trial: Trial) -> Left:
    """Return what a law leaves."""
    run = law_run(task_of(trial))
    return Left(run.left, length(run.offset), run.torque_before, run.time)


def by_compensation(trial: Trial) -> Left:
    """Return what moves by a printed method's estimates leave."""
    task, procedure = task_of(trial), trial.procedure
    law = compensation(procedure.name, procedure.hold)
    options = LawOptions(task.options.target, task.options.tolerance, max_time=task.max_time)

    def balancing(bench: Bench) -> Iterator[Step]:
        """Return the steps on a bench."""
        return run_law(bench, law, options)

    run = judged_run(task, balancing)
    return Left(run.torque, length(run.offset), run.torque_before, run.time)


def by_placing(trial: Trial) -> Left:
    """Return what weights leave that a person places as asked; height counts where it can be."""
    run = manual_run(task_of(trial), ROUNDS)
    return Left(run.torque, length(run.offset), run.torque_before, run.time)


def by_feed_forward(trial: Trial) -> Left:
    """Return the torque that gyros leave which hold against an estimated centre of mass."""
    testbed = trial.testbed
    gains = Gains(testbed.body.inertia_P, FREQUENCY, DAMPING, INTEGRAL, MOST)
    slew = slewed(testbed, turned(testbed.up), gains, SLEW, trial.seed)
    true = SimulatedHands(testbed, trial.seed).truth()
    found = estimated(METHODS[trial.procedure.name], slew.recording, testbed, Options())
    error = MassProperties(true.mass, true.com - found.com, true.inertia_P)
    task = task_of(trial)
    return Left(torque_of(error, task), length(error.com), torque_of(true, task), SLEW)


def turned(up: Vector3) -> Quaternion:
    """Return the attitude at the end of a slew: another heading, and a tilt."""
    lean = exponential(LEAN * axes_across(up)[0])
    return multiply(level(up), multiply(exponential(HEADING * up), lean))


def length(offset: Vector3) -> float:
    """Return |r|, m."""
    return float(np.linalg.norm(offset))


RUNS: dict[Way, Callable[[Trial], Left]] = {
    "law": by_law,
    "compensation": by_compensation,
    "placing": by_placing,
    "feed_forward": by_feed_forward,
}


def left_by(trial: Trial) -> Left:
    """Return what one run leaves; InputError where a procedure does not run on the testbed."""
    return RUNS[trial.procedure.way](trial)


def table1_runs(
    beds: Mapping[str, Testbed], entries: Sequence[Entry], seeds: Sequence[int], spread: Spread
) -> list[Ran]:
    """Return all platforms of some entries; ``beds``: the testbeds of the presets, by name."""
    trials = [trials_of(entry, beds[entry.preset], seeds) for entry in entries]
    found = iter(spread(left_by, [trial for each in trials for trial in each]))
    ran, n = list[Ran](), len(seeds)
    for entry, each in zip(entries, trials, strict=True):
        left = list(islice(found, len(each)))
        ran.append(Ran(entry, left[:-n], left[-n:]))
    return ran
