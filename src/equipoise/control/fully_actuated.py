"""Balance with masses while wheels or gyros hold a momentum trajectory.

(Kim & Agrawal 2009; da Silva 2021 section 4.2 with erratum R24: [g_b x] and not [w x].) The law of
momentum, h stored in wheels or gyros, s the shift by masses, r + s wanted at r*:

    (J w)' = -w x (J w + h) - h' + m (r + s) x g_b

Published with one H_s for all momentum. But momentum that passes between platform and wheels does
not change their sum: it is J w alone that -h' can steer, and J w + h that turns with the body. So,
with e = J w - H_d,

    -h' = w x (J w + h) - K e + H_d' - m r* x g_b        the torque asked for, K > 0
    s'  = Gamma m [g_b x]^T e = -Gamma m g_b x e
    e'  = -K e - m [g_b x] (r + s - r*)
    V   = |e|^2 / 2 + |r + s - r*|^2 / (2 Gamma),        V' = -K |e|^2

e and r + s - r* are a filter of frequency w_a: Gamma = (w_a / (m g))^2, K = 2 zeta w_a. For J = jE
and H_d = 0, s = s(0) - Gamma m j (g_b - g_b(0)): a function of the tilt, and no balance. The steps
keep that identity exactly, as s takes j times the measured increment of g_b, j being a third of
tr J, and the trapezoid rule of the rest.

What is along gravity is not seen. With H_d = 0 the platform may come to rest with r + s along g_b,
its momentum kept and it not balanced. H_d is therefore made to lead gravity round a cone
(``sweep``), of half-angle A and speed W. The part along up then fades at about

    A^2 w_a^2 K W^2 / ((w_a^2 - W^2)^2 + K^2 W^2)

and how much has been seen of the worst direction is the least eigenvalue of int (E - n n^T) dt,
n = g_b / g; the law has finished when that is ENOUGH times the time constant, and says so when it
stops with less. A wrong J turns with the cone just as a wrong height does: r_up ends off by about
dJ W^2 / (m g), so W is chosen from the testbed's inertia_sd.

The trajectory is chosen from the tilt limit and from the momentum that wheels have left: they carry
m g |r| 2 zeta / w_a for ever, and J A W + m g |r_up| A / W round the cone.

Anti-windup: s never leads what masses report by more than ``lead``, and stands still while the
torque that was measured is not the one that was asked for.
"""

from dataclasses import dataclass, replace

import numpy as np

from equipoise.control.law import Law, LawCard
from equipoise.control.mass_reach import (
    LIKELY,
    around,
    height_sd,
    level_inertia,
    likely_offset,
    reach_of,
)
from equipoise.control.momentum_reach import momentum_reach
from equipoise.control.sample import Sample
from equipoise.control.sweep import Sweep, wanted
from equipoise.model.arrays import Matrix3, Vector3
from equipoise.model.command import Command
from equipoise.model.errors import InputError
from equipoise.model.estimate import Estimate
from equipoise.model.testbed import Testbed

PERIOD = 0.1  # s, chosen: a servo's beat
ZETA = 1.0  # chosen: no overshoot
MOST = 1.0  # rad/s, chosen: of w_a
SAMPLED = 0.2  # rad, chosen: w_a T
SPEED = 1.0  # chosen: w_a |r| / v
RATIO = 2.0  # chosen: w_a over the sweep's speed
BIAS = 2e-5  # m, chosen: what a wrong inertia may leave along up
FIRM = 0.01  # chosen: inertia is not taken to be known better, as to the speed
CONE = 0.4  # of the tilt limit, chosen: the sweep
STRAY = 0.4  # of the tilt limit, chosen: what an offset may add before masses have met it
NARROWEST = np.radians(1.0)  # chosen
HOLD = 0.3  # of w_a, chosen
SPARE = 0.8  # chosen: of momentum and torque, what is used
LEAD = 3.0  # periods, chosen: of travel, by which masses may be behind
SHORT = 0.1  # of the devices' torque, chosen: a torque that far from the one asked for is another
ENOUGH = 7.0  # time constants, chosen: a thousandth is left
QUIET = 30.0  # time constants, chosen: after which a law that sweeps nothing has ended


