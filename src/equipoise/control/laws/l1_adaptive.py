"""L1 adaptive balancing by sliding masses: the unbalance torque is estimated, filtered, cancelled.

On each of two horizontal axes of a platform that hangs (``hanging``), x = (tilt, rate),

    x' = A_m x + b (u_ad + th^T x + s),   A_m = [0, 1; -w_m^2, -2 z w_m],   b = (0, 1)
    a v = f u_m + u_ad,   u_m = -(w_m^2 - w0^2) tilt - 2 z w_m rate

The matched disturbance s = a u x r is the unbalance torque over J; th is the error of the assumed a
and height. Predictor, adaptation and control (Cao and Hovakimyan 2006, 2008), with
e = x_hat - x:

    x_hat' = [0, 1; -w0^2, 0] x + b (a v_done + th_hat^T x + s_hat) + A_s e
    th_hat' = G Proj(th_hat, -e^T P b x),   s_hat' = G Proj(s_hat, -e^T P b)
    u_ad = -C(s) (th_hat^T x + s_hat),   C = w_c / (s + w_c)

A yaw rate W couples tilt and rate of the two axes; the predictor includes that, step by step:

    tilt_1' += W tilt_2,  tilt_2' -= W tilt_1     (theta' = w - W u x theta)
    rate_1' += W (J_2 - J_u) / J_1 rate_2,   rate_2' += W (J_u - J_1) / J_2 rate_1

v_done is the reported shift: late, limited or missing motion of the masses then does not count as
a disturbance, and nothing winds up. A_s = [0, 1; -w^2, -2 w] makes e quicker than A_m would (the
companion predictor of the same authors). With Q = diag(w^2, 1), A_s^T P + P A_s = -Q gives P b =
(1, 1/w) / 2; with G = w^3 the poles are -w and w (-1 +- j) / 2 where x is small.

Sampled with a step h, x_hat is exact for inputs held over it, and n = th_hat^T x + s_hat, less what
is true, follows with y = e^T P b (a left eigenvector of A_s)

    y+ = exp(-w h) y + (h^2 / 2 + h / w) n / 2,      n+ = n - h G (1 + |x|^2) y+

which is stable for G (1 + |x|^2) < 4 (1 + exp(-w h)) / (h^2 (h / 2 + 1 / w)) (Jury). The whole is
stable for a bounded th if ||(sE - A_m)^-1 b (1 - C)||_L1 L < 1 with L the largest |th|_1
(``l1_norm``). That condition does not include late masses, so ``begin`` also checks the eigenvalues
of the sampled loop. It raises InputError where one of the three fails.

Only the measurements at the end determine the height (``height_adjustment``). Sources: Cao and
Hovakimyan 2006 and 2008; for balancing Xuan 2016 and Hua 2018, by da Silva et al. 2021 section 4.
"""

from dataclasses import dataclass, field, replace
from typing import NamedTuple

import numpy as np

from equipoise.control.elements import height_adjustment as heights
from equipoise.control.elements.l1_norm import l1_norm
from equipoise.control.elements.loop_stability import radius, steps_late, swing_input, swing_matrix
from equipoise.control.law import Law, Sample
from equipoise.control.plant import pendulum
from equipoise.control.plant.actuator_limits import limited
from equipoise.control.plant.moving_means import Bounds
from equipoise.control.plant.settling import PERIOD, finest_bounds
from equipoise.control.plant.tilt_axes import SPARE
from equipoise.model.arrays import Floats, Square, Vector3
from equipoise.model.command import Command
from equipoise.model.errors import InputError
from equipoise.model.estimate import Estimate
from equipoise.model.law_card import LawCard
from equipoise.model.testbed import Testbed

DAMPING = 0.7  # z, chosen
PREDICTOR = 4.0  # w over w_m, chosen: four times as fast, with a step of half its time at most
FILTER = 2.5  # w_c over w_m, chosen: faster than the loop, slower than the predictor
SURE = 3.0  # sds of the height and of the inertia that th allows for, chosen
FASTEST = 1.0  # rad/s, chosen: rates at which the adaptation must still be stable
FLATTEST = 0.01  # chosen: of the depth; a platform that is being lowered may not hang at all yet
MARGIN = 2.0  # chosen: the platform's swing may be this much faster or slower, squared

