"""Coarse, then fine, by free swings alone (RAMBO).

    hang      masses go down until the platform hangs whatever its height is
    coarse    a short measurement; a move sideways that levels the platform, at a good moment,
              and one up to COARSE below the pivot
    fine      measurements and moves to the target, until one finds it within SURE sds, at most
              MOST of them

Between coarse and fine the known shift removes the factor that r shares with J
(``swing_estimates``).
The target is never higher than SAFE below the pivot: the remaining restoring torque keeps the
platform upright when the law has ended.

Nothing damps a swing, but the move sideways is made at the moment that leaves least of it
(``move_timing``). The way up is slow against a swing, which then grows as depth^-1/4, by a half
from 250 um to 50 um.

(RAMBO, engrXiv 7342: coarse active stage, fine free-response least squares, negative vertical
offset. Its coarse stage is a feedback by wheels, and not read in detail; where there are wheels,
``momentum_buildup`` does that. Here the coarse stage is a measurement like the fine ones.)
"""

from dataclasses import dataclass, replace

import numpy as np

from equipoise.control.elements.slew import moment_across
from equipoise.control.law import Law, Sample
from equipoise.control.plant import move_timing
from equipoise.control.plant import swing_estimates as swings
from equipoise.control.plant.move_timing import Waiting
from equipoise.control.plant.settling import UNREPORTED, Stand, standing
from equipoise.model.arrays import Vector3
from equipoise.model.command import Command, Measurement
from equipoise.model.errors import InputError
from equipoise.model.estimate import Estimate
from equipoise.model.law_card import LawCard
from equipoise.model.reasons.law_reasons import LawReason
from equipoise.model.reasons.reason import Reason, one_reason
from equipoise.model.testbed import Testbed

PERIOD = 0.5  # s
SHORT, LONG = 30.0, 60.0  # s, chosen: of three periods when coarse, of one when fine
COARSE = 50e-6  # m below the pivot, chosen: a period of 40 s on a table of 14 kg
SAFE = 10e-6  # m below the pivot, chosen: 1.4 mN m at 14 kg bring it upright again
SURE = 2.0  # sds, chosen: within which a measurement is trusted
ENOUGH = 0.5e-6  # m, chosen: one sd that needs no further measurement
SMALL = 0.1e-6  # m, chosen: what drift undoes in a minute needs no further measurement
MOST = 6  # measurements, chosen
MISSES = 3  # measurements in all that show nothing, chosen
ARRIVED = 1.0  # s, chosen: masses that stand so long have arrived


@dataclass(frozen=True, slots=True, eq=False)
class Params:
    """The constants of a run."""

    up: Vector3
    target: Vector3  # m
    held: tuple[str, ...]  # elements of J that measurements do not estimate
    stiffness: float  # 1/(m s^2), m g / J
    inertia_sd: float  # -, relative


@dataclass(frozen=True, slots=True, eq=False)
class State:
    """The progress of the law."""

    shift: Vector3  # m, requested
    stand: Stand = UNREPORTED
    measurements: tuple[swings.Shown, ...] = ()
    missed: int = 0  # measurements that showed nothing
    finished: tuple[Reason, ...] = ()
    waiting: Waiting | None = None
    rise: Vector3 | None = None  # m, the shift after the present one


def begin(testbed: Testbed, target: Vector3) -> tuple[State, Params]:
    """Return the beginning; InputError for a testbed without masses."""
    if not testbed.masses:
        raise InputError("coarse_fine", "a testbed without them", "sliding masses")
    up, hang = testbed.up, swings.hanging_shift(testbed, 2 * COARSE)[1]
    low = min(float(target @ up), -SAFE)
    safe = target + (low - float(target @ up)) * up
    J = moment_across(testbed.body.inertia_P, up)
    stiffness = testbed.weight / J
    return State(-hang * up), Params(up, safe, swings.held(testbed), stiffness, testbed.inertia_sd)


def levelling(state: State, r: Vector3, params: Params) -> State:
    """Return the state that waits to level the platform, and rises then."""
    depth = -float((r + state.shift) @ params.up)
    swing = (params.stiffness * max(depth, COARSE)) ** 0.5
    waiting = Waiting(-depth * params.up - r, swing)
    return replace(state, waiting=waiting, rise=-COARSE * params.up - r)


def waited(state: State, sample: Sample, params: Params) -> State:
    """Return the state that goes on waiting, or makes the move at a good moment."""
    assert state.waiting is not None
    waiting, shift = move_timing.watched(state.waiting, sample, params.up, state.shift)
    if all(waiting.done):
        return replace(state, shift=shift, waiting=None, stand=state.stand._replace(since=sample.t))
    return replace(state, waiting=waiting, shift=shift)


def after_measurement(state: State, estimate: Estimate, params: Params) -> State:
    """Return the state after a measurement, with the move that it requires."""
    state = replace(state, stand=UNREPORTED)  # time has passed
    if not swings.shows(estimate):
        missed = state.missed + 1
        why = swings.why_not_shown(estimate) if missed == MISSES else ()
        return replace(state, missed=missed, finished=why)
    measurements = (*state.measurements, swings.shown(estimate, state.shift))
    r, sd, _ = swings.combined(measurements, params.up, params.inertia_sd)
    if len(measurements) == 1:
        return levelling(replace(state, measurements=measurements), r, params)
    off: Vector3 = r + state.shift - params.target
    there = bool(np.all(np.abs(off) < np.maximum(SURE * sd, SMALL)) and np.all(sd < ENOUGH))
    at_place = one_reason(LawReason.AT_PLACE, swings=len(measurements))
    done = at_place if there or len(measurements) == MOST else ()
    return replace(state, measurements=measurements, shift=state.shift - off, finished=done)


def step(state: State, sample: Sample | Estimate, params: Params) -> tuple[State, Command]:
    """Return the next state and the command: a move, and a measurement once the masses stand."""
    if isinstance(sample, Estimate):
        state = after_measurement(state, sample, params)
        return state, Command(shift=state.shift)
    state = replace(state, stand=standing(state.stand, sample))
    if state.waiting is not None:
        state = waited(state, sample, params)
        return state, Command(shift=state.shift)
    if sample.t < state.stand.since + ARRIVED:
        return state, Command(shift=state.shift)
    if state.rise is not None:
        stand = state.stand._replace(since=sample.t)
        state = replace(state, shift=state.rise, rise=None, stand=stand)
        return state, Command(shift=state.shift)
    if state.finished:
        return state, Command(shift=state.shift, finished=state.finished)
    measurement = Measurement(LONG if state.measurements else SHORT, swings.METHOD, params.held)
    return state, Command(shift=state.shift, measurement=measurement)


LAW = Law(
    LawCard(
        "coarse_fine",
        (
            "A first measurement and a coarse move, then further measurements and small "
            "moves, always hanging."
        ),
        "RAMBO, engrXiv 7342, from its abstract",
        ("masses", "attitude", "gyro"),
        (
            "10 um below the pivot on purpose, and 1 um of height error; 0.1 um sideways; "
            "4 % of the depth of a lower target; swing, which nothing damps; sag beyond "
            "small tilts"
        ),
        (
            "open loop: always stable. The platform must hang within 10 deg of level at "
            "first: the swing grows by half while the centre of mass rises"
        ),
        PERIOD,
    ),
    begin,
    step,
)
