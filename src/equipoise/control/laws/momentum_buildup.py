"""Wheel momentum build-up: hold tilted attitudes and estimate r from the wheels' momentum.

    L' = R (m r x g_B) + ...,     L = R (J w + h)

Wheels hold the platform at one tilted attitude after another, and their speed shows the momentum
that gravity adds. All samples enter one filter (``momentum_balance``), which estimates r, sag and
drift together, with their covariance. Inertia is not needed. The sequence:

    catch    level, then a small tilt; every second the masses follow the estimate
    holds    opposite pairs of tilts, so that the momentum which r_z adds is taken out again; before
             each, the masses go to the goal when its sd is below the error of a move
    last     the masses go to the goal as then estimated

The goal is the target and, on a platform that sags, the height above it that trims the sag
(``sag_trim``): the residual torque within RANGE of level is then the least for masses that stand
still. When the law has ended, masses can follow the tilt by the estimated sag, and leave less
(``control.laws.follow``). In the catch, and when wheels have filled to FULL until they are EMPTY,
masses are set off the goal so that gravity takes the horizontal momentum out again, no further than
is soon travelled:

    shift = goal - r + g_B x (R^T tau) / (m g^2),    tau = -UNLOAD L

The seconds of a hold are the fewest of CHOICES for which the predicted sd of the goal is WANTED or
less within LONGEST; else the most that fit into it.

(Hatcher and Young 1968 with wheels for jets; the trim is that of ``dynamics.sag_trim``.)
"""

from dataclasses import dataclass, field, replace

import numpy as np

from equipoise.control.elements import momentum_balance as balance
from equipoise.control.elements import slew as slews
from equipoise.control.elements.attitude_pid import Gains, Pid, gains_for, torque, unwound
from equipoise.control.elements.buildup_plan import Stage, foreseen, stages_of
from equipoise.control.law import Law, Sample
from equipoise.control.plant.actuator_limits import fastest_slew
from equipoise.control.plant.wheel_capacity import capacity
from equipoise.dynamics.sag_trim import sag_matrix, trimmed_com
from equipoise.maths.attitude import to_matrix
from equipoise.maths.linalg import cross
from equipoise.model.arrays import Floats, Matrix3, Quaternion, Vector3
from equipoise.model.command import Command
from equipoise.model.errors import InputError
from equipoise.model.estimate import Estimate
from equipoise.model.following import Following
from equipoise.model.law_card import LawCard
from equipoise.model.reasons.law_reasons import LawReason
from equipoise.model.reasons.reason import Reason, axes_of, one_reason
from equipoise.model.testbed import Testbed

PERIOD = 0.1  # s
RANGE = float(np.radians(20))  # rad, chosen: over which the residual torque counts
SHARE = 0.7  # of the tilt limit, chosen: the most that is held
CHOICES = (10.0, 14.0, 20.0, 28.0, 40.0)  # s of a hold
WANTED = 0.005e-6  # m, chosen: one sd of the goal per axis, 2e-7 N m at 4 kg
LONGEST = 420.0  # s, chosen: with catches that take longer still below eight minutes
FOLLOW = 1.0  # s, chosen: between moves while the masses follow
UNLOAD = 0.1  # 1/s, chosen: slow against masses that travel 20 um in two seconds
SOON = 0.2  # chosen: share of 1/UNLOAD in which masses reach what unloads
FULL, EMPTY = 0.45, 0.1  # of the momentum that wheels can take, chosen: a turn needs half
AHEAD = 60.0  # s, chosen: drift goes on, and is at the goal in the middle of the next two minutes
LATE = 4  # chosen: holds before which no coarse mass is moved any more
DOUBT = 2.0  # sds of the goal, chosen: a change that is worth a move during the holds
COARSE = 0.1e-6  # m, chosen: one sd of a stop that only a coarse mass has
CLEAR = 0.15e-6  # m, chosen: one sd of the goal at the end; more is worth another pair of holds
PATIENCE = 60.0  # s, chosen: for masses that do not arrive
SETTLED = 1.0  # s, chosen: masses that then stand have arrived


