"""Parameter-adaptive control by wheels or gyros: J and r are adapted while turns are tracked.

    catch   to level, and level for a while, as the masses follow r^
    turns   to three tilted attitudes at three headings, ROUNDS times; then to level
    last    the masses have arrived where r^ sends them

The torque is that for the parameters as found so far; they adapt by what is left of the track and
by momentum (``parameter_adaptation``, with its Lyapunov function). Masses go to the target less
r^, each BEAT seconds if that changes it by more than DOUBT sd of r^: so wheels need not hold the
offset for long. They have to hold it until the masses have met it,

    m g |r| < torque,     m g |r| MET < momentum            |r|: what is likely across up

(Wright 2006 estimates the parameters of a simulator so: da Silva 2021 section 3, reference 34.
Slotine and Li 1987 and 1989 for the law. Masses that follow are Equipoise's.)
"""

from dataclasses import dataclass, replace

import numpy as np

from equipoise.control.elements import parameter_adaptation as adaptation
from equipoise.control.elements import slew as slews
from equipoise.control.law import Law, Sample
from equipoise.control.laws.slew_and_measure import attitudes
from equipoise.control.plant import offset_bounds as offsets
from equipoise.control.plant.wheel_capacity import capacity
from equipoise.maths.attitude import multiply
from equipoise.model.arrays import Quaternion, Vector3
from equipoise.model.command import Command
from equipoise.model.errors import InputError
from equipoise.model.estimate import Estimate
from equipoise.model.law_card import LawCard
from equipoise.model.reasons.law_reasons import LawReason
from equipoise.model.reasons.reason import one_reason
from equipoise.model.testbed import Testbed
from equipoise.model.units import UM

NAME = "parameter_adaptive"
PERIOD = 0.1  # s, chosen: a servo's beat
BEAT = 2.0  # s, chosen: between moves of the masses, which arrive in less
DOUBT = 2.0  # sd of r^, chosen: a change that is worth a move
CATCH = 20.0  # s, chosen: level before the first turn, a WINDOW of the adaptation
SOONEST = 5.0  # s, chosen: to level, however near it is
REST = 3.0  # s after a turn, chosen: until its error has settled
ROUNDS = 2  # of three turns, chosen: the second is made with masses that have met r
MET = 10.0  # s, chosen: in which masses have met an offset across up
LEVEL = np.array([1.0, 0.0, 0.0, 0.0])


@dataclass(frozen=True, slots=True, eq=False)
class Params:
    """The constants of a run."""

    testbed: Testbed
    known: adaptation.Constants
    pace: slews.Pace
    target: Vector3  # m
    turns: tuple[Quaternion, ...]  # from level with the first heading


@dataclass(frozen=True, slots=True, eq=False)
class Way:
    """What has been adapted so far, and the turn under way."""

    adapted: adaptation.Adaptation
    base: Quaternion  # level, with the first heading
    turn: slews.Slew


@dataclass(frozen=True, slots=True, eq=False)
class State:
    """The progress of the law."""

    shift: Vector3  # m, requested
    way: Way | None = None
    at: int = 0  # turns begun
    sent: float = -np.inf  # s, when masses were last sent


def begin(testbed: Testbed, target: Vector3) -> tuple[State, Params]:
    """Return the beginning; InputError where wheels cannot hold it until masses have met r."""
    can = capacity(testbed)
    if can.torque <= 0 or not testbed.masses or testbed.gyro is None:
        raise InputError(
            NAME,
            "a testbed without them",
            "sliding masses, a gyro, and wheels or gyros along all axes",
        )
    offset = offsets.likely_offset(testbed)
    holds = min(can.torque, can.momentum / MET) / testbed.weight
    if holds < offset:
        found = f"wheels or gyros that hold {holds / UM:.3g} um across up for {MET:g} s"
        raise InputError(NAME, found, f"at most {offset / UM:.3g} um, or a coarse balance first")
    pace = slews.pace_for(float(np.linalg.eigvalsh(testbed.body.inertia_P)[-1]), can)
    turns = (*attitudes(testbed) * ROUNDS, LEVEL)
    params = Params(testbed, adaptation.constants_of(testbed), pace, target, turns)
    return State(target - testbed.body.com), params


def step(state: State, sample: Sample | Estimate, params: Params) -> tuple[State, Command]:
    """Return the next state and the command: the torque of the turn, and where masses belong."""
    assert isinstance(sample, Sample)  # it requests no measurement
    down = sample.gravity / float(np.linalg.norm(sample.gravity))
    if -params.testbed.up @ down < np.cos(params.testbed.tilt_at_stop):
        return state, Command(finished=one_reason(LawReason.TILTED))
    before = opened(sample, params) if state.way is None else state.way
    is_over = sample.t > slews.end_of(before.turn) + (REST if state.at else CATCH)
    if is_over and state.at == len(params.turns):
        if np.array_equal(sample.shift, before.adapted.shift):
            done = one_reason(LawReason.AT_PLACE_BY_TURNS, rounds=ROUNDS)
            return state, Command(shift=state.shift, finished=done)
    elif is_over:
        before = turning(before, state.at, sample.t, params)
        state = replace(state, at=state.at + 1)
    reference = slews.reference_at(before.turn, sample.t)
    adapted, torque = adaptation.adapted(before.adapted, sample, reference, params.known)
    state = sent(replace(state, way=replace(before, adapted=adapted)), sample.t, params)
    return state, Command(shift=state.shift, torque=torque)


def opened(sample: Sample, params: Params) -> Way:
    """Return the way to level, with the parameters of the testbed."""
    base = slews.levelled(sample.q, params.testbed.up)
    turn = slews.slew(sample.q, base, sample.t, params.pace)
    turn = turn._replace(duration=max(turn.duration, SOONEST))
    return Way(adaptation.opened(params.testbed, sample), base, turn)


def turning(way: Way, at: int, t: float, params: Params) -> Way:
    """Return the way with the turn that is due."""
    here = slews.reference_at(way.turn, np.inf).q
    goal = multiply(way.base, params.turns[at])
    return replace(way, turn=slews.slew(here, goal, t, params.pace))


def sent(state: State, t: float, params: Params) -> State:
    """Return the state with masses on their way to where r^ wants them, if that is worth a move.

    In the last rest they stay, so that it ends.
    """
    assert state.way is not None
    if state.at == len(params.turns) and t > slews.end_of(state.way.turn):
        return state
    com, sd = adaptation.com_of(state.way.adapted)
    wish = params.target - com
    if t < state.sent + BEAT or not np.any(np.abs(wish - state.shift) > DOUBT * sd):
        return state
    return replace(state, shift=wish, sent=t)


LAW = Law(
    LawCard(
        NAME,
        (
            "Wheels or gyros track turns with a control torque whose parameters, inertia "
            "and centre of mass, adapt; masses follow the estimated centre of mass."
        ),
        "Wright 2006 (da Silva 2021 section 3, reference 34); Slotine and Li 1987, 1989",
        ("masses", "momentum", "gyro", "attitude"),
        (
            "0.1 um across up, and 1.2 um of height on a deck that sags by 25 um, since "
            "the law assumes a stiff one; air and bearing torques that last 20 s; drift "
            "after the end; inertia across up to no better than 3 %, since the turns are "
            "slow"
        ),
        (
            "K T / J of 0.1; wheels or gyros that hold the expected offset across up for "
            "10 s, until masses have corrected it; a stated inertia within 5 %"
        ),
        PERIOD,
    ),
    begin,
    step,
)
