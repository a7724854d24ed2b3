"""Hold: keep the centre of mass at its target, while the platform warms up and drifts.

The tracker starts from the estimate of balancing, inertia, drift and their uncertainty included;
the masses follow whenever one of their steps brings the centre of mass closer to its target, where
it drifts to until the next measurement. That it drifts need not be declared: the tracker's state
has the rate, which is uncertain at first by as much as a platform warms up.

Of a platform whose testbed declares sag the tracker's state has that, too. What is meant by its
centre of mass is that of the stiff platform which acts alike at its attitude (``sag_shift``): so
the masses follow the tilt, and how well the sag is known counts where it acts.

It is judged at every measurement by the tracker's posterior, and by what that predicts up to the
next one: held is what is within tolerance for sure each time (``model.criterion.jointly``). A hold
ends where the masses are at the end of their rails.
"""

from collections.abc import Callable, Iterator
from dataclasses import dataclass, field, replace

import numpy as np

from equipoise.estimation.tracker import tracker
from equipoise.model.arrays import Floats, Vector3
from equipoise.model.bench import Bench
from equipoise.model.bench_requests import in_steps
from equipoise.model.permission import Permission
from equipoise.model.reasons.reason import axes_of, one_reason
from equipoise.model.reasons.step_reasons import MoveReason
from equipoise.model.reasons.verdict_reasons import VerdictReason
from equipoise.model.recording import Recording
from equipoise.model.step import Step
from equipoise.model.testbed import Testbed
from equipoise.model.torque_terms import GROUPS, TERMS
from equipoise.model.units import UM
from equipoise.model.verdict import Verdict
from equipoise.procedure.balancing.balance import BalanceOptions, balance
from equipoise.procedure.balancing.hold_estimate import report_step
from equipoise.procedure.balancing.hold_moves import nearest_offset, next_goal, significant_com
from equipoise.procedure.balancing.hold_posterior import (
    COM_WALK,
    ahead,
    before_moving,
    moved_on,
    shifted,
    standing,
)
from equipoise.procedure.balancing.hold_start import first_state
from equipoise.procedure.balancing.hold_verdict import (
    Measured,
    course_from,
    followed,
    verdict_on,
)
from equipoise.procedure.balancing.motion_budget import (
    NO_LIMIT,
    MotionBudget,
    longest_first,
    reached,
    slowed,
    speed_for,
)
from equipoise.procedure.balancing.sag_shift import as_stiff
from equipoise.procedure.balancing.schedule import ALWAYS, Schedule
from equipoise.procedure.steps.joint_fit import Knowledge, as_it_sags
from equipoise.procedure.steps.planned_move import by_name, planned_move
from equipoise.procedure.steps.sampler import last_row
from equipoise.procedure.steps.tilt_guard import tilted
from equipoise.procedure.steps.verify import Aim, at

MEASUREMENT = 5.0  # s between decisions
SOON = 0.4  # s, chosen: before the first, as balancing leaves it anywhere within tolerance
CLOSENESS = 0.4  # of the tolerance, chosen: for what is uncertain after balancing; it stays
FIRST_MOVES, FIRST_TIME = 10, 600.0  # s, chosen: allowed to the balancing before a hold
IN_STATE = np.isin(TERMS, GROUPS["sag"])
DRIFT_WALK = 5e-10  # m/s/sqrt(s), chosen: by 1.3 um/min within half an hour


@dataclass(frozen=True, slots=True, eq=False)
class HoldOptions(Aim):
    """The aim, for how long, and what masses may do meanwhile."""

    tolerance: Vector3 = field(default_factory=lambda: np.full(3, 3 * UM))  # m
    duration: float = field(kw_only=True)  # s
    every: float = field(default=MEASUREMENT, kw_only=True)  # s between decisions
    motion: MotionBudget = field(default=NO_LIMIT, kw_only=True)
    schedule: Schedule = field(default=ALWAYS, kw_only=True)
    report: float = field(default=np.inf, kw_only=True)  # s between Steps with an estimate

    @property
    def balancing(self) -> BalanceOptions:
        """Return the options of the balancing before the hold.

        An inertia wrong by 1 % is a height wrong by 1 um at 100 um, for as long as the hold lasts:
        so there are moves to estimate it by. Where the centre of mass is then does not matter as
        long as it is within tolerance: the hold moves it.
        """
        return BalanceOptions(
            self.target, self.tolerance, FIRST_MOVES, FIRST_TIME, CLOSENESS, budget=self.budget
        )