@dataclass(frozen=True, slots=True, eq=False)
class Params:
    """The constants of a run."""

    book: balance.Book
    gains: Gains
    testbed: Testbed
    target: Vector3  # m
    trim: Floats  # (3, k) change of the goal by each torque term
    stages: tuple[Stage, ...]
    pace: slews.Pace
    momentum: float  # N m s, that wheels can take
    reach: float  # m, the most that masses are set off to unload


@dataclass(frozen=True, slots=True, eq=False)
class State:
    """The progress of the law."""

    ledger: balance.Ledger | None = None
    pid: Pid = field(default_factory=unwound)
    level: Quaternion | None = None  # the level attitude with the first heading
    turn: slews.Slew | None = None
    stage: int = 0
    due: float = 0.0  # s, when this stage ends
    shift: Vector3 | None = None  # m, last requested
    followed: float = -np.inf  # s, when the masses last followed
    unloading: bool = False
    again: bool = False  # the last pair of holds is taken a second time
    closing: float | None = None  # s, when it is level after the last move


def begin(testbed: Testbed, target: Vector3) -> tuple[State, Params]:
    """Return the beginning; InputError without a gyro, masses, or wheels along all axes."""
    can = capacity(testbed)
    if can.torque <= 0 or testbed.gyro is None or not testbed.masses:
        raise InputError("momentum_buildup", "a testbed without them",
                         "sliding masses, a gyro, and wheels or gyros along all axes")  # fmt: skip
    book = balance.book_of(testbed)
    tilt = min(RANGE, SHARE * testbed.tilt_limit)
    trims = [trimmed_com(sag_matrix({term: 1.0}), testbed.up, tilt) for term in book.terms]
    trim = np.array(trims).reshape(-1, 3).T
    pace = slews.pace_for(slews.moment_across(testbed.body.inertia_P, testbed.up), can)
    stages = planned(testbed, book, trim, pace)
    loop = gains_for(testbed.body.inertia_P, can.torque)
    reach = SOON / UNLOAD * fastest_slew(testbed)
    return State(), Params(book, loop, testbed, target, trim, stages, pace, can.momentum, reach)


def planned(
    testbed: Testbed, book: balance.Book, trim: Floats, pace: slews.Pace
) -> tuple[Stage, ...]:
    """Return the stages with the seconds of a hold that the predicted covariance requires."""
    tilt = min(RANGE, SHARE * testbed.tilt_limit)
    best = stages_of(testbed.up, tilt, CHOICES[0])
    for hold in CHOICES:
        stages = stages_of(testbed.up, tilt, hold)
        ledger = foreseen(stages, testbed, book, pace)
        if ledger.t > LONGEST:
            break
        best = stages
        covariance = off_goal(ledger, np.zeros(3), trim, book)[1]
        if float(np.diag(covariance).max()) <= WANTED**2:
            break
    return best


def off_goal(
    ledger: balance.Ledger, shift: Vector3, trim: Floats, book: balance.Book, ahead: float = AHEAD
) -> tuple[Vector3, Matrix3]:
    """Return the offset of the centre of mass from the one that trims, and its covariance."""
    G = balance.com_map(ledger, book, ahead)
    G[:, balance.TERM :] -= trim
    return G @ ledger.x + shift, G @ ledger.P @ G.T


def unloading(ledger: balance.Ledger, sample: Sample, params: Params) -> Vector3:
    """Return the offset (m) from the goal by which gravity takes the horizontal momentum out."""
    outward = -UNLOAD * np.array([ledger.x[0], ledger.x[1], 0.0])
    g = sample.gravity
    off = cross(g, to_matrix(sample.q).T @ outward) / (params.book.mass * (g @ g))
    size = float(np.linalg.norm(off))
    return off * min(1.0, params.reach / max(size, 1e-12))


