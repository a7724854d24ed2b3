"""Hold: keep the centre of mass at its target, while the platform warms up and drifts.

The tracker starts from the estimate of balancing, inertia and its uncertainty included; the masses
follow whenever one of their steps brings the centre of mass closer.

It is judged at every measurement by the tracker's posterior: held is what is within tolerance for
sure each time (``model.criterion.jointly``).
"""

from collections.abc import Iterator
from dataclasses import dataclass, field, replace

import numpy as np

from equipoise.actuators.sliding_masses import displacements_for, shift_by
from equipoise.estimation.tracker import tracker
from equipoise.estimation.tracker.predict_correct import COM
from equipoise.estimation.tracker.warmth import heat_of, warmth_of
from equipoise.maths.attitude import to_matrix
from equipoise.model.arrays import Floats, Matrix3, Vector3
from equipoise.model.bench import Bench
from equipoise.model.estimate import INERTIA
from equipoise.model.reasons.reason import axes_of, one_reason
from equipoise.model.reasons.step_reasons import MoveReason
from equipoise.model.reasons.verdict_reasons import VerdictReason
from equipoise.model.step import Step
from equipoise.model.testbed import Testbed
from equipoise.model.units import UM
from equipoise.model.verdict import Verdict
from equipoise.procedure.balancing.balance import BalanceOptions, balance
from equipoise.procedure.balancing.hold_verdict import Measured, verdict_on
from equipoise.procedure.steps.joint_fit import Knowledge
from equipoise.procedure.steps.planned_move import planned_move, stops_covariance
from equipoise.procedure.steps.sampler import last_row
from equipoise.procedure.steps.tilt_guard import tilted
from equipoise.procedure.steps.tilt_prediction import state_now
from equipoise.procedure.steps.verify import Aim

MEASUREMENT = 5.0  # s between decisions
FINER = 1 / 3  # of the tolerance, chosen: how closely to balance first
FIRST_MOVES, FIRST_TIME = 10, 600.0  # s, chosen: allowed to the balancing before a hold
ACT = 0.25  # of the tolerance, chosen: an offset from which a move is considered
PRESSING = 0.6  # of the tolerance: an offset that is not kept waiting
WIDE = 0.6  # of the tilt limit: a swing that corrections should calm
GAIN = 0.1  # of the tolerance: the least improvement of the worst axis by a move


@dataclass(frozen=True, slots=True, eq=False)
class HoldOptions(Aim):
    """The aim, and for how long."""

    tolerance: Vector3 = field(default_factory=lambda: np.full(3, 3 * UM))  # m
    duration: float = field(kw_only=True)  # s

    @property
    def balancing(self) -> BalanceOptions:
        """Return the options of the balancing before the hold.

        An inertia wrong by 1 % is a height wrong by 1 um at 100 um, for as long as the hold lasts:
        so there are moves to estimate it by, and tolerance is left for drift between the moves.
        """
        tolerance = FINER * self.tolerance
        return BalanceOptions(self.target, tolerance, FIRST_MOVES, FIRST_TIME, budget=self.budget)


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
    covariance = knowledge.estimate.covariance_of((*knowledge.standing, *INERTIA))
    warmth = warmth_of(knowledge.estimate, (*knowledge.standing, *INERTIA))
    posterior = tracker.Posterior(knowledge.com - shift, inertia_P, covariance, warmth)
    first = tracker.first_state(t, q, testbed, posterior)
    return replace(first, rate=rate, heat=heat_of(None, knowledge.recording))


def standing(state: tracker.State, testbed: Testbed, displacement: Floats) -> Measured:
    """Return the posterior of the centre of mass with the masses as they stand."""
    return Measured(state.com + shift_by(testbed, displacement), state.covariance[COM, COM])


def before_moving(
    state: tracker.State, testbed: Testbed, displacement: Floats, goal: Floats
) -> tuple[Vector3, Matrix3]:
    """Return the centre of mass (m, m^2) less the stops' errors of masses about to move to a goal.

    The tracker does not estimate single stops, so only their accuracy is known.
    """
    now = standing(state, testbed, displacement)
    leaving = (goal != displacement) & (displacement != 0)  # at home a mass has no error
    return now.com, now.covariance + stops_covariance(testbed, leaving)


