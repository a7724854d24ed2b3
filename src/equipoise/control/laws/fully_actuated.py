"""Balance with masses while wheels or gyros hold a momentum trajectory.

(Kim & Agrawal 2009; da Silva 2021 section 4.2, Eq. 42 with erratum R24: [g_b x] and not [w x].)
The law of momentum, h stored in wheels or gyros, s the shift by masses, r + s wanted at r*:

    (J w)' = -w x (J w + h) - h' + m (r + s) x g_b

Published with one H_s for all momentum. But momentum that passes between platform and wheels does
not change their sum: it is J w alone that -h' can steer, and J w + h that turns with the body. So,
with e = J w - H_d,

    -h' = w x (J w + h) - K e + H_d' - m r* x g_b        the requested torque, K > 0
    s'  = Gamma m [g_b x]^T e = -Gamma m g_b x e
    e'  = -K e - m [g_b x] (r + s - r*)
    V   = |e|^2 / 2 + |r + s - r*|^2 / (2 Gamma),        V' = -K |e|^2

e and r + s - r* are a filter of frequency w_a: Gamma = (w_a / (m g))^2, K = 2 zeta w_a. For J = jE
and H_d = 0, s = s(0) - Gamma m j (g_b - g_b(0)): a function of the tilt, and no balance. The steps
keep that identity exactly, as s takes j times the measured increment of g_b, j being a third of
tr J, and the trapezoid rule of the rest.

The part along gravity is unobservable. With H_d = 0 the platform may come to rest with r + s along
g_b, its momentum constant and the platform unbalanced. H_d therefore leads gravity round a cone
(``sweep``), of half-angle A and speed W. The part along up then fades at about

    A^2 w_a^2 K W^2 / ((w_a^2 - W^2)^2 + K^2 W^2)

and the excitation of the worst direction is the least eigenvalue of int (E - n n^T) dt, where n is
g_b / g. The law has finished when that is ENOUGH times the time constant, and reports when it stops
with less. The effect of a wrong J turns with the cone just as that of a wrong height: r_up ends off
by -dJ W^2 / (m g), so W is chosen from the testbed's inertia_sd. Terms that turn with the cone are
computed for the middle of the period for which the torque is held.

The trajectory is chosen from the tilt limit and from the momentum that wheels have left: they carry
m g |r| 2 zeta / w_a for ever, and J A W + m g |r_up| A / W round the cone. Their torque holds r at
first, and the cone, J A W^2 + m g |r_up| A, once the masses have met r.

Anti-windup: s never leads the reported shift by more than ``lead``, and does not change while the
measured torque differs from the requested one.
"""

from dataclasses import dataclass

import numpy as np

from equipoise.control.elements.sweep import Sweep, Wanted, wanted
from equipoise.control.law import Law, Sample
from equipoise.control.plant import offset_bounds as offsets
from equipoise.control.plant.actuator_limits import greatest_slew, limited
from equipoise.control.plant.wheel_capacity import Capacity, capacity
from equipoise.maths.linalg import cross
from equipoise.model.arrays import Matrix3, Vector3
from equipoise.model.command import Command
from equipoise.model.errors import InputError
from equipoise.model.estimate import Estimate
from equipoise.model.law_card import LawCard
from equipoise.model.reasons.law_reasons import LawReason
from equipoise.model.reasons.reason import Reason, axes_of, one_reason
from equipoise.model.testbed import Testbed
from equipoise.model.units import UM

PERIOD = 0.1  # s, chosen: a servo's beat
ZETA = 1.0  # chosen: no overshoot
SPEED = 1.0  # chosen: w_a |r| / v
RATIO = 2.0  # chosen: w_a over the sweep's speed
BIAS = 2e-5  # m, chosen: what a wrong inertia may leave along up
FIRM = 0.01  # chosen: inertia is not taken to be known better, as to the speed
CONE = 0.4  # of the tilt limit, chosen: the sweep
STRAY = 0.4  # of the tilt limit, chosen: what an offset may add before masses have met it
NARROWEST = np.radians(1.0)  # chosen
HOLD = 0.3  # of w_a, chosen
SPARE = 0.8  # chosen: of momentum and torque, what is used
SHARE = 0.5  # chosen: of a pyramid of gyros, what singular directions leave
LEAD = 3.0  # periods of travel, chosen: by which masses may be behind
SHORT = 0.1  # of the devices' torque, chosen: a greater difference counts as another torque
ENOUGH = 7.0  # time constants, chosen: a thousandth is left
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
    lead: float  # m
    short: float  # N m
    tilt_at_stop: float  # rad
    period: float  # s


