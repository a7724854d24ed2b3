"""One balancing of a bench: its steps as they come, and what they did to the platform."""

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from signal import SIGINT

import numpy as np

from equipoise.app.bench.bench_proxy import RecordedBench
from equipoise.app.bench.step_notes import noting
from equipoise.app.console.stop_request import cause_of, exit_code_of, number_of
from equipoise.app.figures.balancing.story import Marked
from equipoise.app.runs.waiting import as_they_come, shown
from equipoise.app.text.before_after import Change
from equipoise.app.text.com_estimate import ComEstimate, com_after
from equipoise.estimation.search_budget import UNLIMITED, Budget
from equipoise.model.arrays import Matrix3, Vector3
from equipoise.model.bench import Bench
from equipoise.model.errors import BenchStopped, InputError
from equipoise.model.estimate import INERTIA, Estimate
from equipoise.model.manoeuvre import Manoeuvre
from equipoise.model.mass_properties import MassProperties
from equipoise.model.presentation import Plotted
from equipoise.model.reasons.reason import Number, one_reason
from equipoise.model.reasons.verdict_reasons import VerdictReason
from equipoise.model.recording import Recording
from equipoise.model.step import Step
from equipoise.model.testbed import Testbed
from equipoise.model.verdict import Verdict
from equipoise.procedure.balancing.balance import BalanceOptions
from equipoise.procedure.balancing.catalogue import (
    CARDS,
    OWN,
    balanced_and_followed,
    balanced_by,
    planned_and_balanced,
)
from equipoise.procedure.balancing.hold import MEASUREMENT, HoldOptions, balance_and_hold
from equipoise.procedure.balancing.motion_budget import NO_LIMIT, MotionBudget
from equipoise.procedure.balancing.schedule import ALWAYS, Schedule
from equipoise.procedure.identification.record_courses import RecordCourses, balancing_courses
from equipoise.simulation.bench import SimulatedBench

HALTED = "every mass was halted"


@dataclass(frozen=True, slots=True, eq=False)
class Goal:
    """Where the centre of mass is wanted, m."""

    target: Vector3
    tolerance: Vector3


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class Balancing(Plotted):
    """What was done, and the truth at every step when it is known."""

    testbed: Testbed
    goal: Goal
    steps: Sequence[Step]
    recording: Recording | None = None  # all that the bench was read
    truth_before: MassProperties | None = None
    truths: Sequence[MassProperties] = ()
    before: ComEstimate | None = None  # as known otherwise; None: the first estimate's
    law: str = OWN.name
    seed: int | None = None  # of all that was drawn; None: a real bench, or not known
    stopped_with: int | None = None  # exit code of who was stopped; None: ended by itself

    @property
    def simulated(self) -> bool:
        """Say whether the platform was a simulated one."""
        return self.truth_before is not None

    @property
    def verdict(self) -> Verdict:
        """Return the last word."""
        return next(step.verdict for step in reversed(self.steps) if step.verdict is not None)

    @property
    def estimate(self) -> Estimate | None:
        """Return the last estimate."""
        return next((s.estimate for s in reversed(self.steps) if s.estimate is not None), None)

    def courses(self) -> RecordCourses:
        """Return what the figures of its report draw along the recording."""
        return balancing_courses(self.recording, self.testbed, self.estimate)


@dataclass(frozen=True, slots=True, eq=False)
class Limits:
    """By which law, when to give up (None: as the law has it), how long to hold the balance."""

    max_moves: int | None = None
    max_time: float | None = None  # s
    hold: float = 0.0  # s
    law: str = OWN.name
    plan: Manoeuvre | None = None  # to begin with
    budget: Budget = UNLIMITED  # of each fit
    motion: MotionBudget = NO_LIMIT  # of a hold
    schedule: Schedule = ALWAYS  # of a hold
    every: float = MEASUREMENT  # s between the decisions of a hold
    report: float = math.inf  # s between Steps of a hold with an estimate


@dataclass(frozen=True, slots=True, eq=False)
class Through:
    """How a run is observed: the bench as the procedure gets it, how its steps are awaited."""

    observe: Callable[[Bench], Bench]
    awaited: Callable[[Iterator[Step], str], Iterator[Step]]


QUIETLY = Through(lambda bench: bench, as_they_come)  # nobody observes