def correction(
    com: Vector3, displacement: Floats, testbed: Testbed, options: HoldOptions
) -> Floats | None:
    """Return displacements (m) that bring the centre of mass closer, or None."""
    now = np.abs(com - options.target) / options.tolerance
    if now.max() < ACT:
        return None
    masses, total = testbed.masses, testbed.body.mass
    goal = displacements_for(masses, total, displacement, options.target - com)
    change = shift_by(testbed, goal - displacement)
    then = np.abs(com + change - options.target) / options.tolerance
    return goal if then.max() < now.max() - GAIN else None


def swing_amplitude(state: tracker.State, com: Vector3, testbed: Testbed) -> float:
    """Return the tilt (rad) that the present swing reaches: all its energy as height.

    1/2 w.J w (w across the vertical) + m g (R r).z = -m g |r| cos(amplitude)
    """
    R = to_matrix(state.q)
    across = state.rate - (state.rate @ R[2]) * R[2]
    weight = testbed.weight * float(np.linalg.norm(com))
    height = testbed.weight * float((R @ com)[2])
    energy = 0.5 * float(across @ state.inertia_P @ across) + height
    return float(np.arccos(np.clip(-energy / weight, -1.0, 1.0)))


def calming(state: tracker.State, shift: Vector3, testbed: Testbed) -> bool:
    """Say whether a shift d of the centre of mass (m) takes energy out of the swing now.

    At attitude R it adds m g (R d)_z, less what it moves the whole swing up or down: m g d.up.
    """
    return float((to_matrix(state.q) @ shift)[2]) <= float(shift @ testbed.up)


def timely(state: tracker.State, com: Vector3, shift: Vector3, testbed: Testbed) -> bool:
    """Say whether to make a correction now.

    Corrections at any moment would pump an undamped platform; once it swings far, only those that
    calm it are made, and soon there is one.
    """
    wide = swing_amplitude(state, com, testbed) > WIDE * testbed.tilt_limit
    return not wide or calming(state, shift, testbed)


def hold(bench: Bench, knowledge: Knowledge, options: HoldOptions) -> Iterator[Step]:
    """Yield a move whenever one is made, and a verdict at the end."""
    testbed, end = bench.testbed, bench.time + options.duration
    params = tracker.Params(torque=knowledge.fitted.point.torque)
    state, displacement = first_posterior(knowledge, testbed), knowledge.displacement
    course = [standing(state, testbed, displacement)]
    while bench.time < end - 1e-9:
        fresh = bench.read(min(MEASUREMENT, end - bench.time))
        state = tracker.track(fresh, testbed, params, state).end
        displacement = last_row(fresh.masses, displacement)
        course.append(standing(state, testbed, displacement))
        com = course[-1].com
        if tilted(fresh, testbed):
            bench.stop()
            yield stop_step(bench, course[-1])
            return
        goal = correction(com, displacement, testbed, options)
        if goal is None:
            continue
        shift = shift_by(testbed, goal - displacement)
        pressing = np.any(np.abs(com - options.target) > PRESSING * options.tolerance)
        if pressing or timely(state, com, shift, testbed):
            posterior = before_moving(state, testbed, displacement, goal)
            move = planned_move(testbed, displacement, goal, posterior, MoveReason.DRIFT)
            bench.move(move.targets)
            why = one_reason(move.reason, **axes_of("was", com), travel=move.travel)
            yield Step("move", bench.time, why, fresh, move=move)
    judged = verdict_on(course, options, options.duration)
    yield Step("verify", bench.time, judged.reasons, verdict=judged)


def stop_step(bench: Bench, last: Measured) -> Step:
    """Return the stop of a hold whose platform tilts too much."""
    verdict = Verdict(one_reason(VerdictReason.TILTED), last.com, last.sd)
    return Step("stop", bench.time, verdict.reasons, verdict=verdict)