@dataclass(frozen=True, slots=True, eq=False)
class State:
    """The progress of the law."""

    shift: Vector3  # m, s
    observed: Matrix3  # s, int (E - n n^T) dt
    start: float | None = None  # s
    gravity: Vector3 | None = None  # m/s^2, at the last step
    rest: Vector3 | None = None  # N m s, e - j w at the last step
    torque: Vector3 | None = None  # N m, requested at the last step


def begin(testbed: Testbed, target: Vector3) -> tuple[State, Params]:
    """Return state and parameters; InputError where the loop would not be stable."""
    m, g = testbed.body.mass, testbed.gravity
    speed = sweep_speed(testbed)
    w = frequency_for(testbed, RATIO * speed)
    speed = min(speed, w / RATIO)
    sweep = Sweep(np.column_stack([*offsets.around(testbed.up), testbed.up]),
                  cone_for(testbed, target, w, speed), speed, HOLD * w)  # fmt: skip
    params = Params(
        m, testbed.body.inertia_P, target, (w / (m * g)) ** 2, 2 * ZETA * w, sweep,
        LEAD * greatest_slew(testbed) * PERIOD + offsets.coarsest_step(testbed),
        SHORT * capacity(testbed).torque, testbed.tilt_at_stop, PERIOD,
    )  # fmt: skip
    return State(target - testbed.body.com, np.zeros((3, 3))), params


def sweep_speed(testbed: Testbed) -> float:
    """Return the speed W (rad/s) of the cone at which a wrong inertia leaves BIAS."""
    off = max(testbed.inertia_sd, FIRM) * offsets.level_inertia(testbed)
    return float((BIAS * testbed.body.mass * testbed.gravity / off) ** 0.5)


def frequency_for(testbed: Testbed, wish: float) -> float:
    """Return w_a (rad/s), as wished if it can be; InputError where the loop is not stable."""
    weight = testbed.weight / offsets.level_inertia(testbed)
    least = (weight * offsets.likely_offset(testbed) / (STRAY * testbed.tilt_limit)) ** 0.5
    return float(np.clip(wish, least, offsets.greatest_frequency(testbed, least, SPEED, PERIOD)))


def spare(testbed: Testbed) -> Capacity:
    """Return the usable torque and momentum."""
    most = capacity(testbed)
    share = SPARE * (SHARE if testbed.cmgs else 1.0)
    stored = sum(abs(wheel.inertia * wheel.speed) for wheel in testbed.wheels)
    return Capacity(share * most.torque, share * most.momentum - stored)


def cone_for(testbed: Testbed, target: Vector3, w: float, W: float) -> float:
    """Return the cone's half-angle (rad) that tilt limit, torque and momentum allow."""
    J, weight = offsets.level_inertia(testbed), testbed.weight
    offset, have = offsets.likely_offset(testbed), spare(testbed)
    low = abs(float(testbed.up @ (testbed.body.com - target)))
    low += offsets.LIKELY * offsets.height_sd(testbed)
    low += float(np.linalg.norm(target))  # which torque holds up as long as the law runs
    momentum = have.momentum - weight * offset * 2 * ZETA / w
    angle = min(
        CONE * testbed.tilt_limit,
        momentum / (J * W + weight * low / W),
        have.torque / (J * W**2 + weight * low),
    )
    if angle < NARROWEST or have.torque < weight * offset:
        raise InputError(
            testbed.name,
            f"{have.torque:.3g} N m and {have.momentum:.3g} N m s of wheels or gyros to count on, "
            f"and a centre of mass that may be {offset / UM:.3g} um off sideways and "
            f"{low / UM:.3g} um along up: a cone of {np.degrees(max(angle, 0.0)):.2g} deg",
            f"{np.degrees(NARROWEST):.2g} deg: a coarse balance first, or stronger devices",
        )
    return angle


