"""Impulse feedback: jets hold an attitude, and their impulse determines the centre of mass.

In laboratory axes the momentum L = R (J w + h) changes by gravity and by the jets' impulses alone.
Over a window of T seconds, with the masses' shift s(t) as reported,

    L_1 - L_0 = int R (m (r + s) x g_B) dt + sum R I
    A r = b,    A = -m int R [g_B x] dt,    b = L_1 - L_0 - sum R I - m int R (s x g_B) dt

r is that of the masses at home. While the attitude is held, A is singular along g_B, and with
Delta H = b turned back into the body its least solution is the printed

    r_perp = g_B x (Delta H - I) / (m g^2 T)

Printed with d += -k m (U M)^-1 r_perp, 0 < k < 1: here the law requests the shift, s += -k r_perp
of the remaining offset from the target. No model of J is needed where the rate is the same at both
ends of a window; Delta H is kept, so an error of J counts with the change of the rate only.

At one attitude the part along g_B is unobservable. The platform is held in turn at the attitudes of
a schedule, level and tilted about both horizontal axes; r of all windows together,

    (sum A^T A) r = sum A^T b

is then observable in all three directions. At the end of each round of the schedule the masses go
to target - r.

The jets are on-off: with n = -g_B / g and n_ref that of the schedule the rate is to be

    w_d = RETURN n_ref x n  (limited),    I = J (w_d - w)   about each axis where |w_d - w| > DEAD

Heading is left free; spin about the vertical is braked like any rate. With impulses even over a
step h and J wrong by a factor q, tilt and rate follow a matrix with determinant 1 - q + q RETURN h
/ 2, and all is stable for q < 2 and RETURN h < 2 (Jury). The speed of the masses does not matter:
their shift is known; their own momentum and moments are neglected.

Source: Hatcher and Young 1968, as da Silva et al. 2021 describe it; the equations are derived here.
"""

from dataclasses import dataclass, replace
from typing import Literal, NamedTuple

import numpy as np

from equipoise.control.law import Law, Sample
from equipoise.control.plant.actuator_limits import greatest_shift, limited
from equipoise.maths.attitude import to_matrix
from equipoise.maths.axes_across import axes_across
from equipoise.maths.linalg import cross, skew
from equipoise.model.arrays import Matrix3, Series, Vector3
from equipoise.model.command import Command
from equipoise.model.errors import InputError
from equipoise.model.estimate import Estimate
from equipoise.model.law_card import LawCard
from equipoise.model.reasons.law_reasons import LawReason
from equipoise.model.reasons.reason import Reason, axes_of, one_reason
from equipoise.model.testbed import Testbed

PERIOD = 0.2  # s, chosen: a step in which likely torques change the rate by a degree per second
WINDOW = 20.0  # s, T; chosen: gyro noise of 0.01 deg/s is then 0.03 um for 14 kg
SETTLING = 15.0  # s, chosen: to turn by TILT, and to come to rest
WINDOWS = 2  # at each attitude, chosen
ROUNDS = 2  # of the schedule, chosen: the second has little residual torque and thus little error
TILT = 0.2  # rad, chosen: shows the height with a fifth of its weight
SHARE = 0.6  # of the tilt limit that TILT may take, chosen
GAIN = 0.7  # k, chosen: below 1, for r_perp is an estimate
RETURN = 0.4  # 1/s, chosen: two and a half seconds to come back
FASTEST = 0.04  # rad/s, chosen: 2 deg/s while turning
DEAD = 2e-3  # rad/s, chosen: far above noise, far below FASTEST
COARSEST = 0.5  # of FASTEST, chosen: the greatest dead band that still holds an attitude
SPARE = 2.0  # chosen: jets' torque over the likely weight
LIKELY = 2.0  # sds, chosen
FLAT = 0.3  # chosen: singular values below this share are the direction along gravity

CARD = LawCard(
    name="impulse_feedback",
    idea="Jets hold the platform at several tilts; their impulse measures the unbalance.",
    source="Hatcher and Young 1968 (da Silva et al. 2021, section 4), with an attitude schedule",
    needs=("masses", "jets", "gyro", "attitude"),
    leaves=(
        "a steady torque of air or bearing, which is indistinguishable from unbalance; "
        "height is five times less accurate than the other axes"
    ),
    stable=(
        "0 < k < 1, whatever the speed of the masses; jets with twice the weight torque "
        "of the expected offset"
    ),
    period=PERIOD,
)


