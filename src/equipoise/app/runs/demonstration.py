"""The demo: a record with a known move, its estimate, then balancing the same platform."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np

from equipoise.app.console.rich_blocks import show
from equipoise.app.console.terminal import busy, watched
from equipoise.app.figures.catalogue import TrueCourse
from equipoise.app.runs.balancing import Balancing, Goal, Limits, run
from equipoise.app.runs.terminal_balancing import at_terminal
from equipoise.app.text.blocks import Heading
from equipoise.app.text.com_estimate import at_home
from equipoise.app.text.estimate_text import estimate_tables, outcome_claim
from equipoise.model.estimate import Estimate
from equipoise.model.recording import Recording, join, window
from equipoise.model.step import Step
from equipoise.model.testbed import Testbed
from equipoise.model.units import MM
from equipoise.procedure.identification.identify import IdentifyOptions, identify
from equipoise.procedure.identification.record_courses import (
    RecordCourses,
    TrackedCourses,
    balancing_courses,
    fit_motions,
    tracked_courses,
)
from equipoise.simulation.bench import SimulatedBench
from equipoise.simulation.free_start import freely

MEASURED = 60.0  # s before and after the move, chosen
MOVE = {"x1": -10 * MM, "y1": -10 * MM, "z1": -50 * MM}  # m, the paper's section 5
GOAL = Goal(np.array([0.0, 0.0, -100e-6]), np.array([2e-6, 2e-6, 3e-6]))


@dataclass(frozen=True, slots=True, eq=False)
class Demonstration:
    """All that was done."""

    recording: Recording
    truth: TrueCourse  # across the known move
    identified: Sequence[Step]
    balancing: Balancing

    @property
    def estimate(self) -> Estimate:
        """Return the estimate from the record with the known move."""
        found = self.identified[-1].estimate
        assert found is not None
        return found


@dataclass(frozen=True, slots=True, eq=False)
class DemoCourses:
    """What is drawn along the records of the demonstration."""

    still: Recording  # before the known move
    tracked: TrackedCourses  # along ``still``
    identified: RecordCourses
    balanced: RecordCourses


def run_demo(testbed: Testbed, seed: int, show_step: Callable[[Step], None]) -> Demonstration:
    """Identify, show the tables, and balance, on one simulated platform."""
    show((Heading(f"{testbed.name}, simulated, seed {seed}"),))
    show((Heading("1  Identify: free motion, masses moved half way"),), below=True)
    with busy("simulating"):
        recording, truth = freely(testbed, seed, measured)[1]
    identifying = watched(identify(recording, testbed, IdentifyOptions()), "identifying")
    steps = list(identifying)
    estimate = steps[-1].estimate
    assert estimate is not None
    show((*estimate_tables(estimate)[:1], outcome_claim(estimate)), below=True)
    show((Heading("2  Balance: the same platform, levelled and released again"),), below=True)
    done = run(SimulatedBench(testbed, seed), GOAL, Limits(), show_step, at_terminal(testbed))
    return Demonstration(recording, truth, steps, replace(done, before=at_home(estimate)))


def measured(bench: SimulatedBench) -> tuple[Recording, TrueCourse]:
    """Return a record across a known move, and the truth along it."""
    first = bench.read(MEASURED)
    before = bench.truth().com
    bench.move(MOVE)
    second = bench.read(MEASURED)
    after = bench.truth().com
    bed = bench.testbed
    travel = max(abs(d) / bed.mass_named(name).speed for name, d in MOVE.items())
    t = np.array([0.0, MEASURED, MEASURED, MEASURED + travel, 2 * MEASURED])
    under_way = np.full(3, np.nan)  # the truth is taken when masses stand
    return join(first, second), (t, np.array([before, before, under_way, after, after]))


def courses_of(shown: Demonstration) -> DemoCourses:
    """Return the courses that the report draws."""
    done, recording, estimate = shown.balancing, shown.recording, shown.estimate
    bed, still = done.testbed, window(recording, 0.0, MEASURED)
    identified = RecordCourses(
        fit_motions(recording, bed, estimate),
        tracked_courses(recording, bed, estimate, compare=True),
    )
    balanced = balancing_courses(done.recording, bed, done.estimate)
    return DemoCourses(still, tracked_courses(still, bed, estimate), identified, balanced)