def run(
    bench: Bench,
    goal: Goal,
    limits: Limits,
    on_step: Callable[[Step], None] | None,
    through: Through = QUIETLY,
) -> Balancing:
    """Balance a bench, show each step as it comes; Ctrl-C and its like halt the bench.

    What stops a real bench, a person's Ctrl-C too, is the last step. The truth is known of a
    simulated one alone. ``through`` says how the run is observed.
    """
    simulated = bench if isinstance(bench, SimulatedBench) else None
    before = None if simulated is None else simulated.truth()
    on_step = noting(bench, on_step)
    recorded = RecordedBench(through.observe(bench))
    steps: list[Step] = []
    truths: list[MassProperties] = []
    stopped_with = None
    try:
        awaited = until_stopped(recorded, procedure(recorded, goal, limits))
        for step in shown(through.awaited(awaited, "balancing"), on_step):
            steps.append(step)
            if simulated is not None:
                truths.append(simulated.truth())
    except KeyboardInterrupt as stop:
        reported, stopped_with = halted(bench), exit_code_of(stop)
        if simulated is not None:
            stop.args = (reported,)
            raise
        steps.append(requested_stop(bench, stop, reported))
        if on_step is not None:
            on_step(steps[-1])
    # A law's first estimate may hold parameters that are not known: it is no prior.
    body, sd = bench.testbed.body, bench.testbed.com_sd
    known = None if limits.law == OWN.name else ComEstimate(body.com, sd)
    planned = limits.plan is not None and bool(truths)
    began = truths[0] if planned else before  # after the manoeuvre
    seed = None if simulated is None else simulated.seed
    return Balancing(
        bench.testbed, goal, steps, recorded.recording(), began, truths, known, limits.law, seed,
        stopped_with,
    )  # fmt: skip


def halted(bench: Bench) -> str:
    """Halt every mass; return what came of it, also where an interlock was faster."""
    try:
        bench.stop()
    except BenchStopped as stopped:
        return str(stopped)
    return HALTED


def until_stopped(bench: Bench, steps: Iterator[Step]) -> Iterator[Step]:
    """Return the steps, and a stop with its reason where the bench was stopped under way."""
    try:
        yield from steps
    except BenchStopped as stopped:
        cause = stopped.cause
        codes = () if cause is None else (str(cause.code), *cause.parameters)
        numbers = dict[str, Number]() if cause is None else cause.numbers
        yield stop_step(bench, VerdictReason.BENCH_STOPPED, str(stopped), *codes, **numbers)


def stop_step(bench: Bench, code: VerdictReason, *about: str, **numbers: Number) -> Step:
    """Return the last step of a run that was stopped; what it is about begins with a text."""
    judged = Verdict(one_reason(code, *about, **numbers))
    return Step("stop", bench.time, judged.reasons, verdict=judged)


def requested_stop(bench: Bench, stop: KeyboardInterrupt, reported: str) -> Step:
    """Return the last step of a run that somebody stopped, with what came of it."""
    if number_of(stop) == SIGINT:
        return stop_step(bench, VerdictReason.STOPPED_BY_HAND, reported)
    return stop_step(bench, VerdictReason.STOPPED_BY_SIGNAL, cause_of(stop), reported)


def procedure(bench: Bench, goal: Goal, limits: Limits) -> Iterator[Step]:
    """Return the steps of balancing and, when that passes and a hold is requested, of holding."""
    aim, budget = (goal.target, goal.tolerance), limits.budget
    holding = HoldOptions(*aim, duration=limits.hold, budget=budget, motion=limits.motion,
                          schedule=limits.schedule, every=limits.every,
                          report=limits.report)  # fmt: skip
    usual = holding.balancing if limits.hold > 0 else BalanceOptions(*aim, budget=budget)
    moves = usual.max_moves if limits.max_moves is None else limits.max_moves
    balancing = replace(usual, max_moves=moves, max_time=limits.max_time or usual.max_time)
    if limits.plan is not None:
        if limits.law != OWN.name or limits.hold > 0:
            raise InputError("--plan", "another law, or a hold", f"{OWN.name} without a hold")
        return planned_and_balanced(bench, balancing, limits.plan)
    if limits.hold == 0:
        return balanced_by(limits.law, bench, balancing, limits.max_time)
    if limits.law == OWN.name:
        return balance_and_hold(bench, balancing, holding)
    able = [OWN.name, *(card.name for card in CARDS.values() if card.follows)]
    if limits.law not in able:
        wanted = f"a hold after {' or '.join(able)}, or no hold"
        raise InputError("--hold-min", f"a hold after {limits.law}", wanted)
    own = BalanceOptions(*aim, budget=budget)
    return balanced_and_followed(limits.law, bench, own, limits.max_time, limits.hold)


def measurements(done: Balancing) -> list[Marked]:
    """Return time and centre of mass of every estimate and of the verdict."""
    reported = [(step.time, com_after(step)) for step in done.steps]
    return [(time, each.com, each.sd) for time, each in reported if each is not None]


def inertia_known(done: Balancing) -> tuple[Matrix3, float]:
    """Return the inertia as last estimated, else the testbed's, and its relative sd."""
    estimate, testbed = done.estimate, done.testbed
    if estimate is None or not estimate.sees(INERTIA):
        return testbed.body.inertia_P, testbed.inertia_sd
    moments = INERTIA[:3]
    sd = np.sqrt(np.diag(estimate.covariance_of(moments)))
    return estimate.inertia_P, float(np.max(sd / estimate.values(moments)))


def change_of(done: Balancing) -> Change | None:
    """Return before and after: the first estimate, and the verdict or else the last estimate."""
    observed = measurements(done)
    if not observed:
        return None
    return Change(
        done.testbed,
        *inertia_known(done),
        done.goal.target,
        done.before or ComEstimate(*observed[0][1:]),
        ComEstimate(*observed[-1][1:]),
        done.truth_before,
        done.truths[-1] if done.truths else None,
    )
