"""Planar feedback by masses and coils, then free swings for the height, in turn (Bologna).

    hang      the masses go down, so that the platform is a pendulum whatever r_z is
    measure   free swing, least squares for r and one moment of J, another held
    level     masses level the platform by that estimate, at a good moment (``move_timing``): a
              platform let go from level is back there at rest once in every swing
    calm      masses integrate the tilt away, coils damp (``planar_feedback``): a swing carried up
              to where the platform is softer would grow
    rise      up to FLOOR, where coils are strong against gravity, and KICK off level
    ...       measure, level and calm again, and again from a new kick while the sd of r is above
              ENOUGH
    end       from where feedback levelled it, up to the target

The first measurement takes the present swing. After one that shows nothing, feedback and a kick
precede the next. The shift between the two depths is known and removes the factor that r shares
with J (``swing_estimates``).

(Bahu and Modenini 2020; the note of 2022 for coils. They fit J and r_z under constraints that were
not accessible. Here the part of J that a small swing does not determine is held, and the least
squares are corrected for noise: constrained ones were 0.4 % further off and often not usable.)
"""

from dataclasses import dataclass, replace
from typing import Literal

import numpy as np

from equipoise.control.elements import planar_feedback as feedback
from equipoise.control.elements.slew import moment_across
from equipoise.control.law import Law, Sample
from equipoise.control.plant import move_timing
from equipoise.control.plant import swing_estimates as swings
from equipoise.control.plant.actuator_limits import fastest_slew
from equipoise.control.plant.move_timing import Waiting
from equipoise.control.plant.settling import UNREPORTED, Stand, standing
from equipoise.maths.attitude import level, to_matrix
from equipoise.maths.linalg import cross
from equipoise.model.arrays import Vector3
from equipoise.model.command import Command, Measurement
from equipoise.model.errors import InputError
from equipoise.model.estimate import Estimate
from equipoise.model.law_card import LawCard
from equipoise.model.reasons.law_reasons import LawReason
from equipoise.model.reasons.reason import one_reason
from equipoise.model.testbed import Testbed
from equipoise.model.units import UM

Phase = Literal["hang", "feedback", "kick", "level", "calm", "end"]

PERIOD = 0.2  # s
SWING = 60.0  # s of a measurement
FLOOR = 30e-6  # m, chosen: as shallow as a swing of 60 s still shows, a period of 50 s
KICK = float(np.radians(4))  # rad, chosen: well above what drafts do
LEVEL = float(np.radians(0.5))  # rad, chosen: lean and swing at which the feedback has done
CALM = float(np.radians(1.5))  # rad, chosen: the same before it rises to where coils are stronger
UNREST = 0.1  # rad, chosen: the first value of running means
MEAN = 10.0  # s, chosen: over which these are judged
LONGEST = 600.0  # s, chosen: feedback is left after that in any case
ENOUGH = 1e-6  # m, chosen: one sd of r, a third of a usual tolerance
MOST = 3  # measurements, chosen
MISSES = 3  # measurements that show nothing, chosen
ARRIVED = 0.5  # s, chosen: masses that stand so long have arrived
LAG = 2.0  # s of travel, chosen: masses that are further behind get no new request
FAST = 0.5  # chosen: of the masses' speed, the most that feedback at ten degrees may request
TEN_DEGREES = float(np.radians(10))


@dataclass(frozen=True, slots=True, eq=False)
class Params:
    """The constants of a run."""

    plant: feedback.Plant
    up: Vector3
    target: Vector3  # m
    depth: float  # m, of the first swing
    speed: float  # m/s, of the shift
    held: tuple[str, ...]  # what measurements do not estimate
    inertia_sd: float  # -, relative


@dataclass(frozen=True, slots=True, eq=False)
class State:
    """The progress of the law."""

    phase: Phase
    shift: Vector3  # m, requested
    loop: feedback.Loop
    since: float | None = None  # s, when the phase began
    lean: float = UNREST  # rad, running mean of the tilt
    swing: float = UNREST  # rad, running mean of |w across the vertical| / w_n
    stand: Stand = UNREPORTED
    t: float = 0.0
    measurements: tuple[swings.Shown, ...] = ()
    failed: int = 0  # measurements that showed nothing
    waiting: Waiting | None = None  # to level the platform
    flat: Vector3 | None = None  # m, the shift before the last kick
    goal: Vector3 | None = None  # m, the shift to end with


