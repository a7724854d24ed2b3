"""Coarse, then fine, by free swings alone (RAMBO).

    hang      masses go down until the platform hangs whatever its height is
    coarse    a short look; a move sideways that levels the platform, at a good moment, and
              one up to COARSE below the pivot
    fine      looks and moves to the target, until one finds it within SURE sds, at most MOST

Between coarse and fine the known way frees r of the factor that it shares with J
(``swing_estimates``).
The target is never higher than SAFE below the pivot: what is left of balance keeps the platform
upright when the law has gone.

Nothing damps a swing, but the move sideways is made at the moment that leaves least of it
(``good_moment``). The way up is slow against a swing, which then grows as depth^-1/4, by a half
from 250 um to 50 um.

(RAMBO, engrXiv 7342: coarse active stage, fine free-response least squares, negative vertical
offset. Its coarse stage is a feedback by wheels, and not read in detail; where there are wheels,
``momentum_buildup`` does that. Here the coarse stage is a look like the fine ones.)
"""

from dataclasses import dataclass, replace

import numpy as np

from equipoise.control.elements.slew import moment_across
from equipoise.control.law import Law, Sample
from equipoise.control.plant import move_timing
from equipoise.control.plant.move_timing import Waiting
from equipoise.control.plant.swing_estimates import METHOD, Shown, combined, held, shown, shows
from equipoise.model.arrays import Vector3
from equipoise.model.command import Command, Measurement
from equipoise.model.errors import InputError
from equipoise.model.estimate import Estimate
from equipoise.model.law_card import LawCard
from equipoise.model.reasons.law_reasons import LawReason
from equipoise.model.reasons.reason import Reason, one_reason
from equipoise.model.testbed import Testbed

PERIOD = 0.5  # s
SHORT, LONG = 30.0, 60.0  # s, chosen: a coarse look of three periods, a fine one of one
COARSE = 50e-6  # m below the pivot, chosen: a period of 40 s on a table of 14 kg
SAFE = 10e-6  # m below the pivot, chosen: 1.4 mN m at 14 kg bring it upright again
STEEP = 6.0  # chosen: of the sideways sd, so that the platform leans by ten degrees at most
UNSURE = 2.0  # sds of the height that must still hang
SURE = 2.0  # sds, chosen: what a look is believed to
ENOUGH = 0.5e-6  # m, chosen: one sd at which there is no need to look again
SMALL = 0.1e-6  # m, chosen: what drift undoes in a minute is not worth another look
MOST = 6  # looks, chosen
MISSES = 3  # looks in all that show nothing, chosen
ARRIVED = 1.0  # s, chosen: masses that stand so long have arrived
STANDS = 1e-10  # m


@dataclass(frozen=True, slots=True, eq=False)
class Params:
    """What is told."""

    up: Vector3
    target: Vector3  # m
    held: tuple[str, ...]  # elements of J that looks do not estimate
    stiffness: float  # 1/(m s^2), m g / J
    inertia_sd: float  # -, relative


@dataclass(frozen=True, slots=True, eq=False)
class State:
    """How far it has come."""

    shift: Vector3  # m, asked for
    observed_shift: Vector3 | None = None  # m, at the last sample
    stood: float = 0.0  # s, since when the masses stand
    measurements: tuple[Shown, ...] = ()
    missed: int = 0  # looks that showed nothing
    finished: tuple[Reason, ...] = ()
    waiting: Waiting | None = None
    rise: Vector3 | None = None  # m, the shift after the present one


def begin(testbed: Testbed, target: Vector3) -> tuple[State, Params]:
    """Return the beginning; InputError for a testbed without masses."""
    if not testbed.masses:
        raise InputError("coarse_fine", "a testbed without them", "sliding masses")
    up, sd = testbed.up, testbed.com_sd
    sideways = float(np.linalg.norm(sd - (sd @ up) * up))
    depth = max(STEEP * sideways, 2 * COARSE) + UNSURE * float(abs(sd @ up))
    low = min(float(target @ up), -SAFE)
    safe = target + (low - float(target @ up)) * up
    hang = depth + float(testbed.body.com @ up)
    J = moment_across(testbed.body.inertia_P, up)
    stiffness = testbed.body.mass * testbed.gravity / J
    return State(-hang * up), Params(up, safe, held(testbed), stiffness, testbed.inertia_sd)


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
        return replace(state, shift=shift, waiting=None, stood=sample.t)
    return replace(state, waiting=waiting, shift=shift)


def after_measurement(state: State, estimate: Estimate, params: Params) -> State:
    """Return the state after a look, with the move that it asks for."""
    state = replace(state, observed_shift=None)  # the clock has gone on
    if not shows(estimate):
        why = (*one_reason(LawReason.COM_NOT_SHOWN), *estimate.outcome.reasons)
        missed = state.missed + 1
        return replace(state, missed=missed, finished=why if missed == MISSES else ())
    measurements = (*state.measurements, shown(estimate, state.shift))
    r, sd, _ = combined(measurements, params.up, params.inertia_sd)
    if len(measurements) == 1:
        return levelling(replace(state, measurements=measurements), r, params)
    off: Vector3 = r + state.shift - params.target
    there = bool(np.all(np.abs(off) < np.maximum(SURE * sd, SMALL)) and np.all(sd < ENOUGH))
    at_place = one_reason(LawReason.AT_PLACE, swings=len(measurements))
    done = at_place if there or len(measurements) == MOST else ()
    return replace(state, measurements=measurements, shift=state.shift - off, finished=done)


def watched(state: State, sample: Sample) -> State:
    """Return the state that knows since when the masses stand."""
    before = state.observed_shift
    stands = before is not None and bool(np.linalg.norm(sample.shift - before) <= STANDS)
    return replace(state, observed_shift=sample.shift, stood=state.stood if stands else sample.t)


def step(state: State, sample: Sample | Estimate, params: Params) -> tuple[State, Command]:
    """Return the next state and the command: a move, and a look once the masses stand."""
    if isinstance(sample, Estimate):
        state = after_measurement(state, sample, params)
        return state, Command(shift=state.shift)
    state = watched(state, sample)
    if state.waiting is not None:
        state = waited(state, sample, params)
        return state, Command(shift=state.shift)
    if sample.t < state.stood + ARRIVED:
        return state, Command(shift=state.shift)
    if state.rise is not None:
        state = replace(state, shift=state.rise, rise=None, stood=sample.t)
        return state, Command(shift=state.shift)
    if state.finished:
        return state, Command(shift=state.shift, finished=state.finished)
    measurement = Measurement(LONG if state.measurements else SHORT, METHOD, params.held)
    return state, Command(shift=state.shift, measurement=measurement)


LAW = Law(
    LawCard(
        "coarse_fine",
        "A coarse move from a first look, then looks and small moves, always kept hanging.",
        "RAMBO, engrXiv 7342, as far as its abstract tells",
        ("masses", "attitude", "gyro"),
        "10 um below the pivot at least, on purpose; 1 um of that, 0.1 um sideways, and 4 % of a "
        "lower target's depth; swing, as nothing damps it; sag but for small tilts",
        "open loop: always. It must hang within 10 deg of level at first: what swing there is "
        "grows by a half on the way up",
        PERIOD,
    ),
    begin,
    step,
)