@dataclass(frozen=True, slots=True, eq=False)
class Held:
    """Where a hold stands: from here it goes on, also after an interruption."""

    state: tracker.State
    params: tracker.Params
    displacement: Floats  # m, as reported last
    aimed: Floats  # m, where masses were sent last
    granted: Permission = Permission.FREE


def unheeded(_held: Held) -> None:
    """Let nobody know."""


def balance_and_hold(
    bench: Bench,
    balancing: BalanceOptions,
    holding: HoldOptions,
    on_held: Callable[[Held], None] = unheeded,
) -> Iterator[Step]:
    """Yield the Steps of balancing and then of holding.

    Not of holding when balancing ended in a stop for tilt or with an estimate that cannot be used,
    its sag counted; a verdict missed by a little holding can mend.
    """
    began = bench.time
    knowledge = yield from balance(bench, balancing)
    tilted_out = tilted(knowledge.recording, bench.testbed, began)
    known = as_it_sags(knowledge, bench.testbed)
    if known.estimate.outcome.usable and not tilted_out:
        yield from hold(bench, begun(known, bench.testbed), holding, on_held)


def begun(knowledge: Knowledge, testbed: Testbed) -> Held:
    """Return where a hold begins: at what is known, of a sag if that is among it."""
    state, params = first_state(knowledge, testbed), params_for(knowledge.fitted.point.torque)
    return Held(state, params, knowledge.displacement, knowledge.displacement)


def hold(
    bench: Bench, start: Held, options: HoldOptions, on_held: Callable[[Held], None] = unheeded
) -> Iterator[Step]:
    """Yield a Step whenever masses set off or their permission changes, and a verdict at the end.

    ``on_held`` gets where the hold stands after every measurement.
    """
    testbed, held, began = slowed(bench.testbed, options.motion), start, bench.time
    end, due = began + options.duration, began + options.report
    course, wait = course_from(posterior_of(acting_of(held, testbed), testbed), options), SOON
    while bench.time < end - 1e-9 and held.granted is not Permission.DONE:
        fresh, wait = bench.read(min(wait, end - bench.time)), options.every
        held, track = measured(held, fresh, testbed)
        on_held(held)
        acting, lapse = acting_of(held, testbed), min(options.every, end - bench.time)
        now, later = outlook(acting, testbed, lapse)
        why = reason_to_stop(fresh, *arrival(acting, testbed, options, lapse), testbed, options)
        if why is not None:
            bench.stop()
            yield stop_step(bench, now, why, bench.time - began)
            return
        if bench.time >= due - 1e-9:
            due += options.report
            yield report_step(bench.time, track, acting.state, acting.displacement, testbed)
        acting, steps, moved = acted(bench, testbed, acting, options, lapse)
        held = replace(acting, state=held.state)
        for claim in (now, moved or later):
            course = followed(course, claim, options)
        yield from (replace(step, recording=fresh) for step in steps)
    judged = verdict_on(course, options, bench.time - began)
    yield Step("verify", bench.time, judged.reasons, verdict=judged)


def measured(held: Held, fresh: Recording, testbed: Testbed) -> tuple[Held, tracker.Track]:
    """Return where a hold stands after rows that are new."""
    track = tracker.track(fresh, testbed, held.params, held.state)
    displacement = last_row(fresh.masses, held.displacement)
    return replace(held, state=track.end, displacement=displacement), track


def acting_of(held: Held, testbed: Testbed) -> Held:
    """Return where a hold stands with the state of the stiff platform that acts alike now."""
    return replace(held, state=as_stiff(held.state, testbed.up))


def posterior_of(held: Held, testbed: Testbed) -> Measured:
    """Return the posterior of the centre of mass with the masses where they are."""
    return standing(held.state, testbed, held.displacement)