def begin(testbed: Testbed, target: Vector3) -> tuple[State, Params]:
    """Return the beginning; InputError where masses are too slow for the feedback."""
    up = testbed.up
    J = moment_across(testbed.body.inertia_P, up)
    (depth, hang), speed = swings.hanging_shift(testbed, 2 * FLOOR), fastest_slew(testbed)
    plant = feedback.Plant(J, testbed.weight, coils_of(testbed))
    params = Params(plant, up, target, depth, speed, swings.held(testbed), testbed.inertia_sd)
    loop = feedback.loop_for(plant, depth)
    if plant.coils == 0 or loop.integral * TEN_DEGREES > FAST * speed:
        raise InputError("planar_magnetic", f"masses that shift by {speed / UM:.3g} um/s and "
                         f"coils that give {plant.coils:.3g} N m", "coils, a known field, and "
                         f"{loop.integral * TEN_DEGREES / FAST / UM:.3g} um/s")  # fmt: skip
    return State("hang", -hang * up, loop), params


def coils_of(testbed: Testbed) -> float:
    """Return the torque (N m) that coils along all axes give across the field; else zero."""
    coils, field_N = testbed.magnetorquers, testbed.field_N()
    axes = np.array([coil.axis for coil in coils]).reshape(-1, 3)
    if field_N is None or np.linalg.matrix_rank(axes) < 3:
        return 0.0
    return min(coil.max_dipole for coil in coils) * float(np.linalg.norm(field_N))


def watched(state: State, sample: Sample, params: Params) -> State:
    """Return the state with this sample in its running means."""
    began = state.since is not None
    n = sample.gravity / float(np.linalg.norm(sample.gravity))
    swing = float(np.linalg.norm(cross(sample.rate, n))) / state.loop.swing
    tilt = float(np.linalg.norm(feedback.lean(sample.gravity, params.up)))
    share = 1.0 - float(np.exp(-(sample.t - state.t) / MEAN)) if began else 0.0
    return replace(
        state,
        since=state.since if began else sample.t,
        lean=state.lean + share * (tilt - state.lean),
        swing=state.swing + share * (swing - state.swing),
        stand=standing(state.stand if began else UNREPORTED, sample),
        t=sample.t,
    )


def fed_back(state: State, sample: Sample, params: Params, dt: float) -> State:
    """Return the state with the masses commanded to follow the tilt, unless they are behind."""
    behind = float(np.linalg.norm(state.shift - sample.shift))
    if behind > LAG * params.speed:
        return state
    speed = feedback.creep(sample.gravity, params.up, state.swing, state.loop)
    return replace(state, shift=state.shift + dt * speed)


def into(state: State, phase: Phase, shift: Vector3) -> State:
    """Return the state at the beginning of a phase that requests a shift (m)."""
    since, stand = None if state.since is None else state.t, state.stand._replace(since=state.t)
    return replace(
        state, phase=phase, shift=shift, since=since, stand=stand, lean=UNREST, swing=UNREST
    )


def kicked(state: State, params: Params) -> State:
    """Return the state with the masses set to lean the platform, between its axes."""
    x, y = to_matrix(level(params.up))[:2]
    aside = np.tan(KICK) * state.loop.depth * (0.8 * x + 0.6 * y)
    return into(replace(state, flat=state.shift), "kick", state.shift + aside)


def has_arrived(state: State) -> bool:
    """Say whether the masses have stood for a while after this phase requested a shift."""
    return state.since is not None and state.t >= max(state.stand.since, state.since) + ARRIVED


def is_level(state: State, enough: float) -> bool:
    """Say whether the feedback has done enough (rad), or what it can."""
    assert state.since is not None
    return state.lean + state.swing < enough or state.t > state.since + LONGEST


