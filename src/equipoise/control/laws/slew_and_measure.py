"""Large turns by wheels or gyros, and one fit of the whole record (Lee's procedure).

    swing     where the nominal sd of r is too large for the wheels: free swings, hanging, with a
              measurement of each, and the masses closer to the target, until wheels can hold r
    turn      from the present attitude to A, B and C, far apart and tilted, by ``attitude_pid``
    measure   the record since the first turn is fitted at once: the momentum that wheels or gyros
              stored is known and sets the scale, so that J and r come out together
    move      the masses go to the target; then all of it once more

Gravity's torque on an unknown r is not fed forward; the integral takes it. Wheels must store all of
it during the turns, so these begin when

    m g |sd| T < momentum,     T: all the turns,  sd: of r

Sag is held at none: turns at one tilt hardly separate it from the height. The estimated height is
that of a stiff platform that behaves alike in such turns, nearly the one that trims the sag.

(Lee et al. sections IV and V, who had balanced by hand: start at (70, 30, -30) deg, one turn to
level. Their integrated regression, here with free constants and corrected for noise, is made once,
at the end. A trajectory fit to two minutes under torque took minutes and left three times the
error.)
"""

from dataclasses import dataclass, field, replace

import numpy as np

from equipoise.control.elements import slew as slews
from equipoise.control.elements.attitude_pid import Gains, Pid, gains_for, torque, unwound
from equipoise.control.law import Law, Sample
from equipoise.control.plant.pendulum import hanging
from equipoise.control.plant.settling import UNREPORTED, Stand, standing
from equipoise.control.plant.swing_estimates import METHOD as FREE
from equipoise.control.plant.swing_estimates import drift_of, shows, why_not_shown
from equipoise.control.plant.wheel_capacity import capacity
from equipoise.maths.attitude import difference, exponential, level, multiply, to_matrix
from equipoise.model.arrays import Quaternion, Vector3
from equipoise.model.command import Command, Measurement
from equipoise.model.errors import InputError
from equipoise.model.estimate import COM, Estimate
from equipoise.model.law_card import LawCard
from equipoise.model.reasons.law_reasons import LawReason
from equipoise.model.reasons.reason import Reason, one_reason
from equipoise.model.testbed import Testbed
from equipoise.model.units import UM

PERIOD = 0.1  # s
SHARE = 0.7  # of the tilt limit, chosen: the tilt of A, B and C
HEADING = float(np.radians(60))  # rad, chosen: between turns, which shows J about the vertical
METHOD, AFTER = "momentum_corrected", 5.0  # s, chosen: of the measurement after the last turn
SWING, SWINGS = 40.0, 3  # s, -, chosen: of a free swing, and how many at most
CLOSE = 0.5e-6  # m, chosen: one sd of r that such swings reach
SURE = 3.0  # sds that the platform hangs below the target between them, chosen
ROUNDS = 2  # of turns, measurement and move
REST = 3.0  # s after a turn, chosen: until its error has settled
ARRIVED = 1.0  # s: masses that stand so long have arrived


@dataclass(frozen=True, slots=True, eq=False)
class Params:
    """The constants of a run."""

    testbed: Testbed
    gains: Gains
    pace: slews.Pace
    target: Vector3  # m
    turns: tuple[Quaternion, ...]  # A, B and C, from level with the first heading
    bearable: float  # m, the sd of r with which turns can be begun
    held: tuple[str, ...]  # torques that a free swing is fitted without


@dataclass(frozen=True, slots=True, eq=False)
class State:
    """The progress of the law."""

    com: Vector3  # m, as estimated, masses at home
    pid: Pid = field(default_factory=unwound)
    base: Quaternion | None = None  # level, with the first heading
    way: slews.Slew | None = None
    at: int = 0  # which turn
    round: int = 1  # 0: swings before the first
    swings: int = 0
    began: float = 0.0  # s, of this round's turns
    t: float = 0.0  # s, of the last sample
    shift: Vector3 | None = None  # m, requested
    stand: Stand = UNREPORTED
    moving: bool = False  # the masses are on their way
    finished: tuple[Reason, ...] = ()


def attitudes(testbed: Testbed) -> tuple[Quaternion, ...]:
    """Return A, B and C from level: tilted to three sides, at three headings."""
    tilt = SHARE * testbed.tilt_limit
    x, y = to_matrix(level(testbed.up))[:2]
    sides = [0.0, 2.0 * np.pi / 3, -2.0 * np.pi / 3]
    headings = [HEADING, 0.0, -HEADING]
    return tuple(
        multiply(exponential(h * testbed.up), exponential(tilt * (np.cos(a) * x + np.sin(a) * y)))
        for h, a in zip(headings, sides, strict=True)
    )


def ways(up: Vector3, turns: tuple[Quaternion, ...], pace: slews.Pace) -> list[float]:
    """Return how long each turn lasts (s), the first from level."""
    here, found = level(up), list[float]()
    for turn in turns:
        there = multiply(level(up), turn)
        angle = float(np.linalg.norm(difference(there, here)))
        found.append(slews.time_for(angle, pace) + REST)
        here = there
    return found