@dataclass(frozen=True, slots=True, eq=False)
class Params:
    """What does not change from step to step."""

    mass: float  # kg
    inertia: Matrix3  # kg m^2
    target: Vector3  # m, r*
    adaption: float  # s^2 kg^-2 m^-2, Gamma
    gain: float  # 1/s, K
    sweep: Sweep
    lead: float  # m
    short: float  # N m
    tilt_limit: float  # rad
    period: float  # s


@dataclass(frozen=True, slots=True, eq=False)
class State:
    """Where the law stands."""

    shift: Vector3  # m, s
    seen: Matrix3  # s, int (E - n n^T) dt
    start: float | None = None  # s
    gravity: Vector3 | None = None  # m/s^2, at the last step
    rest: Vector3 | None = None  # N m s, e - j w at the last step
    torque: Vector3 | None = None  # N m, asked for at the last step


def begin(testbed: Testbed, target: Vector3) -> tuple[State, Params]:
    """Return state and parameters; InputError where the loop would not be stable."""
    reach, devices = reach_of(testbed), momentum_reach(testbed)
    m, g, up = testbed.body.mass, testbed.gravity, testbed.up
    speed = sweep_speed(testbed)
    w = frequency_for(testbed, RATIO * speed)
    e1 = around(up, 1)[0]
    speed = min(speed, w / RATIO)
    sweep = Sweep(np.column_stack([e1, np.cross(up, e1), up]),
                  cone_for(testbed, target, w, speed), speed, HOLD * w)  # fmt: skip
    params = Params(
        m, testbed.body.inertia_P, target, (w / (m * g)) ** 2, 2 * ZETA * w, sweep,
        LEAD * reach.speed * PERIOD + reach.quantum, SHORT * devices.torque, testbed.tilt_limit,
        PERIOD,
    )  # fmt: skip
    return State(target - testbed.body.com, np.zeros((3, 3))), params


def sweep_speed(testbed: Testbed) -> float:
    """Return the speed (rad/s) of the cone at which a wrong inertia leaves BIAS."""
    off = max(testbed.inertia_sd, FIRM) * level_inertia(testbed)
    return float((BIAS * testbed.body.mass * testbed.gravity / off) ** 0.5)


def frequency_for(testbed: Testbed, wish: float) -> float:
    """Return w_a (rad/s), no more than wished; InputError where the loop would not be stable."""
    reach, offset = reach_of(testbed), likely_offset(testbed)
    weight = testbed.body.mass * testbed.gravity / level_inertia(testbed)
    least = (weight * offset / (STRAY * testbed.tilt_limit)) ** 0.5
    most = min(MOST, SAMPLED / PERIOD, SPEED * reach.speed / max(offset, 1e-12))
    if least > most or offset > reach.travel:
        raise InputError(
            testbed.name,
            f"a centre of mass that may be {1e6 * offset:.3g} um off sideways, and masses that "
            f"shift it by {1e6 * reach.speed:.3g} um/s and {1e6 * reach.travel:.3g} um",
            f"a loop between {least:.2g} rad/s, for the tilt limit, and {most:.2g} rad/s, for the "
            "masses: a coarse balance first, faster or heavier masses, or a firmer com_sd",
        )
    return min(max(wish, least), most)


def cone_for(testbed: Testbed, target: Vector3, w: float, W: float) -> float:
    """Return the cone's half-angle (rad) that tilt limit, torque and momentum allow."""
    devices, J = momentum_reach(testbed), level_inertia(testbed)
    weight = testbed.body.mass * testbed.gravity
    offset = likely_offset(testbed)
    low = abs(float(testbed.up @ (testbed.body.com - target))) + LIKELY * height_sd(testbed)
    low += float(np.linalg.norm(target))  # held up by torque as long as the law runs
    momentum = SPARE * devices.momentum - weight * offset * 2 * ZETA / w
    torque = SPARE * devices.torque - weight * offset
    angle = min(
        CONE * testbed.tilt_limit,
        momentum / (J * W + weight * low / W),
        torque / (J * W**2 + weight * low),
    )
    if angle < NARROWEST:
        raise InputError(
            testbed.name,
            f"wheels or gyros of {devices.torque:.3g} N m and {devices.momentum:.3g} N m s, and a "
            f"centre of mass that may be {1e6 * offset:.3g} um off sideways and {1e6 * low:.3g} "
            f"um along up: they can lead it round a cone of {np.degrees(angle):.2g} deg",
            f"at least {np.degrees(NARROWEST):.2g} deg: a coarse balance first, or more momentum",
        )
    return angle