CARD = LawCard(
    name="l1_adaptive",
    idea=(
        "A predictor of tilt and rate adapts to the unbalance torque; masses cancel its "
        "filtered estimate."
    ),
    source="Cao and Hovakimyan 2006, 2008; Xuan 2016, Hua 2018 (da Silva et al. 2021, section 4)",
    needs=("masses", "gyro", "attitude"),
    leaves="the height, which only the final measurements determine, limited by the inertia",
    stable=(
        "hanging; sensors and fine masses with up to 0.8 s of delay at 14 kg and steps of "
        "0.25 s; spin to 17 deg/s; half to twice the nominal stiffness"
    ),
    period=PERIOD,
)


class Axis(NamedTuple):
    """The numbers of one axis."""

    gain: float  # a
    wanted: float  # w_m, rad/s
    predictor: float  # w, rad/s
    share: float  # of the way that C goes in a step
    most: float  # L, bound of |th_hat|
    furthest: float  # rad/s^2, bound of s_hat


@dataclass(frozen=True, slots=True, eq=False)
class Params:
    """The constants of a run."""

    plant: pendulum.Hanging
    axes: tuple[Axis, Axis]
    gyroscopic: Floats  # (2,) (J_2 - J_u) / J_1 and (J_u - J_1) / J_2
    quiet: Bounds


class Before(NamedTuple):
    """The last sample, as the loop uses it."""

    x: Floats  # (2, 2) tilt and rate
    frequency: Floats  # (2,) w0, rad/s
    shift: Vector3  # m
    spin: float  # rad/s, about u


@dataclass(frozen=True, slots=True, eq=False)
class State:
    """Where it stands; rows of arrays are the two axes."""

    search: heights.HeightSearch
    e: Floats = field(default_factory=lambda: np.zeros((2, 2)))  # rad, rad/s
    th: Floats = field(default_factory=lambda: np.zeros((2, 2)))  # 1/s^2, 1/s
    s: Floats = field(default_factory=lambda: np.zeros(2))  # rad/s^2
    u_ad: Floats = field(default_factory=lambda: np.zeros(2))  # rad/s^2
    before: Before | None = None


# --- Predictor and adaptation ----------------------------------------------------------------


def error_matrix(w: float, h: float) -> Square:
    """Return exp(A_s h), A_s = [0, 1; -w^2, -2 w]."""
    return np.exp(-w * h) * np.array([[1 + w * h, h], [-(w**2) * h, 1 - w * h]])


def largest_adaptation(w: float, h: float) -> float:
    """Return the G (1 + |x|^2) at which the sampled estimates begin to swing up."""
    return 4 * (1 + np.exp(-w * h)) / (h**2 * (h / 2 + 1 / w))


def predicted(axis: Axis, x: Floats, e: Floats, frequency: float, n: float) -> Floats:
    """Return x_hat a step later; ``n`` is a v_done + th_hat^T x + s_hat, rad/s^2."""
    free = swing_matrix(frequency, PERIOD) @ x + swing_input(frequency, PERIOD) * n
    return free + error_matrix(axis.predictor, PERIOD) @ e


def adapted(axis: Axis, e: Floats, x: Floats, th: Floats, s: float) -> tuple[Floats, float]:
    """Return th_hat and s_hat after a step, kept within their bounds (projection)."""
    slope = -(axis.predictor**3) * (0.5 * e[0] + 0.5 / axis.predictor * e[1])
    th = limited(th + PERIOD * slope * x, axis.most)
    return th, float(np.clip(s + PERIOD * slope, -axis.furthest, axis.furthest))


# --- Begin -----------------------------------------------------------------------------------