def outlook(held: Held, testbed: Testbed, lapse: float) -> tuple[Measured, Measured]:
    """Return the posterior now, and a while (s) later, with masses on the way they are on."""
    now = posterior_of(held, testbed)
    there = reached(testbed, held.displacement, held.aimed, lapse)
    return now, shifted(ahead(now, held.state, lapse), testbed, there - held.displacement)


def arrival(
    held: Held, testbed: Testbed, options: HoldOptions, lapse: float
) -> tuple[Vector3, Floats]:
    """Return the significant centre of mass (m) once masses are where they were sent, and that."""
    later = ahead(posterior_of(held, testbed), held.state, lapse)
    there = shifted(later, testbed, held.aimed - held.displacement)
    return significant_com(there, options), held.aimed


def acted(
    bench: Bench, testbed: Testbed, held: Held, options: HoldOptions, lapse: float
) -> tuple[Held, list[Step], Measured | None]:
    """Let masses do what they may: return the hold then, Steps, and the posterior to come.

    The posterior comes of a move alone; the masses of ``testbed`` are slowed to their budget.
    """
    permission, reasons = options.schedule.at(bench.time)
    changed = permission is not held.granted
    steps = [Step("control", bench.time, reasons)] if changed else []
    held = replace(held, granted=permission)
    if permission is not Permission.FREE:
        return halted(bench, held, options.motion), steps, None
    goal = next_goal(held.state, *arrival(held, testbed, options, lapse), testbed, options)
    if goal is None:
        return held, steps, None
    now = posterior_of(held, testbed)
    goal = longest_first(bench.testbed, held.displacement, goal, options.motion)
    parting = before_moving(now, testbed, held.displacement, goal)
    move = planned_move(testbed, held.displacement, goal, parting, MoveReason.DRIFT)
    bench.move(move.targets, speed_for(bench.testbed, goal - held.displacement, options.motion))
    held = replace(held, aimed=goal)
    there = reached(testbed, held.displacement, goal, lapse)
    later = moved_on(move, now, ahead(now, held.state, lapse))
    why = one_reason(move.reason, **axes_of("was", now.com), travel=move.travel)
    steps.append(Step("move", bench.time, why, move=move))
    return held, steps, shifted(later, testbed, there - goal)


def halted(bench: Bench, held: Held, budget: MotionBudget) -> Held:
    """Let masses stand at the step of their motors that they are next to."""
    masses, here = bench.testbed.masses, held.displacement
    steps = np.array([in_steps(mass, float(d)) for mass, d in zip(masses, here, strict=True)])
    if np.array_equal(held.aimed, steps):
        return held
    bench.move(by_name(bench.testbed, steps), speed_for(bench.testbed, steps - here, budget))
    return replace(held, aimed=steps)


def params_for(torque: Floats | None) -> tracker.Params:
    """Return the tracker's options with known torque coefficients: its state has drift and sag."""
    stiff = None if torque is None else np.where(IN_STATE, 0.0, torque)
    return tracker.Params(torque=stiff, com_walk=COM_WALK, drift_walk=DRIFT_WALK)


def reason_to_stop(
    fresh: Recording, com: Vector3, displacement: Floats, testbed: Testbed, options: HoldOptions
) -> VerdictReason | None:
    """Return why to stop now, or None: it tilts too far, or no mass can follow any more."""
    if tilted(fresh, testbed):
        return VerdictReason.TILTED
    if bool(np.all(np.abs(com - options.target) <= options.tolerance)):
        return None
    left = nearest_offset(com, displacement, testbed, options.target)
    return VerdictReason.RAILS_ENDED if bool(np.any(left > options.tolerance)) else None


def stop_step(bench: Bench, last: Measured, why: VerdictReason, duration: float) -> Step:
    """Return the stop of a hold, with its reason, after so long (s)."""
    numbers = {} if why is VerdictReason.TILTED else {"duration": duration, **at(last.com, last.sd)}
    verdict = Verdict(one_reason(why, **numbers), last.com, last.sd)
    return Step("stop", bench.time, verdict.reasons, verdict=verdict)
