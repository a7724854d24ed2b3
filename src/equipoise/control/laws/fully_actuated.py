"""Balance with masses while wheels or gyros hold a momentum trajectory.

(Kim & Agrawal 2009; da Silva 2021 section 4.2, Eq. 42 with erratum R24: [g_b x] and not [w x].)
The law of momentum, h stored in wheels or gyros, s the shift by masses:

    (J w)' = -w x (J w + h) - h' + m (r + s) x g_b

Published with one H_s for all momentum. But momentum that passes between platform and wheels does
not change their sum: it is J w alone that -h' can steer, and J w + h that turns with the body. So,
with e = J w - H_d,

    -h' = w x (J w + h) - K e + H_d'                     the requested torque, K > 0
    s'  = Gamma m [g_b x]^T e = -Gamma m g_b x e
    e'  = -K e - m [g_b x] (r + s)
    V   = |e|^2 / 2 + |r + s|^2 / (2 Gamma),             V' = -K |e|^2

e and r + s are a filter of frequency w_a: Gamma = (w_a / (m g))^2, K = 2 zeta w_a. For J = jE
and H_d = 0, s = s(0) - Gamma m j (g_b - g_b(0)): a function of the tilt, and no balance. The steps
keep that identity exactly, as s takes j times the measured increment of g_b, j being a third of
tr J, and the trapezoid rule of the rest.

The part along gravity is unobservable. With H_d = 0 the platform may come to rest with r + s along
g_b, its momentum constant and the platform unbalanced. H_d therefore leads gravity round a cone
(``sweep``), chosen by how soon an offset fades on it (``cone_plan``). Terms that turn with the cone
are computed for the middle of the period for which the torque is held. The rate is a mean of the
gyro's rows since the last sample, so it is older than the attitude by ``late``; on the cone it has
changed since by w_d' late. Left out, that is K late of the inertia, and a height like a wrong J's.

Masses have come to rest when their way in a turn of the cone shows that less than NEAR is left
(``cone_turns``), in two turns. The law gives up after LONG times as long as that should take. They
then go to their mean of the last turn, and the platform goes back to level. Last of all they shift
by the target r*, which needs no torque of the devices before that.

Anti-windup: s does not come to lead the reported shift by more than ``lead``, and does not change
while the measured torque differs from the requested one.
"""

from dataclasses import dataclass, replace

import numpy as np

from equipoise.control.elements.cone_plan import (
    HOLD,
    LEVELLED,
    NEAR,
    ZETA,
    Cone,
    cone_for,
    height_of_inertia,
)
from equipoise.control.elements.cone_turns import Turns, counted, first_turn, swept
from equipoise.control.elements.sweep import Sweep, Wanted, wanted
from equipoise.control.law import Law, Sample
from equipoise.control.plant import offset_bounds as offsets
from equipoise.control.plant.actuator_limits import greatest_slew, limited
from equipoise.control.plant.rate_age import rate_age
from equipoise.control.plant.wheel_capacity import capacity
from equipoise.maths.linalg import cross
from equipoise.model.arrays import Matrix3, Vector3
from equipoise.model.command import Command
from equipoise.model.estimate import Estimate
from equipoise.model.law_card import LawCard
from equipoise.model.reasons.law_reasons import LawReason
from equipoise.model.reasons.reason import Reason, axes_of, one_reason
from equipoise.model.testbed import Testbed

PERIOD = 0.1  # s, chosen: a servo's beat
LEAD = 3.0  # periods of travel, chosen: by which masses may be behind
SHORT = 0.1  # of the devices' torque, chosen: a greater difference counts as another torque
OPENED = 2  # turns, chosen: after which the cone is nine tenths open
LONG = 3.0  # chosen: of the time that it should take
WAIT = 6.0  # time constants of the way back to level, chosen
QUIET = 30.0  # time constants, chosen: after which a law that sweeps nothing has ended


@dataclass(frozen=True, slots=True, eq=False)
class Params:
    """The constants of a run."""

    mass: float  # kg
    inertia: Matrix3  # kg m^2
    target: Vector3  # m, r*
    adaption: float  # s^2 kg^-2 m^-2, Gamma
    gain: float  # 1/s, K
    sweep: Sweep
    cone: Cone
    height: float  # m, what one sd of the inertia leaves along up
    late: float  # s, by which rates are older than attitudes
    lead: float  # m
    short: float  # N m
    tilt_at_stop: float  # rad
    period: float  # s