class Window(NamedTuple):
    """Sums since a window was opened."""

    begin: float  # s
    momentum: Vector3  # N m s, L_0
    A: Matrix3  # N s, so far
    given: Vector3  # N m s, laboratory: jets, and the weight of what masses shift


class Before(NamedTuple):
    """The last sample, for the trapezium rule."""

    t: float
    R: Matrix3
    gravity: Vector3
    shift: Vector3


@dataclass(frozen=True, slots=True, eq=False)
class Params:
    """The constants of a run."""

    mass: float
    inertia: Matrix3
    verticals: Series  # (a, 3) n_ref of the schedule
    dead: float  # rad/s
    reach: float  # m
    step: float  # m, what the masses' steps leave
    target: Vector3


@dataclass(frozen=True, slots=True, eq=False)
class State:
    """The progress of the law."""

    phase: Literal["settle", "window", "leave"]
    place: int  # in the schedule, rounds counted on
    since: float | None  # s, when the place was taken
    requested: Vector3  # m, shift
    information: Matrix3  # sum A^T A
    score: Vector3  # sum A^T b
    windows: int = 0  # closed at this place
    window: Window | None = None
    before: Before | None = None


# --- Begin -----------------------------------------------------------------------------------


def schedule(up: Vector3, tilt: float) -> Series:
    """Return the verticals, body axes: level, and tilted about both horizontal axes."""
    tilted = [np.cos(tilt) * up + np.sin(tilt) * across for across in axes_across(up)]
    return np.array([up, *tilted])


def weakest_jet(testbed: Testbed) -> float:
    """Return the torque (N m) about the body axis about which jets have least."""
    jets = testbed.jets
    about = np.array([jet.torque * np.abs(jet.axis) for jet in jets]).reshape(-1, 3)
    return float(about.max(axis=0, initial=0.0).min())


def likely_weight(testbed: Testbed) -> float:
    """Return the torque (N m) of an offset that few exceed."""
    offset = np.linalg.norm(testbed.body.com) + LIKELY * np.linalg.norm(testbed.com_sd)
    return float(testbed.weight * offset)


def refuse(found: str, wanted: str) -> InputError:
    """Return the error of a testbed on which the law would not hold the platform."""
    return InputError("law impulse_feedback", found, wanted)


def begin(testbed: Testbed, target: Vector3) -> tuple[State, Params]:
    """Return where the law begins; InputError where jets cannot hold the platform."""
    torque, weight = weakest_jet(testbed), likely_weight(testbed)
    if torque < SPARE * weight:
        wanted = f"{SPARE * weight:.3g} N m, twice the weight torque of the expected offset"
        raise refuse(f"jets of {torque:.3g} N m about some axis", wanted)
    reach = greatest_shift(testbed)
    if reach == 0:
        raise refuse("masses that cannot shift in every direction", "rails along three directions")
    inertia = testbed.body.inertia_P
    least = max((jet.torque * jet.min_pulse for jet in testbed.jets), default=0.0)
    dead = max(DEAD, least / float(np.diag(inertia).min()))
    if dead > COARSEST * FASTEST:
        wanted = f"{COARSEST * FASTEST:.2g} rad/s or less"
        raise refuse(f"minimum pulses that turn the platform by {dead:.2g} rad/s", wanted)
    verticals = schedule(testbed.up, min(TILT, SHARE * testbed.tilt_limit))
    step = sum(m.mass * m.resolution for m in testbed.masses) / testbed.body.mass
    params = Params(testbed.body.mass, inertia, verticals, dead, reach, step, target)
    return State("settle", 0, None, np.zeros(3), np.zeros((3, 3)), np.zeros(3)), params


# --- Jets ------------------------------------------------------------------------------------


def impulse_for(sample: Sample, vertical: Vector3, params: Params) -> Vector3 | None:
    """Return the impulse (N m s) that gives the rate back to ``vertical``; None within the band."""
    n = -sample.gravity / float(np.linalg.norm(sample.gravity))
    wanted = limited(RETURN * cross(vertical, n), FASTEST)
    off: Vector3 = wanted - sample.rate
    off = np.where(np.abs(off) > params.dead, off, 0.0)
    return params.inertia @ off if off.any() else None


# --- The momentum balance --------------------------------------------------------------------


def momentum_of(sample: Sample, R: Matrix3, params: Params) -> Vector3:
    """Return L, N m s, laboratory axes."""
    L: Vector3 = R @ (params.inertia @ sample.rate + sample.momentum)
    return L


