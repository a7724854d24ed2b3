"""Balance with masses alone in two steps, again and again (Chesi 2014; Bahu & Modenini 2020).

    follow   the tilt feedback levels the platform: across gravity it is balanced, nearly
    push     the masses go aside for a second, and back: the platform swings
    measure  masses still; the swing is recorded and the centre of mass estimated from it
    trim     the masses move along up by the height error of that estimate; then again from the
             start; the last time they level only, and the platform rests

The push moves the centre of mass by d for PUSH seconds, so that the platform turns at

    w = m g d PUSH / J = SWING tilt_limit / MEASURED

and gets at most about SWING of the way to its limit during the measurement. Before the first step
the centre of mass is lowered by twice its sd. The platform is then no inverted pendulum while the
masses hold still, and ends a measurement near where it began, or swings.

Every round restarts with the reported shift: rh(0) = -shift across up. Published rounds gain
from one another only by the smaller height; begun so, each leaves |r_up| / (|r_up| + X) of the
offset of the last one. Rounds end when the measurement finds no more than a motor step, or no gain.

Only the height of the estimate is used. The method is ``ukf_4`` (rate and r_up) when the prior sd
of com across up is ACROSS or less: it takes com across up from the testbed and ignores the shift of
the first step. Else it is ``trajectory`` with the testbed's inertia and its sd, which estimates all
of com. The record begins with the push: a known change, which determines the scale of J. A
remaining error of J makes r_up wrong by the same share, and the next round removes that but for the
share of the target's own depth.
"""

from dataclasses import dataclass, replace
from typing import Literal

import numpy as np

from equipoise.control.elements import tilt_feedback as feedback
from equipoise.control.law import Sample
from equipoise.control.plant import offset_bounds as offsets
from equipoise.control.plant.actuator_limits import greatest_shift, greatest_slew, limited
from equipoise.model.arrays import Vector3
from equipoise.model.command import Command, Measurement
from equipoise.model.errors import InputError
from equipoise.model.estimate import COM, Estimate
from equipoise.model.reasons.law_reasons import LawReason
from equipoise.model.reasons.reason import Reason, one_reason
from equipoise.model.reasons.step_reasons import StepReason
from equipoise.model.testbed import Testbed

PERIOD = 0.1  # s, chosen: a servo's beat
SETTLED = 8.0  # time constants, chosen: 3e-4 of the swing is left
PAY = 0.3  # chosen: of the masses' speed
MEAN = 1.0  # s, chosen: at the end of a follow, over which the rest is averaged
PUSH = 1.0  # s
BACK = 10.0  # s, chosen: masses that are not back by then stand still
MEASURED = 20.0  # s
SWING = 0.4  # of the tilt limit, chosen
ACROSS = 2e-6  # m, chosen: com_sd across up at which ukf_4 is used
LATE = 2.0  # motor steps, chosen: masses farther than that from where they should be are late
NEAR = 1e-6  # m, chosen: masses without steps are not late when they are as near as that
GAIN = 0.8  # chosen: a round that leaves more than that of the one before is no gain
LEAST = 1e-7  # m, chosen: what masses without steps may leave
ROUNDS = 6  # chosen

Phase = Literal["follow", "push", "back", "measurement"]


@dataclass(frozen=True, slots=True, eq=False)
class Params:
    """The constants of a run."""

    gains: feedback.Gains
    measurement: Measurement
    push: float  # m, by which the masses go aside
    follow: int  # steps until the platform rests
    tolerance: float  # m, what a motor step leaves
    late: float  # m, off the request: the masses are on their way
    pay: float  # m, of what is owed, in a step
    target: float  # m, along up
    tilt_at_stop: float  # rad
    rounds: int = ROUNDS


@dataclass(frozen=True, slots=True, eq=False)
class State:
    """The progress of the law."""

    held: Vector3  # m, rh; of a round that begins, the prior
    height: float  # m, shift along up
    gravity: Vector3 | None = None  # m/s^2, at the last step; None: a round begins
    owed: Vector3 | None = None  # m, what rh has yet to get for the tilt at which the round began
    phase: Phase = "follow"
    step: int = 0  # of the phase
    requested: Vector3 | None = None  # m, shift at the last step
    rest: Vector3 | None = None  # m, sum of shifts requested in the last second of a follow
    level: Vector3 | None = None  # sum of P_up g_b / g then
    since: float = 0.0  # s, when the push began
    rounds: int = 0  # measurements made
    left: float = np.inf  # m, the offset that the last measurement found
    ending: tuple[Reason, ...] = ()  # why this follow is the last