def step(state: State, sample: Sample | Estimate, params: Params) -> tuple[State, Command]:
    """Return the next state and the command."""
    assert isinstance(sample, Sample)  # it requests no measurement
    start = sample.t if state.start is None else state.start
    down = sample.gravity / float(np.linalg.norm(sample.gravity))
    if -params.sweep.axes[:, 2] @ down < np.cos(params.tilt_at_stop):
        return state, Command(finished=one_reason(LawReason.TILTED))
    want = wanted(params.sweep, sample.t - start, down, sample.rate)
    own = params.inertia @ sample.rate
    error = own - params.inertia @ want.rate
    requested = cross(sample.rate, own + sample.momentum) - params.gain * error
    requested += steering(params, sample, sample.t - start, want)
    rest = error - mean_moment(params) * sample.rate
    ahead = adapted(state, sample, rest, params) - sample.shift
    shift = sample.shift + limited(ahead, params.lead)
    reported = state.observed + params.period * (np.eye(3) - np.outer(down, down))
    after = State(shift, reported, start, sample.gravity, rest, requested)
    return after, Command(shift, requested, finished=why_over(after, sample.t - start, params))


def steering(params: Params, sample: Sample, past: float, want: Wanted) -> Vector3:
    """Return H_d' - m r* x g_b (N m) in the middle of the period for which a torque is held."""
    half = params.period / 2
    gravity = sample.gravity + half * cross(sample.gravity, sample.rate)
    rate = sample.rate + half * want.slope
    slope = wanted(params.sweep, past + half, gravity / float(np.linalg.norm(gravity)), rate).slope
    return params.inertia @ slope - params.mass * cross(params.target, gravity)


def mean_moment(params: Params) -> float:
    """Return j, a third of tr J (kg m^2)."""
    return float(np.trace(params.inertia)) / 3


def adapted(state: State, sample: Sample, rest: Vector3, params: Params) -> Vector3:
    """Return s (m) a step on."""
    if state.gravity is None or state.rest is None or state.torque is None:
        return state.shift
    if float(np.linalg.norm(state.torque - sample.torque)) > params.short:
        return state.shift
    turned = mean_moment(params) * (sample.gravity - state.gravity)
    middle = cross(state.gravity, state.rest) + cross(sample.gravity, rest)
    total = turned + params.period / 2 * middle
    return state.shift - params.adaption * params.mass * total


def fading(params: Params) -> float:
    """Return how fast (1/s) an offset fades per share of the time that it is across gravity."""
    K, W = params.gain, params.sweep.speed
    w2 = (K / (2 * ZETA)) ** 2
    return w2 * K * W**2 / ((w2 - W**2) ** 2 + (K * W) ** 2)


def why_over(state: State, past: float, params: Params) -> tuple[Reason, ...]:
    """Return why the law ends here, or nothing."""
    values, vectors = np.linalg.eigh(state.observed)
    least = float(values[0])
    if least * fading(params) >= ENOUGH:
        return one_reason(LawReason.ALL_DIRECTIONS_SWEPT, least=least)
    if params.sweep.angle > 0 or past * params.gain < QUIET:
        return ()
    axis = axes_of("axis", vectors[:, 0])
    return one_reason(LawReason.DIRECTION_NOT_SWEPT, least=least, past=past, **axis)


LAW = Law(
    LawCard(
        "fully_actuated",
        "Wheels or gyros lead gravity round a cone, and masses move until no torque is missing.",
        "Kim & Agrawal 2009; da Silva 2021 section 4.2, Eq. 42 with erratum R24",
        ("masses", "momentum", "gyro", "attitude"),
        "the part along gravity unless gravity sweeps; along up -dJ W^2 / (m g) when J is wrong by "
        "dJ (20 um for one inertia_sd)",
        "w_a T up to 0.1, w_a |r| / v up to 1; the torque of |r| sideways, and its momentum in "
        "2 zeta / w_a, within the devices'. It is as slow as they are weak: an hour at 14 kg, "
        "110 um and 5 mN m",
        PERIOD,
    ),
    begin,
    step,
)