def axes_of(plant: pendulum.Hanging, testbed: Testbed) -> tuple[Axis, Axis]:
    """Return the numbers of both axes."""
    made = list[Axis]()
    for a, w0 in zip(plant.gain, plant.frequency, strict=True):
        wrong = SURE * (plant.depth_sd / plant.depth + testbed.inertia_sd / SURE) * w0**2
        share = 1 - np.exp(-FILTER * w0 * PERIOD)
        numbers = (a, w0, PREDICTOR * w0, share, wrong, a * plant.reach)
        made.append(Axis(*(float(each) for each in numbers)))
    return made[0], made[1]


def closed(axis: Axis, frequency: float, late: int) -> Square:
    """Return the sampled loop of one axis: x, e, s_hat, u_ad and the ``late`` last inputs.

    The platform swings at ``frequency``, where the predictor takes it for w_m.
    """
    size = 6 + late
    x, last = np.eye(size)[:2], np.eye(size)[-1]
    e, s, u_ad = np.eye(size)[2:4], np.eye(size)[4], np.eye(size)[5]
    new_x = swing_matrix(frequency, PERIOD) @ x
    new_x += np.outer(swing_input(frequency, PERIOD), last)
    new_hat = swing_matrix(axis.wanted, PERIOD) @ x
    new_hat += np.outer(swing_input(axis.wanted, PERIOD), last + s)
    new_e = new_hat + error_matrix(axis.predictor, PERIOD) @ e - new_x
    w = axis.predictor
    new_s = s - PERIOD * w**3 * (0.5 * new_e[0] + 0.5 / w * new_e[1])
    new_u = u_ad + axis.share * (-s - u_ad)
    requested = u_ad - 2 * DAMPING * axis.wanted * x[1]
    rows = [new_x, new_e, new_s[None], new_u[None], requested[None], np.eye(size)[6:-1]]
    return np.concatenate(rows).astype(np.float64)


def refuse(found: str) -> InputError:
    """Return the error of a testbed on which the law is not stable."""
    return InputError("law l1_adaptive", found, "a slower swing, or better-known mass properties")


def check(axis: Axis, plant: pendulum.Hanging, testbed: Testbed) -> None:
    """Raise InputError where adaptation, L1 condition or the sampled loop is not stable."""
    w, h = axis.predictor, PERIOD
    strength = w**3 * (1 + np.sin(testbed.tilt_limit) ** 2 + FASTEST**2)
    if strength >= largest_adaptation(w, h):
        raise refuse(f"an adaptation too fast for steps of {h} s: w h = {w * h:.2g}")
    wanted = np.array([[0.0, 1.0], [-(axis.wanted**2), -2 * DAMPING * axis.wanted]])
    size = axis.most * l1_norm(wanted, np.array([0.0, 1.0]), FILTER * axis.wanted)
    if size >= 1:
        raise refuse(f"an L1 condition of {size:.2g}, not below 1")
    late = steps_late(plant.delay + plant.filling, h)
    for factor in (1 / MARGIN, 1.0, MARGIN):
        loop = closed(axis, axis.wanted * factor**0.5, late)
        if radius(loop) >= 1:
            raise refuse(f"an unstable loop at {factor:.2g} times the depth, {late} steps late")


def begin(testbed: Testbed, target: Vector3) -> tuple[State, Params]:
    """Return where the law begins; InputError where it would not be stable."""
    plant = pendulum.hanging(testbed)
    axes = axes_of(plant, testbed)
    for axis in axes:
        check(axis, plant, testbed)
    one, two = plant.axes
    J = [float(axis @ testbed.body.inertia_P @ axis) for axis in (one, two, plant.up)]
    gyroscopic = np.array([(J[1] - J[2]) / J[0], (J[2] - J[0]) / J[1]])
    params = Params(plant, axes, gyroscopic, finest_bounds(plant))
    return State(heights.height_search(plant, target)), params


# --- Step ------------------------------------------------------------------------------------


def frequencies(state: State, sample: Sample, plant: pendulum.Hanging) -> Floats:
    """Return w0 about both axes while masses raise or lower the platform, rad/s."""
    height = state.search.height
    above = float(plant.up @ sample.shift) - height.along
    return np.sqrt(plant.gain * max(height.depth - above, FLATTEST * plant.depth))