@dataclass(frozen=True, slots=True, eq=False)
class State:
    """The progress of the law."""

    shift: Vector3  # m, s
    turns: Turns
    start: float | None = None  # s
    gravity: Vector3 | None = None  # m/s^2, at the last step
    rest: Vector3 | None = None  # N m s, e - j w at the last step
    torque: Vector3 | None = None  # N m, requested at the last step
    over: tuple[Reason, ...] = ()  # why masses have come to rest
    since: float = 0.0  # s, of that


def begin(testbed: Testbed, target: Vector3) -> tuple[State, Params]:
    """Return state and parameters; InputError where the loop would not be stable."""
    m, g = testbed.body.mass, testbed.gravity
    cone = cone_for(testbed, PERIOD)
    w = cone.frequency
    axes = np.column_stack([*offsets.around(testbed.up), testbed.up])
    params = Params(
        m, testbed.body.inertia_P, target, (w / (m * g)) ** 2, 2 * ZETA * w,
        Sweep(axes, cone.angle, cone.speed, HOLD * w), cone,
        height_of_inertia(testbed, cone.speed), rate_age(testbed, PERIOD),
        LEAD * greatest_slew(testbed) * PERIOD + offsets.coarsest_step(testbed),
        SHORT * capacity(testbed).torque, testbed.tilt_at_stop, PERIOD,
    )  # fmt: skip
    turns = first_turn(float(np.linalg.norm(testbed.com_sd)))
    return State(-testbed.body.com, turns), params


def expected(params: Params) -> float:
    """Return how long the law will take for an offset of one sd, s."""
    return params.cone.expected


def step(state: State, sample: Sample | Estimate, params: Params) -> tuple[State, Command]:
    """Return the next state and the command."""
    assert isinstance(sample, Sample)  # it requests no measurement
    start = sample.t if state.start is None else state.start
    down = sample.gravity / float(np.linalg.norm(sample.gravity))
    if -params.sweep.axes[:, 2] @ down < np.cos(params.tilt_at_stop):
        return state, Command(finished=one_reason(LawReason.TILTED))
    past, sweep = sample.t - start, sweep_now(state, params)
    want = wanted(sweep, past, down, sample.rate)
    sample = replace(sample, rate=sample.rate + params.late * want.slope)
    own = params.inertia @ sample.rate
    error = own - params.inertia @ want.rate
    requested = cross(sample.rate, own + sample.momentum) - params.gain * error
    requested += steering(params, sweep, sample, past, want)
    if state.over:
        return levelling(state, requested, float(-params.sweep.axes[:, 2] @ down), past, params)
    rest = error - mean_moment(params) * sample.rate
    ahead = adapted(state, sample, rest, params) - sample.shift
    most = max(params.lead, float(np.linalg.norm(state.shift - sample.shift)))
    shift = sample.shift + limited(ahead, most)
    turns = watched(state, sample, params, past)
    after = State(shift, turns, start, sample.gravity, rest, requested)
    note = beginning(params) if state.start is None else ()
    return concluded(after, past, params), Command(shift, requested, note=note)


def sweep_now(state: State, params: Params) -> Sweep:
    """Return the sweep, or once masses have come to rest the way back to level."""
    return params.sweep._replace(angle=0.0) if state.over else params.sweep


def levelling(
    state: State, requested: Vector3, up: float, past: float, params: Params
) -> tuple[State, Command]:
    """Return a step on the way back to level, by which the law ends; ``up`` is cos(tilt)."""
    time = past - state.since > WAIT / max(params.sweep.hold, 1e-9)
    there = up >= np.cos(LEVELLED) or params.sweep.angle <= 0
    if there or time:
        return state, Command(state.shift + params.target, requested, finished=state.over)
    return state, Command(state.shift, requested)


def concluded(state: State, past: float, params: Params) -> State:
    """Return the state, with masses at their mean of the last turn where the law is over.

    What goes round with the cone is no offset.
    """
    over = why_over(state, past, params)
    mean = state.turns.mean if over else None
    return replace(state, over=over, since=past, shift=state.shift if mean is None else mean)


