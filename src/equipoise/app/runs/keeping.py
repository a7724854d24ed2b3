"""One keeping of a bench: balance it, then hold it while an experiment runs, and note how it stood.

What grows with hours is not kept here: rows are in the bench's own record, moves are counted, and
Steps come at intervals.
"""

import math
import time
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path

import numpy as np

from equipoise.actuators.sliding_masses import shift_by
from equipoise.app.bench.step_notes import noting
from equipoise.app.console.stop_request import exit_code_of
from equipoise.app.live.feed_forward import Listener
from equipoise.app.runs.balancing import (
    QUIETLY,
    Goal,
    Through,
    halted,
    requested_stop,
    until_stopped,
)
from equipoise.app.runs.waiting import shown
from equipoise.io.documents.held_file import (
    PARAMETERS,
    HeldFile,
    HeldSag,
    read_held,
    write_held,
)
from equipoise.maths.linalg import pack_symmetric, unpack_symmetric
from equipoise.model.arrays import Quaternion, Series3, Square, Vector3
from equipoise.model.bench import Bench
from equipoise.model.errors import InputError
from equipoise.model.estimate import COM, Course
from equipoise.model.presentation import Shown
from equipoise.model.step import Step
from equipoise.model.testbed import Testbed
from equipoise.model.torque_terms import TERMS
from equipoise.model.verdict import Verdict
from equipoise.procedure.balancing.hold import Held, HoldOptions, balance_and_hold, hold
from equipoise.procedure.balancing.hold_resumed import Kept, kept_of, resumed
from equipoise.procedure.balancing.sag_shift import allowance, as_stiff
from equipoise.procedure.steps.gravity_feed_forward import expected, heavy_of
from equipoise.procedure.steps.planned_move import by_name
from equipoise.simulation.bench import SimulatedBench

EVERY = 1.0  # s between decisions, chosen: an experiment that says hold waits no longer
REPORTS = 200  # chosen: Steps with an estimate in one keeping, a minute between them at least
SAVED = 60.0  # s between two files from which a keeping goes on, and reports on a dashboard


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class Keeping(Shown):
    """What was done; moves of the hold are counted, not listed."""

    testbed: Testbed
    goal: Goal
    options: HoldOptions
    steps: Sequence[Step]
    course: Course  # of com as the masses stood, at each report
    moves: int
    travel: float  # m, of all masses
    truth: Series3 | None = None  # m, at the same times; of a simulated platform
    seed: int | None = None  # of all that was drawn; None: a real bench, or not known
    stopped_with: int | None = None  # exit code of who was stopped; None: ended by itself

    @property
    def verdict(self) -> Verdict:
        """Return the last word."""
        return next(step.verdict for step in reversed(self.steps) if step.verdict is not None)


@dataclass(frozen=True, slots=True, eq=False)
class Interrupted:
    """A keeping that goes on: what it knew, its goal, the time left (s), and since when (s)."""

    kept: Kept
    goal: Goal
    left: float
    gap: float

    def options(self, wanted: HoldOptions) -> HoldOptions:
        """Return the options of the hold that goes on, with all else as it is wanted now."""
        return options_for(self.goal, self.left, wanted)

    def standing(self, testbed: Testbed) -> dict[str, float]:
        """Return where each mass stood, m from home."""
        return by_name(testbed, self.kept.displacement)


@dataclass(frozen=True, slots=True, eq=False)
class Session:
    """How to keep a bench, from where on, and where it is saved; None: balanced first; nowhere."""

    options: HoldOptions
    start: Interrupted | None = None
    folder: Path | None = None
    listener: Listener | None = None  # of gravity's torque, after every measurement


@dataclass(slots=True, eq=False)
class _Notes:
    """What is noted while a bench is kept."""

    bench: Bench
    session: Session
    steps: list[Step] = field(default_factory=list[Step])
    rows: list[tuple[float, ...]] = field(default_factory=list[tuple[float, ...]])
    moves: int = 0
    travel: float = 0.0
    began: float | None = None
    held_at: Quaternion | None = None  # the attitude when it was last measured
    saved: float = -math.inf

    def held(self, held: Held) -> None:
        """Save where the hold stands, now and then."""
        now, testbed, options = self.bench.time, self.bench.testbed, self.session.options
        self.began = now if self.began is None else self.began
        self.held_at = held.state.q
        if self.session.listener is not None:
            heavy, shift = (
                heavy_of(testbed, held.params.torque),
                shift_by(testbed, held.displacement),
            )
            state = as_stiff(held.state, testbed.up)
            self.session.listener(expected(state, heavy, shift, now, 0.5 * options.every))
        if self.session.folder is not None and now - self.saved >= SAVED:
            self.saved = now
            left = max(self.began + options.duration - now, 0.0)
            write_held(file_of(kept_of(held), testbed, options, left), self.session.folder)

    def step(self, step: Step) -> None:
        """Count a move of the hold; keep any other step."""
        if self.began is not None and step.move is not None:
            self.moves, self.travel = self.moves + 1, self.travel + step.move.travel
            return
        self.steps.append(replace(step, recording=None) if self.began is not None else step)
        estimate = step.estimate
        if self.began is not None and estimate is not None:
            names = estimate.standing
            sd = np.sqrt(np.diag(estimate.covariance_of(names)))
            self.rows.append((step.time, *estimate.values(names), *sd, *self.true_com()))

    def true_com(self) -> Vector3:
        """Return where the centre of mass really is, as the hold means it; NaN of a real bench."""
        bench = self.bench
        if not isinstance(bench, SimulatedBench):
            return np.full(3, np.nan)
        if self.held_at is None or not bench.testbed.in_group("sag"):
            return bench.truth().com
        return bench.com - allowance(bench.sag, self.held_at, bench.testbed.up)

    def course(self) -> tuple[Course, Series3 | None]:
        """Return the course so far, and the truth at its times."""
        t, com, sd, true = np.split(np.array(self.rows).reshape(-1, 10), [1, 4, 7], axis=1)
        simulated = isinstance(self.bench, SimulatedBench)
        return Course(COM, t[:, 0], com, sd), true if simulated else None