def opened(sample: Sample, params: Params) -> Window:
    """Return a window that begins now."""
    R = to_matrix(sample.q)
    return Window(sample.t, momentum_of(sample, R, params), np.zeros((3, 3)), np.zeros(3))


def summed(window: Window, before: Before, sample: Sample, params: Params) -> Window:
    """Return the window with the step up to this sample added."""
    R, half = to_matrix(sample.q), params.mass * (sample.t - before.t) / 2
    first, last = before.R @ skew(before.gravity), R @ skew(sample.gravity)
    weight = -half * (first @ before.shift + last @ sample.shift)
    jets = 0.5 * (before.R + R) @ sample.impulse
    A = window.A - half * (first + last)
    return window._replace(A=A, given=window.given + weight + jets)


def unbalance_impulse(window: Window, sample: Sample, params: Params) -> Vector3:
    """Return b at the end of a window, N m s."""
    now = momentum_of(sample, to_matrix(sample.q), params)
    return now - window.momentum - window.given


def fed_back(window: Window, b: Vector3, shift: Vector3, params: Params) -> Vector3:
    """Return s - k r_perp, m: the part along gravity is not changed."""
    inverse = np.linalg.pinv(window.A, rcond=FLAT)
    observed_of: Vector3 = inverse @ (b + window.A @ (shift - params.target))
    return limited(shift - GAIN * observed_of, params.reach)


def closed(state: State, sample: Sample, params: Params) -> State:
    """Return the state with a window added to the estimate, and the masses sent on."""
    assert state.window is not None
    A, b = state.window.A, unbalance_impulse(state.window, sample, params)
    shift = fed_back(state.window, b, state.requested, params)
    state = replace(
        state,
        information=state.information + A.T @ A,
        score=state.score + A.T @ b,
        requested=shift,
        windows=state.windows + 1,
        window=opened(sample, params),
    )
    return state if state.windows < WINDOWS else moved_on(state, sample, params)


def moved_on(state: State, sample: Sample, params: Params) -> State:
    """Return the state at the next place of the schedule, or on the way out."""
    place = state.place + 1
    state = replace(state, phase="settle", place=place, since=sample.t, windows=0, window=None)
    if place % len(params.verticals):
        return state
    r = np.linalg.solve(state.information, state.score)
    state = replace(state, requested=limited(params.target - r, params.reach))
    return replace(state, phase="leave") if place == ROUNDS * len(params.verticals) else state


# --- Step ------------------------------------------------------------------------------------


def forward(state: State, sample: Sample, params: Params) -> State:
    """Return the state after a sample, before anything is commanded."""
    since = sample.t if state.since is None else state.since
    state = replace(state, since=since)
    if state.phase == "settle" and sample.t - since >= SETTLING:
        return replace(state, phase="window", window=opened(sample, params))
    if state.phase == "window":
        assert state.window is not None
        assert state.before is not None
        window = summed(state.window, state.before, sample, params)
        state = replace(state, window=window)
        if sample.t - window.begin >= WINDOW - PERIOD / 2:
            return closed(state, sample, params)
    return state


def has_left(state: State, sample: Sample, params: Params) -> bool:
    """Say whether the platform is level again and the masses have arrived."""
    assert state.since is not None
    there = float(np.linalg.norm(sample.shift - state.requested)) <= params.step + 1e-9
    return state.phase == "leave" and sample.t - state.since >= SETTLING and there


def step(state: State, sample: Sample | Estimate, params: Params) -> tuple[State, Command]:
    """Return the next state and command; the law requests no measurement."""
    assert isinstance(sample, Sample)
    old = state
    state = forward(state, sample, params)
    before = Before(sample.t, to_matrix(sample.q), sample.gravity, sample.shift)
    state = replace(state, before=before)
    vertical = params.verticals[state.place % len(params.verticals)]
    impulse = impulse_for(sample, vertical, params)
    if has_left(state, sample, params):
        done = one_reason(LawReason.ALL_ATTITUDES_MEASURED)
        return state, Command(shift=state.requested, finished=done)
    return state, Command(shift=state.requested, impulse=impulse, note=moved_by_jets(old, state))


def moved_by_jets(old: State, state: State) -> tuple[Reason, ...]:
    """Return the note of a step that moves the masses."""
    if state.requested is old.requested:
        return ()
    return one_reason(LawReason.MOVED_BY_JETS, **axes_of("shift", state.requested - old.requested))


LAW = Law(CARD, begin, step)