def method_for(testbed: Testbed) -> Measurement:
    """Return the measurement that this testbed allows; InputError if there is none."""
    spread = offsets.across(testbed.up) @ testbed.com_sd
    if testbed.attitude is None or testbed.gyro is None:
        raise InputError(testbed.name, "no gyro, or no attitude sensor", "both")
    if float(np.linalg.norm(spread)) <= ACROSS:
        return Measurement(MEASURED, "ukf_4")
    return Measurement(MEASURED, "trajectory", hold=testbed.in_group("drift"), use_prior=True)


def begin(testbed: Testbed, target: Vector3, integral: float) -> tuple[State, Params]:
    """Return state and parameters; ``integral`` is w_i over w_a."""
    up, quantum, reach = testbed.up, offsets.coarsest_step(testbed), greatest_shift(testbed)
    if float(np.linalg.norm(offsets.across(up) @ target)) > LEAST:
        raise InputError(
            "target", "a centre of mass off the up axis", "one on the up axis: masses settle there"
        )
    w = feedback.frequency_for(testbed, PERIOD)
    gains = feedback.gains_at(testbed, w, integral * w, PERIOD)
    slowest = feedback.settling(
        w, integral * w, min(feedback.swing_of(testbed, offsets.likely_height(testbed)), 0.0)
    )
    lower = float(up @ (target - testbed.body.com)) - offsets.LIKELY * offsets.height_sd(testbed)
    height = float(np.clip(lower, -reach, reach))
    params = Params(
        gains, method_for(testbed), push_for(testbed),
        int(np.ceil(SETTLED * slowest / PERIOD)), max(quantum, LEAST),
        max(LATE * quantum, NEAR), PAY * greatest_slew(testbed) * PERIOD, float(up @ target),
        testbed.tilt_at_stop,
    )  # fmt: skip
    return State(offsets.across(up) @ testbed.body.com, height), params


def push_for(testbed: Testbed) -> float:
    """Return how far (m) the centre of mass goes aside for a swing of the wanted size."""
    rate = SWING * testbed.tilt_limit / MEASURED
    wanted = rate * offsets.level_inertia(testbed) / (testbed.weight * PUSH)
    return min(wanted, greatest_slew(testbed) * PUSH)


def step(state: State, sample: Sample | Estimate, params: Params) -> tuple[State, Command]:
    """Return the next state and the command."""
    if isinstance(sample, Estimate):
        return trimmed(state, sample, params)
    cosine = -params.gains.up @ sample.gravity / params.gains.gravity
    if float(np.arccos(np.clip(cosine, -1.0, 1.0))) > params.tilt_at_stop:
        return state, Command(finished=one_reason(LawReason.TILTED))
    if state.phase == "follow":
        return follow(state, sample, params)
    return swing(state, sample, params)


def follow(state: State, sample: Sample, params: Params) -> tuple[State, Command]:
    """Level the platform; at the end, push it."""
    gains = params.gains
    held, owing = held_now(state, sample, params)
    upward = state.height * gains.up
    shift = feedback.shift_for(gains, held, sample.gravity, sample.rate) + upward
    paid = float(np.linalg.norm(owing)) < params.tolerance
    count = state.step + 1 if paid else 0
    state = replace(
        state, held=held, gravity=sample.gravity, owed=owing, requested=shift, step=count
    )
    if state.step > params.follow - round(MEAN / PERIOD):
        still = feedback.shift_for(gains, held, sample.gravity, np.zeros(3)) + upward
        tilt = offsets.across(gains.up) @ sample.gravity / gains.gravity
        state = replace(state, rest=added(state.rest, still), level=added(state.level, tilt))
    if state.step < params.follow:
        return state, Command(shift=shift)
    n = round(MEAN / PERIOD)
    assert state.rest is not None
    assert state.level is not None
    state = replace(state, rest=state.rest / n, level=state.level / n, phase="push", step=0,
                    since=sample.t)  # fmt: skip
    if state.ending:
        return state, Command(shift=state.rest, finished=state.ending)
    return state, Command(shift=state.rest, note=one_reason(LawReason.PUSH_BEGINS))