def weight_moment(ledger: balance.Ledger, sample: Sample, params: Params) -> Vector3:
    """Return the estimated m (r + s + C n), kg m, for the feed-forward."""
    book = params.book
    down = sample.gravity / float(np.linalg.norm(sample.gravity))
    com = balance.com_map(ledger, book) @ ledger.x
    return book.mass * (com + sample.shift + balance.sag_of(ledger, book) @ down)


def home_to_goal(ledger: balance.Ledger, params: Params) -> tuple[Vector3, Matrix3]:
    """Return the shift (m) that brings the centre of mass to its goal, and the covariance."""
    off, covariance = off_goal(ledger, -params.target, params.trim, params.book)
    return -off, covariance


def shift_for(state: State, sample: Sample, params: Params) -> State:
    """Return the state with the shift that this step requests."""
    assert state.ledger is not None
    follows = state.unloading or params.stages[state.stage].follows
    if not follows or sample.t < state.followed + FOLLOW:
        return state
    wanted = home_to_goal(state.ledger, params)[0] + unloading(state.ledger, sample, params)
    return replace(state, shift=wanted, followed=sample.t)


def retrimmed(
    state: State, sample: Sample, params: Params, doubt: float, late: bool = False
) -> State:
    """Return the state with the masses sent to the goal, if the change is beyond their errors.

    It must be beyond ``doubt`` sds of the goal, too; ``late``, no coarse mass must have to move.
    """
    assert state.ledger is not None
    wanted, covariance = home_to_goal(state.ledger, params)
    change: Vector3 = wanted - sample.shift
    stops = float(np.sum(balance.stop_variance(change, params.book)))
    unsure = stops + doubt**2 * float(np.trace(covariance))
    if (late and stops > COARSE**2) or change @ change < unsure:
        return state
    return replace(state, shift=wanted)


def guarded(state: State, sample: Sample, params: Params) -> State:
    """Return the state with the unloading begun, gone on with, or ended; the hold waits for it.

    Momentum that the wheels give to a turn comes back by itself and does not count.
    """
    assert state.ledger is not None
    size = float(np.linalg.norm(state.ledger.x[:2])) / params.momentum
    if not state.unloading:
        return replace(state, unloading=size > FULL)
    if size > EMPTY:
        return replace(state, due=state.due + PERIOD)
    return retrimmed(replace(state, unloading=False), sample, params, 0.0)


def entered_stage(state: State, sample: Sample, params: Params) -> State:
    """Return the state at the beginning of its stage: the turn there, the masses to the goal."""
    stage = params.stages[state.stage]
    base = state.level if state.level is not None else slews.levelled(sample.q, params.testbed.up)
    here = sample.q if state.turn is None else slews.reference_at(state.turn, np.inf).q
    way = slews.slew(here, slews.turned(base, stage.turn), sample.t, params.pace)
    state = replace(state, level=base, turn=way, due=slews.end_of(way) + stage.seconds)
    late = state.stage >= len(params.stages) - LATE
    return state if stage.follows else retrimmed(state, sample, params, DOUBT, late)


def advanced(state: State, sample: Sample, params: Params) -> State:
    """Return the state in the stage that this time is in."""
    if state.turn is None:
        return entered_stage(state, sample, params)
    if sample.t < state.due or state.closing is not None:
        return state
    if state.stage + 1 < len(params.stages):
        return entered_stage(replace(state, stage=state.stage + 1), sample, params)
    return closed(state, sample, params)


