"""Hold: keep the centre of mass at its target, while the platform warms up and drifts.

The tracker starts from the estimate of balancing, inertia, drift and their uncertainty included;
the masses follow whenever one of their steps brings the centre of mass closer to its target, where
it drifts to until the next measurement. That it drifts need not be declared: the tracker's state
has the rate, which is uncertain at first by as much as a platform warms up.

It is judged at every measurement by the tracker's posterior, and by what that predicts up to the
next one: held is what is within tolerance for sure each time (``model.criterion.jointly``). A hold
ends where the masses are at the end of their rails.
"""

from collections.abc import Iterator
from dataclasses import dataclass, field, replace

import numpy as np

from equipoise.actuators.sliding_masses import shift_by
from equipoise.estimation.tracker import tracker
from equipoise.estimation.tracker.predict_correct import DRIFTING
from equipoise.estimation.tracker.warmth import heat_of, warmth_of
from equipoise.model.arrays import Floats, Vector3
from equipoise.model.bench import Bench
from equipoise.model.estimate import INERTIA
from equipoise.model.reasons.reason import axes_of, one_reason
from equipoise.model.reasons.step_reasons import MoveReason
from equipoise.model.reasons.verdict_reasons import VerdictReason
from equipoise.model.recording import Recording
from equipoise.model.step import Step
from equipoise.model.testbed import Testbed
from equipoise.model.units import UM
from equipoise.model.verdict import Verdict
from equipoise.procedure.balancing.balance import BalanceOptions, balance
from equipoise.procedure.balancing.hold_moves import nearest_offset, next_goal, significant_com
from equipoise.procedure.balancing.hold_posterior import (
    COM_WALK,
    ahead,
    before_moving,
    moved_on,
    standing,
)
from equipoise.procedure.balancing.hold_verdict import Measured, verdict_on
from equipoise.procedure.steps.joint_fit import DRIFT, Knowledge
from equipoise.procedure.steps.planned_move import planned_move
from equipoise.procedure.steps.sampler import last_row
from equipoise.procedure.steps.tilt_guard import tilted
from equipoise.procedure.steps.tilt_prediction import state_now
from equipoise.procedure.steps.verify import Aim, at

MEASUREMENT = 5.0  # s between decisions
SOON = 0.4  # s, chosen: before the first, as balancing leaves it anywhere within tolerance
CLOSENESS = 0.4  # of the tolerance, chosen: for what is uncertain after balancing; it stays
FIRST_MOVES, FIRST_TIME = 10, 600.0  # s, chosen: allowed to the balancing before a hold
WARMING = 1e-8  # m/s, chosen: one sd of what a drift may be other than before the hold
DRIFT_WALK = 5e-10  # m/s/sqrt(s), chosen: by 1.3 um/min within half an hour


@dataclass(frozen=True, slots=True, eq=False)
class HoldOptions(Aim):
    """The aim, and for how long."""

    tolerance: Vector3 = field(default_factory=lambda: np.full(3, 3 * UM))  # m
    duration: float = field(kw_only=True)  # s

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


def balance_and_hold(
    bench: Bench, balancing: BalanceOptions, holding: HoldOptions
) -> Iterator[Step]:
    """Yield the Steps of balancing and then of holding.

    Not of holding when balancing ended in a stop for tilt or with an estimate that cannot be used;
    a verdict missed by a little holding can mend.
    """
    began = bench.time
    knowledge = yield from balance(bench, balancing)
    tilted_out = tilted(knowledge.recording, bench.testbed, began)
    if knowledge.estimate.outcome.usable and not tilted_out:
        yield from hold(bench, knowledge, holding)


def first_posterior(knowledge: Knowledge, testbed: Testbed) -> tracker.State:
    """Return the tracker's prior: the estimate at the end of the record of balancing."""
    q, rate = state_now(knowledge, testbed)
    shift = shift_by(testbed, knowledge.displacement)
    t = float(knowledge.fitted.problem.line.t[-1])
    inertia_P = knowledge.fitted.point.body(testbed.body.mass).inertia_P
    estimate, known = knowledge.estimate, (*knowledge.standing, *INERTIA)
    posterior = tracker.Posterior(knowledge.com - shift, inertia_P, estimate.covariance_of(known),
                                  warmth_of(estimate, known))  # fmt: skip
    state = tracker.first_state(t, q, testbed, posterior)
    drift, covariance = np.zeros(3), state.covariance.copy()
    if estimate.has(DRIFT[0]):
        drift, every = estimate.values(DRIFT), np.ix_(DRIFTING, DRIFTING)
        covariance[every] = estimate.covariance_of((*known, *DRIFT))
    for k in DRIFTING[-3:]:
        covariance[k, k] += WARMING**2
    heat = heat_of(None, knowledge.recording)
    return replace(state, rate=rate, drift=drift, covariance=covariance, heat=heat)


def hold(bench: Bench, knowledge: Knowledge, options: HoldOptions) -> Iterator[Step]:
    """Yield a move whenever one is made, and a verdict at the end."""
    testbed, began = bench.testbed, bench.time
    end = began + options.duration
    params = params_for(knowledge)
    state, displacement = first_posterior(knowledge, testbed), knowledge.displacement
    course, wait = [standing(state, testbed, displacement)], SOON
    while bench.time < end - 1e-9:
        fresh, wait = bench.read(min(wait, end - bench.time)), MEASUREMENT
        state = tracker.track(fresh, testbed, params, state).end
        displacement = last_row(fresh.masses, displacement)
        now = standing(state, testbed, displacement)
        later = ahead(now, state, min(MEASUREMENT, end - bench.time))
        course += [now, later]
        com = significant_com(later, options)
        why = reason_to_stop(fresh, com, displacement, testbed, options)
        if why is not None:
            bench.stop()
            yield stop_step(bench, now, why, bench.time - began)
            return
        goal = next_goal(state, com, displacement, testbed, options)
        if goal is not None:
            posterior = before_moving(state, testbed, displacement, goal)
            move = planned_move(testbed, displacement, goal, posterior, MoveReason.DRIFT)
            bench.move(move.targets)
            course[-1] = moved_on(move, now, later)
            why = one_reason(move.reason, **axes_of("was", now.com), travel=move.travel)
            yield Step("move", bench.time, why, fresh, move=move)
    judged = verdict_on(course, options, options.duration)
    yield Step("verify", bench.time, judged.reasons, verdict=judged)


def params_for(knowledge: Knowledge) -> tracker.Params:
    """Return the tracker's options: its state has the drift."""
    torque = knowledge.fitted.point.torque
    return tracker.Params(torque=torque, com_walk=COM_WALK, drift_walk=DRIFT_WALK)


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