def held_now(state: State, sample: Sample, params: Params) -> tuple[Vector3, Vector3]:
    """Return rh (m), restarted at the first sample of a round, and what is still owed (m)."""
    if state.gravity is None or state.requested is None or state.owed is None:
        return state.held, feedback.owed(params.gains, sample.gravity)
    late = float(np.linalg.norm(state.requested - sample.shift)) > params.late
    held = feedback.followed(params.gains, state.held, state.gravity, sample.gravity, late)
    paid = limited(state.owed, params.pay)
    return held + paid, state.owed - paid


def added(total: Vector3 | None, vector: Vector3) -> Vector3:
    """Return the sum; None: nothing yet."""
    return vector if total is None else total + vector


def swing(state: State, sample: Sample, params: Params) -> tuple[State, Command]:
    """Push, come back, and measure."""
    assert state.rest is not None
    count = state.step + 1
    if state.phase == "push":
        aside = offsets.around(params.gains.up)[state.rounds % 2]
        ends = count >= round(PUSH / PERIOD)
        state = replace(state, phase="back" if ends else "push", step=0 if ends else count)
        return state, Command(shift=state.rest + params.push * aside)
    arrived = float(np.linalg.norm(sample.shift - state.rest)) <= params.late
    if count == 1 or (not arrived and count < round(BACK / PERIOD)):
        return replace(state, step=count), Command(shift=state.rest)
    return replace(state, phase="measurement", rest=sample.shift), Command(
        measurement=replace(params.measurement, since=state.since)
    )


def trimmed(state: State, estimate: Estimate, params: Params) -> tuple[State, Command]:
    """Move along up by the height error that was measured, or finish."""
    assert state.rest is not None
    assert state.level is not None
    rounds = state.rounds + 1
    if not estimate.outcome.usable:
        again = replace(state, rounds=rounds, phase="push", step=0)
        why = (*one_reason(LawReason.ESTIMATE_UNUSABLE), *estimate.outcome.reasons)
        over = why if rounds >= params.rounds else ()
        return again, Command(shift=state.rest, finished=over, note=why)
    above = height_in(estimate, params.gains.up) + float(params.gains.up @ state.rest)
    missing = params.target - above
    sideways = abs(above) * float(np.linalg.norm(state.level))
    left = float(np.hypot(missing, sideways))
    numbers = {"rounds": rounds, "missing": missing, "across": sideways}
    found = one_reason(LawReason.HEIGHT_MISSING, **numbers)
    over = why_over(left, replace(state, rounds=rounds), params)
    up = params.gains.up
    ending = (*found, *over, *one_reason(LawReason.LEVEL_AGAIN)) if over else ()
    held, height = -offsets.across(up) @ state.rest, float(up @ state.rest) + missing
    onward = State(held, height, rounds=rounds, left=left, ending=ending)
    return onward, Command(shift=state.rest + missing * up, note=() if over else found)


def height_in(estimate: Estimate, up: Vector3) -> float:
    """Return the centre of mass along up (m), masses at home; some methods estimate no more."""
    if all(estimate.has(name) for name in COM):
        return float(up @ estimate.com)
    k = int(np.argmax(np.abs(up)))
    if estimate.has(COM[k]):
        return float(np.sign(up[k]) * estimate.values((COM[k],))[0])
    return float(estimate.values(("com_up",))[0])


def why_over(left: float, state: State, params: Params) -> tuple[Reason, ...]:
    """Return why no further round is made, or nothing."""
    if left <= params.tolerance:
        return one_reason(LawReason.MOTOR_STEP_OR_LESS)
    if left > GAIN * state.left:
        return one_reason(LawReason.NOTHING_GAINED)
    return one_reason(StepReason.ROUNDS_USED_UP) if state.rounds >= params.rounds else ()