def step(state: State, seen: Sample | Estimate, params: Params) -> tuple[State, Command]:
    """Return the next state and what is wanted."""
    assert isinstance(seen, Sample)  # it asks for no look
    start = seen.t if state.start is None else state.start
    down = seen.gravity / float(np.linalg.norm(seen.gravity))
    if -params.sweep.axes[:, 2] @ down < np.cos(params.tilt_limit):
        return state, Command(finished="Stopped: the platform tilts beyond its limit.")
    want = wanted(params.sweep, seen.t - start, down, seen.rate)
    own = params.inertia @ seen.rate
    error = own - params.inertia @ want.rate
    asked = np.cross(seen.rate, own + seen.momentum) - params.gain * error
    soon = start_half(params, seen, start, down)
    asked += params.inertia @ soon - params.mass * np.cross(params.target, seen.gravity)
    rest = error - mean_moment(params) * seen.rate
    shift = limited(adapted(state, seen, rest, params), seen.shift, params.lead)
    told = state.seen + params.period * (np.eye(3) - np.outer(down, down))
    after = State(shift, told, start, seen.gravity, rest, asked)
    return after, Command(shift, asked, finished=why_over(after, seen.t - start, params))


def start_half(params: Params, seen: Sample, start: float, down: Vector3) -> Vector3:
    """Return w_d' (rad/s^2) in the middle of the period for which a torque is asked."""
    half = params.period / 2
    there = down + half * np.cross(down, seen.rate)
    return wanted(params.sweep, seen.t - start + half, there, seen.rate).slope


def mean_moment(params: Params) -> float:
    """Return j, a third of tr J (kg m^2)."""
    return float(np.trace(params.inertia)) / 3


def adapted(state: State, seen: Sample, rest: Vector3, params: Params) -> Vector3:
    """Return s (m) a step on."""
    if state.gravity is None or state.rest is None or state.torque is None:
        return state.shift
    if float(np.linalg.norm(state.torque - seen.torque)) > params.short:
        return state.shift
    turned = mean_moment(params) * (seen.gravity - state.gravity)
    middle = np.cross(state.gravity, state.rest) + np.cross(seen.gravity, rest)
    total = turned + params.period / 2 * middle
    return state.shift - params.adaption * params.mass * total


def limited(shift: Vector3, there: Vector3, lead: float) -> Vector3:
    """Return a shift (m) that leads what is there by no more than ``lead``."""
    ahead = shift - there
    return there + ahead * min(1.0, lead / max(float(np.linalg.norm(ahead)), 1e-12))


def fading(params: Params) -> float:
    """Return how fast (1/s) an offset fades per share of the time that it is across gravity."""
    K, W = params.gain, params.sweep.speed
    w2 = (K / (2 * ZETA)) ** 2
    return w2 * K * W**2 / ((w2 - W**2) ** 2 + (K * W) ** 2)


def why_over(state: State, past: float, params: Params) -> str:
    """Return why the law ends here, or nothing."""
    values, vectors = np.linalg.eigh(state.seen)
    told = float(values[0]) * fading(params)
    if told >= ENOUGH:
        return f"Gravity has swept all directions, the least of them for {values[0]:.3g} s."
    if params.sweep.angle > 0 or past * params.gain < QUIET:
        return ""
    x, y, z = vectors[:, 0]
    return (
        f"The platform is still. Gravity has swept all directions but ({x:.2f}, {y:.2f}, {z:.2f}), "
        f"for {values[0]:.2g} s of {past:.3g} s: the centre of mass may be anywhere along it, and "
        "is not balanced. A momentum trajectory must move it."
    )


LAW = Law(
    LawCard(
        "fully_actuated",
        "Wheels or gyros lead gravity round a cone, and masses move until no torque is missing.",
        "Kim & Agrawal 2009; da Silva 2021 section 4.2 with erratum R24",
        ("masses", "momentum", "gyro", "attitude"),
        "what is along gravity unless gravity sweeps; dJ W^2 / (m g) along up when J is wrong by dJ "
        "(20 um for one inertia_sd)",
        "TODO",
        PERIOD,
    ),
    begin,
    step,
)