def begin(testbed: Testbed, target: Vector3) -> tuple[State, Params]:
    """Return the beginning; InputError where wheels cannot store gravity's torque for so long."""
    can, J = capacity(testbed), testbed.body.inertia_P
    if can.torque <= 0 or not testbed.masses:
        raise InputError("slew_and_measure", "a testbed without them",
                         "sliding masses, and wheels or gyros along all axes")  # fmt: skip
    pace = slews.pace_for(float(np.linalg.eigvalsh(J)[-1]), can)
    turns, held = attitudes(testbed), testbed.in_group("drift")
    lasting = sum(ways(testbed.up, turns, pace))
    needed = testbed.weight * lasting  # N m s per m
    bearable = can.momentum / needed
    if bearable < CLOSE:
        raise InputError("slew_and_measure", f"wheels or gyros that store {can.momentum:.3g} N m s",
                         f"{needed * CLOSE:.3g} N m s: m g {CLOSE / UM:g} um while the turns last"
                         )  # fmt: skip
    loop = gains_for(J, can.torque)
    params = Params(testbed, loop, pace, target, turns, bearable, held)
    if float(np.linalg.norm(testbed.com_sd)) <= bearable:
        return State(testbed.body.com), params
    lowered = hanging(testbed).lowered * testbed.up
    return State(testbed.body.com, round=0, shift=lowered, moving=True), params


def turning(state: State, sample: Sample, params: Params) -> State:
    """Return the state on its way to the turn that is due; ``at`` past the last: all are made."""
    turned = state.way is not None and state.way.duration > 0  # or held while masses travelled
    if state.way is not None and turned:
        if sample.t < slews.end_of(state.way) + REST:
            return state
        state = replace(state, at=state.at + 1)
    if state.at == len(params.turns):
        return state
    base = slews.levelled(sample.q, params.testbed.up) if state.base is None else state.base
    here = sample.q if state.way is None else slews.reference_at(state.way, np.inf).q
    way = slews.slew(here, multiply(base, params.turns[state.at]), sample.t, params.pace)
    began = sample.t if state.at == 0 else state.began
    return replace(state, base=base, way=way, began=began)


def driven(state: State, sample: Sample, params: Params) -> tuple[State, Command]:
    """Return the state and the command that follows the turn, or holds after it."""
    assert state.way is not None
    reference = slews.reference_at(state.way, sample.t)
    moment = params.testbed.body.mass * (state.com + sample.shift)
    pid, u = torque(state.pid, sample, reference, params.gains, moment)
    return replace(state, pid=pid), Command(shift=state.shift, torque=u)


def after_swing(state: State, estimate: Estimate, params: Params) -> State:
    """Return the state with the masses on their way closer to the target, or to it.

    To it when wheels can then hold what is uncertain of r. They hold the platform during the move,
    and release it again to swing.
    """
    swings, up = state.swings + 1, params.testbed.up
    state = replace(state, stand=UNREPORTED, pid=unwound(), way=None, swings=swings)
    if not shows(estimate):
        return replace(state, finished=why_not_shown(estimate) if swings == SWINGS else ())
    sd = float(np.sqrt(np.trace(estimate.covariance_of(COM))))
    will_do = sd <= params.bearable
    numbers = {"swings": swings, "sd": sd, "wanted": params.bearable}
    why = one_reason(LawReason.COM_TOO_UNCERTAIN, **numbers)
    below = 0.0 if will_do else SURE * sd
    return replace(
        state,
        com=estimate.com,
        shift=params.target - estimate.com - below * up,
        moving=True,
        round=1 if will_do else 0,
        finished=why if swings == SWINGS and not will_do else (),
    )


def after_measurement(state: State, estimate: Estimate, params: Params) -> State:
    """Return the state with the masses on their way to the target."""
    state = replace(state, stand=UNREPORTED, pid=unwound(), way=None, at=0, round=state.round + 1)
    if not shows(estimate):
        return replace(state, finished=why_not_shown(estimate))
    at_place = one_reason(LawReason.AT_PLACE_BY_TURNS, rounds=ROUNDS)
    done = at_place if state.round > ROUNDS else ()
    com: Vector3 = estimate.com + (state.t + AFTER - state.began) * drift_of(estimate)
    return replace(state, com=com, shift=params.target - com, moving=True, finished=done)


def watched(state: State, sample: Sample) -> State:
    """Return the state after a sample: whether the masses still travel."""
    stand = standing(state.stand, sample)
    moving = state.moving and sample.t < stand.since + ARRIVED
    return replace(state, stand=stand, t=sample.t, moving=moving)


def step(state: State, sample: Sample | Estimate, params: Params) -> tuple[State, Command]:
    """Return the next state and the command: torque while turning, then a measurement of it all."""
    if isinstance(sample, Estimate):
        state = (after_measurement if state.round else after_swing)(state, sample, params)
        return state, Command(shift=state.shift)
    state = watched(state, sample)
    if state.finished and not state.moving:
        return state, Command(shift=state.shift, finished=state.finished)
    if state.way is None and (state.moving or state.finished):
        state = replace(state, way=slews.Slew(sample.q, np.zeros(3), sample.t, 0.0))
    if state.moving or state.finished:
        return driven(state, sample, params)
    if state.round == 0:
        free = Measurement(SWING, FREE, params.held, use_prior=True)
        return state, Command(shift=state.shift, measurement=free)
    state = turning(state, sample, params)
    if state.at == len(params.turns):
        stiff = params.testbed.in_group("sag")
        turns = Measurement(AFTER, METHOD, hold=stiff, since=state.began)
        return state, Command(shift=state.shift, measurement=turns)
    return driven(state, sample, params)


LAW = Law(
    LawCard(
        "slew_and_measure",
        ("Slews by wheels or gyros, and fits the whole record including their momentum."),
        "Lee et al. Eqs. 1-3 and sections IV, V, with errata L1-L4",
        ("masses", "momentum", "gyro", "attitude"),
        (
            "0.1 um, and drift after the last move; 0.5 um of height on a deck that sags "
            "by 25 um; swing at the end"
        ),
        (
            "steps of 0.1 s; wheels or gyros that store the momentum of an offset of 0.5 "
            "um over the slews, two minutes; if they cannot hold one sd of the offset, a "
            "free swing, hanging, comes first"
        ),
        PERIOD,
    ),
    begin,
    step,
)