def closed(state: State, sample: Sample, params: Params) -> State:
    """Return the state with the last move requested, or the last pair of holds repeated.

    They are repeated when the sd of the goal is above CLEAR, or would be by the move: coarse masses
    stop with an error, now or when wheels were unloaded late. After the repetition only fine ones
    have to move.
    """
    moved = retrimmed(state, sample, params, 0.0)
    assert moved.shift is not None
    assert state.ledger is not None
    stops = balance.stop_variance(moved.shift - sample.shift, params.book)
    doubt = np.diag(home_to_goal(state.ledger, params)[1])
    if state.again or float((stops + doubt).max()) <= CLEAR**2:
        return homeward(moved, sample, params)
    return entered_stage(replace(moved, again=True, stage=state.stage - 1), sample, params)


def homeward(state: State, sample: Sample, params: Params) -> State:
    """Return the state on its way back to level, where a proof swing has the least sag."""
    assert state.turn is not None
    assert state.level is not None
    way = slews.slew(slews.reference_at(state.turn, np.inf).q, state.level, sample.t, params.pace)
    return replace(state, turn=way, closing=slews.end_of(way))


def ended(state: State, sample: Sample) -> bool:
    """Say whether the last move is made, or is waited for no longer."""
    if state.closing is None or state.ledger is None or sample.t < state.closing + SETTLED:
        return False
    stands = bool(np.linalg.norm(sample.shift - state.ledger.stood) <= balance.STANDS)
    return stands or sample.t > state.closing + PATIENCE


def following(ledger: balance.Ledger, params: Params) -> Following:
    """Return the sag and the drift that masses can follow from now on."""
    book = params.book
    off, _ = off_goal(ledger, -params.target, params.trim, book, 0.0)
    sag, trim = balance.sag_of(ledger, book), params.trim @ ledger.x[balance.TERM :]
    return Following(-off, ledger.t, balance.drift_of(ledger, book), sag, trim)


def report(ledger: balance.Ledger, shift: Vector3, params: Params) -> tuple[Reason, ...]:
    """Return where the centre of mass is estimated to be."""
    off, covariance = off_goal(ledger, shift - params.target, params.trim, params.book)
    numbers = axes_of("off", off) | axes_of("sd", np.sqrt(np.diag(covariance)))
    return one_reason(LawReason.OFF_TARGET_BY, **numbers)


def step(state: State, sample: Sample | Estimate, params: Params) -> tuple[State, Command]:
    """Return the next state and the command: torque at every step, masses when they should move."""
    assert isinstance(sample, Sample)  # it requests no measurement
    if state.ledger is None:
        ledger = balance.opened(params.testbed, params.book, sample)
    else:
        ledger = balance.entered(state.ledger, sample, params.book)
    state = advanced(replace(state, ledger=ledger), sample, params)
    if state.closing is None:
        state = shift_for(guarded(state, sample, params), sample, params)
    assert state.turn is not None
    reference = slews.reference_at(state.turn, sample.t)
    moment = weight_moment(ledger, sample, params)
    pid, u = torque(state.pid, sample, reference, params.gains, moment)
    requested = Command(shift=state.shift, torque=u)
    if ended(state, sample):
        said = report(ledger, sample.shift, params)
        requested = replace(requested, finished=said, following=following(ledger, params))
    return replace(state, pid=pid), requested


LAW = Law(
    LawCard(
        "momentum_buildup",
        (
            "Holds tilted attitudes by wheels; estimates the centre of mass, sag and "
            "drift from their momentum."
        ),
        "Equipoise; Hatcher and Young 1968 with wheels for jets",
        ("masses", "momentum", "gyro", "attitude"),
        (
            "sag, which masses at rest cannot trim: 12 uN m rms within 20 deg for 25 um; "
            "drift after the last move, unless masses follow both; momentum about the "
            "vertical. Air torque of one sign over minutes is attributed to an offset"
        ),
        (
            "steps of 0.1 s; offsets up to half of what the wheels can hold: 75 um at 14 "
            "kg and 5 mN m, above or below the pivot; wheels of 20 mN m s there"
        ),
        PERIOD,
        follows=True,
    ),
    begin,
    step,
)