def turned_about_up(x: Floats, spin: float, params: Params) -> Floats:
    """Return the slope of x by a turn about the vertical (rad/s)."""
    (tilt_1, rate_1), (tilt_2, rate_2) = x
    one, two = params.gyroscopic
    return spin * np.array([[tilt_2, one * rate_2], [-tilt_1, two * rate_1]])


def learnt(state: State, x: Floats, sample: Sample, params: Params) -> State:
    """Return the state with the error of the prediction for now, and what that teaches."""
    before, plant = state.before, params.plant
    if before is None:
        return replace(state, e=np.zeros((2, 2)))
    v = pendulum.turned(plant, (before.shift + sample.shift) / 2)
    th, s, e = np.zeros((2, 2)), np.zeros(2), np.zeros((2, 2))
    turning = turned_about_up(before.x, before.spin, params)
    for i, axis in enumerate(params.axes):
        n = axis.gain * float(v[i]) + matched(state, before.x)[i]
        x_hat = predicted(axis, before.x[i], state.e[i], float(before.frequency[i]), n)
        e[i] = x_hat + PERIOD * turning[i] - x[i]
        th[i], s[i] = adapted(axis, e[i], x[i], state.th[i], float(state.s[i]))
    return replace(state, th=th, s=s, e=e)


def matched(state: State, x: Floats) -> Floats:
    """Return th_hat^T x + s_hat about both axes, rad/s^2."""
    return np.sum(state.th * x, axis=1) + state.s


def filtered(state: State, x: Floats, params: Params) -> Floats:
    """Return u_ad after a step, no faster than masses can follow, rad/s^2."""
    share = np.array([axis.share for axis in params.axes])
    way = share * (-matched(state, x) - state.u_ad) / params.plant.gain
    most = params.plant.slew * PERIOD * (1 - SPARE)
    return state.u_ad + params.plant.gain * limited(way, most)


def controlled(state: State, x: Floats, w0: Floats, params: Params) -> Vector3:
    """Return the requested shift (m)."""
    plant = params.plant
    wanted = np.array([axis.wanted for axis in params.axes])
    p, d = (wanted**2 - w0**2).clip(0) / plant.gain, 2 * DAMPING * wanted / plant.gain
    f = pendulum.spared(plant, p, d, x[:, 0], x[:, 1])
    v = state.u_ad / plant.gain - f * (p * x[:, 0] + d * x[:, 1])
    return heights.shift_at_height(state.search, v)


def sample_step(state: State, sample: Sample, params: Params) -> tuple[State, Command]:
    """Return the next state and command after a sample."""
    plant = params.plant
    tilt, rate = pendulum.tilt_of(plant, sample), pendulum.rate_of(plant, sample)
    x, w0 = np.column_stack([tilt, rate]), frequencies(state, sample, plant)
    spin = float(plant.up @ sample.rate)
    state = learnt(state, x, sample, params)
    state = replace(state, u_ad=filtered(state, x, params))
    shift = controlled(state, x, w0, params)
    search, command = heights.levelling(state.search, sample, shift, params.quiet)
    return replace(state, search=search, before=Before(x, w0, sample.shift, spin)), command


def level_again(state: State, params: Params) -> tuple[State, Command]:
    """Return the first step after a measurement that raised the platform."""
    plant, search = params.plant, state.search
    assert search.level is not None
    shift = (
        pendulum.shift_for(plant, pendulum.turned(plant, search.level))
        + search.height.along * plant.up
    )
    return replace(state, before=None), Command(shift=shift, note=heights.raised_note(search))


def step(state: State, sample: Sample | Estimate, params: Params) -> tuple[State, Command]:
    """Return the next state and command."""
    search, command = heights.continued(state.search, sample)
    state = replace(state, search=search)
    if command is not None:
        return state, command
    if isinstance(sample, Estimate):
        return level_again(state, params)
    return sample_step(state, sample, params)


LAW = Law(CARD, begin, step)