def after_measurement(state: State, estimate: Estimate, params: Params) -> State:
    """Return the state after a measurement: to be levelled and calmed where it is."""
    state = replace(state, since=None)  # time has passed
    if not swings.shows(estimate):
        state = replace(state, failed=state.failed + 1)
        if state.flat is None:
            return into(state, "feedback", state.shift)
        back = Waiting(state.flat, state.loop.swing)
        return into(replace(state, waiting=back), "level", state.shift)
    measurements, up = (*state.measurements, swings.shown(estimate, state.shift)), params.up
    r, sd, _ = swings.combined(measurements, up, params.inertia_sd)
    depth = -float(up @ (r + state.shift))
    last = len(measurements) == MOST or (len(measurements) > 1 and bool(np.all(sd < ENOUGH)))
    loop = feedback.loop_for(params.plant, max(depth, FLOOR))
    goal = params.target - r if last else None
    waiting = Waiting(-depth * up - r, loop.swing)
    state = replace(state, measurements=measurements, loop=loop, goal=goal, waiting=waiting)
    return into(state, "level", state.shift)


def levelled(state: State, sample: Sample, params: Params) -> State:
    """Return the state that waits for the moment to level the platform, or does it."""
    assert state.waiting is not None
    waiting, shift = move_timing.watched(state.waiting, sample, params.up, state.shift)
    if all(waiting.done):
        return into(replace(state, waiting=None), "calm", shift)
    return replace(state, waiting=waiting, shift=shift)


def after_calm(state: State, params: Params) -> State:
    """Return the state on its way up: to FLOOR, kicked, or to the end."""
    if state.goal is not None:
        # Level: sideways it is where feedback brought it, and masses that stand there do not err.
        aside = params.target - (params.target @ params.up) * params.up
        rise = float(params.up @ (state.goal - state.shift))
        return into(state, "end", state.shift + aside + rise * params.up)
    loop = feedback.loop_for(params.plant, FLOOR)
    r = swings.combined(state.measurements, params.up, params.inertia_sd).com
    return kicked(replace(state, loop=loop, shift=-FLOOR * params.up - r), params)


def next_of(state: State, params: Params) -> State:
    """Return the state in the next phase, where one has ended."""
    if state.phase == "hang" and has_arrived(state):
        return into(state, "kick", state.shift)
    if state.phase == "feedback" and is_level(state, LEVEL):
        return kicked(state, params)
    if state.phase == "calm" and is_level(state, LEVEL if state.goal is not None else CALM):
        return after_calm(state, params)
    return state


def requested(state: State, sample: Sample, params: Params) -> Command:
    """Return the command of a phase."""
    if state.phase == "kick":
        measurement = Measurement(SWING, swings.METHOD, params.held) if has_arrived(state) else None
        return Command(shift=state.shift, measurement=measurement)
    done = state.phase == "end" and has_arrived(state)
    why = one_reason(LawReason.LEVEL_AT_HEIGHT, swings=len(state.measurements)) if done else ()
    coils = feedback.damping_torque(sample.rate, state.loop)
    return Command(shift=state.shift, magnetic=coils, finished=why)


def step(state: State, sample: Sample | Estimate, params: Params) -> tuple[State, Command]:
    """Return the next state and the command."""
    if isinstance(sample, Estimate):
        state = after_measurement(state, sample, params)
        lost = swings.why_not_shown(sample) if state.failed == MISSES else ()
        return state, Command(shift=state.shift, finished=lost)
    dt = sample.t - state.t if state.since is not None else 0.0
    state = watched(state, sample, params)
    if state.phase in ("feedback", "calm"):
        state = fed_back(state, sample, params, dt)
    if state.phase == "level":
        state = levelled(state, sample, params)
        return state, Command(shift=state.shift)
    state = next_of(state, params)
    return state, requested(state, sample, params)


LAW = Law(
    LawCard(
        "planar_magnetic",
        ("Masses integrate the tilt to zero while coils damp; free swings determine the height."),
        "Bahu and Modenini 2020 and their note of 2022, from their abstracts",
        ("masses", "magnetorquers", "attitude", "gyro"),
        (
            "the height, to 1 um by a swing of one minute; sideways 0.1 to 0.3 um; sag "
            "beyond small tilts. Coils give no torque about the field"
        ),
        (
            "hanging; the integral pauses during swings that the coils cannot hold. Weak "
            "coils make it slow: 7 to 16 min with 0.25 mN m at 14 kg, 11 to more than 20 "
            "min with 0.06 mN m"
        ),
        PERIOD,
    ),
    begin,
    step,
)