def steering(params: Params, sweep: Sweep, sample: Sample, past: float, want: Wanted) -> Vector3:
    """Return H_d' (N m) in the middle of the period for which a torque is held."""
    half = params.period / 2
    gravity = sample.gravity + half * cross(sample.gravity, sample.rate)
    rate = sample.rate + half * want.slope
    slope = wanted(sweep, past + half, gravity / float(np.linalg.norm(gravity)), rate).slope
    return params.inertia @ slope


def mean_moment(params: Params) -> float:
    """Return j, a third of tr J (kg m^2)."""
    return float(np.trace(params.inertia)) / 3


def adapted(state: State, sample: Sample, rest: Vector3, params: Params) -> Vector3:
    """Return s (m) a step on."""
    if state.gravity is None or state.rest is None or state.torque is None:
        return state.shift
    if not was_given(state, sample, params):
        return state.shift
    turned = mean_moment(params) * (sample.gravity - state.gravity)
    middle = cross(state.gravity, state.rest) + cross(sample.gravity, rest)
    total = turned + params.period / 2 * middle
    return state.shift - params.adaption * params.mass * total


def was_given(state: State, sample: Sample, params: Params) -> bool:
    """Say whether the torque since the last step was the requested one."""
    if state.torque is None:
        return True
    return float(np.linalg.norm(state.torque - sample.torque)) <= params.short


def watched(state: State, sample: Sample, params: Params, past: float) -> Turns:
    """Return the turns of the cone after a sample."""
    turns, down = state.turns, sample.gravity / float(np.linalg.norm(sample.gravity))
    if was_given(state, sample, params):
        turns = swept(turns, down, params.period)
    return counted(turns, int(past / params.cone.turn), sample.shift, params.cone.fading)


def beginning(params: Params) -> tuple[Reason, ...]:
    """Return what a run is to expect."""
    cone = params.cone
    return one_reason(LawReason.CONE_BEGINS, angle=cone.angle, turn=cone.turn,
                      fades=1 / cone.decay, expected=cone.expected)  # fmt: skip


def why_over(state: State, past: float, params: Params) -> tuple[Reason, ...]:
    """Return why the law ends here, or nothing."""
    if params.sweep.angle <= 0:
        return why_still(state, past, params)
    rest, whole = state.turns.rest, state.turns.whole
    if whole >= OPENED and rest <= NEAR:
        return one_reason(LawReason.MASSES_AT_REST, turns=whole, left=rest, height=params.height)
    if past <= LONG * params.cone.expected:
        return ()
    if not np.isfinite(rest):
        return one_reason(LawReason.TORQUE_NOT_GIVEN, past=past)
    return one_reason(LawReason.MASSES_NOT_AT_REST, past=past, left=rest)


def why_still(state: State, past: float, params: Params) -> tuple[Reason, ...]:
    """Return why a law that sweeps nothing ends here, or nothing."""
    if past * params.gain < QUIET:
        return ()
    values, vectors = np.linalg.eigh(state.turns.observed)
    axis = axes_of("axis", vectors[:, 0])
    return one_reason(LawReason.DIRECTION_NOT_SWEPT, least=float(values[0]), past=past, **axis)


LAW = Law(
    LawCard(
        "fully_actuated",
        (
            "Wheels or gyros turn the gravity direction around a cone; masses move until "
            "the wheels need no torque."
        ),
        "Kim & Agrawal 2009; da Silva 2021 section 4.2, Eq. 42 with erratum R24",
        ("masses", "momentum", "gyro", "attitude"),
        (
            "the component along gravity unless gravity sweeps; along up -dJ W^2 / (m g) "
            "for an inertia error dJ (4 um for one inertia_sd); 0.8 um from the travel of "
            "the masses within a turn"
        ),
        (
            "w_a T up to 0.1 and w_a |r| / v up to 1; the sideways torque of |r|, and its "
            "momentum in 2 zeta / w_a, within the devices' limits. Weaker devices make it "
            "slower; it states the expected duration at the start"
        ),
        PERIOD,
    ),
    begin,
    step,
    expected,
)