def options_for(goal: Goal, duration: float, options: HoldOptions) -> HoldOptions:
    """Return options of a hold with a goal, a duration (s) and reports at intervals."""
    report = max(SAVED, duration / REPORTS)
    return replace(options, target=goal.target, tolerance=goal.tolerance, duration=duration,
                   every=EVERY, report=report)  # fmt: skip


def run(
    bench: Bench,
    session: Session,
    on_step: Callable[[Step], None] | None,
    through: Through = QUIETLY,
) -> Keeping:
    """Keep a bench balanced; what stops a real one is the last step. See ``balancing.run``."""
    options, start = session.options, session.start
    notes = _Notes(bench, session)
    on_step, stopped_with = noting(bench, on_step), None
    watched = through.observe(bench)
    try:
        awaited = until_stopped(watched, steps_of(watched, options, start, notes.held))
        for step in through.awaited(awaited, "keeping the balance"):
            notes.step(step)
            if on_step is not None and (step.move is None or notes.began is None):
                on_step(step)
    except KeyboardInterrupt as stop:
        reported, stopped_with = halted(bench), exit_code_of(stop)
        steps = [requested_stop(bench, stop, reported)]
        for step in shown(iter(steps), on_step):
            notes.step(step)
    seed = bench.seed if isinstance(bench, SimulatedBench) else None
    goal = Goal(options.target, options.tolerance)
    course, truth = notes.course()
    return Keeping(bench.testbed, goal, options, notes.steps, course, notes.moves, notes.travel,
                   truth, seed, stopped_with)  # fmt: skip


def steps_of(
    bench: Bench, options: HoldOptions, start: Interrupted | None, on_held: Callable[[Held], None]
) -> Iterator[Step]:
    """Yield the steps of balancing and holding, or of a hold that goes on."""
    if start is None:
        yield from balance_and_hold(bench, options.balancing, options, on_held)
        return
    yield from hold(bench, resumed(bench, start.kept, start.gap), options, on_held)


def file_of(kept: Kept, testbed: Testbed, options: HoldOptions, left: float) -> HeldFile:
    """Return the file of what outlasts a hold that would go on for ``left`` seconds."""
    torque = np.zeros(len(TERMS)) if kept.torque is None else kept.torque
    P, sag = kept.covariance, kept.sag
    own = None if sag is None else HeldSag(sag.tolist(), P[PARAMETERS:].tolist())
    return HeldFile(
        testbed.name, time.time(), left, options.target.tolist(), options.tolerance.tolist(),
        kept.com.tolist(), pack_symmetric(kept.inertia_P).tolist(), kept.drift.tolist(),
        kept.thermal.tolist(), P[:PARAMETERS, :PARAMETERS].tolist(), torque.tolist(),
        by_name(testbed, kept.displacement), own,
    )  # fmt: skip


def covariance_in(found: HeldFile) -> Square:
    """Return the covariance of a file, that of a sag included."""
    stiff = np.array(found.covariance)
    if found.sag is None:
        return stiff
    own = np.array(found.sag.covariance)
    beside = own[:, :PARAMETERS]
    return np.block([[stiff, beside.T], [beside, own[:, PARAMETERS:]]])


def interrupted(folder: Path, testbed: Testbed) -> Interrupted:
    """Return the keeping of a folder; InputError for one of another testbed."""
    found = read_held(folder)
    if found.testbed != testbed.name or set(found.displacement_m) != set(testbed.mass_names):
        raise InputError(
            str(folder), f"a keep of '{found.testbed}'", f"one of '{testbed.name}', with its masses"
        )
    kept = Kept(
        np.array(found.com_m), unpack_symmetric(np.array(found.inertia_P_kg_m2)),
        np.array(found.drift_m_s), np.array(found.thermal_m_K), covariance_in(found),
        np.array(found.torque), np.array([found.displacement_m[n] for n in testbed.mass_names]),
        None if found.sag is None else np.array(found.sag.coefficients_m),
    )  # fmt: skip
    goal = Goal(np.array(found.target_m), np.array(found.tolerance_m))
    return Interrupted(kept, goal, found.left_s, max(time.time() - found.utc_s, 0.0))
