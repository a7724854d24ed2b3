"""The compiled propagator against a few lines of NumPy, its own order, and finite differences."""

from dataclasses import replace

import numpy as np
import pytest

from equipoise.actuators.mass_errors import mass_errors
from equipoise.actuators.sliding_masses import mass_maps
from equipoise.dynamics.forcing import groups_of
from equipoise.dynamics.propagation import NO_COLUMNS, Columns, body_of, propagate
from equipoise.dynamics.regressor import DRIFT, N_TORQUES
from equipoise.dynamics.rigid_body import KNOWN_D
from equipoise.dynamics.sensitivities import ERROR, MOMENT, TORQUE, TURN
from equipoise.dynamics.sensitivities import INERTIA as INERTIA_KIND
from equipoise.dynamics.sensitivities import RATE as RATE_KIND
from equipoise.dynamics.timeline import timeline
from equipoise.maths.attitude import difference, exponential, multiply, normalise, to_matrix
from equipoise.maths.linalg import unpack_symmetric
from equipoise.model.mass_properties import parallel_axis
from equipoise.model.recording import Samples
from tests.support.builders import (
    ATTITUDE,
    COM,
    EVERY_TORQUE,
    GRAVITY,
    INERTIA,
    MASS,
    RATE,
    WARMING,
    body,
    line_of,
    move_at,
    sliding_masses,
)

FAST = np.array([0.3, -0.2, 0.5])  # rad/s: RK4 errors stand far above rounding
SKEWED = tuple(  # rails at odd angles, so that every entry of J changes
    replace(m, axis=normalise(m.axis + [0.3, -0.2, 0.4]), lag_sd=0.1)
    for m in sliding_masses(accuracy=1e-3)
)
FROM_HOME = move_at(5.0, 20.0)
MOVE = Samples(FROM_HOME.t, FROM_HOME.values + [0.02, 0, 0])  # x stands 20 mm out to begin with
WHEEL = Samples(np.array([0.0, 8.0, 12.0]), np.outer([1, 1, 4], [1e-3, -2e-3, 5e-4]))
PUSH = Samples(np.array([0.0, 3.0, 20.0]), np.outer([0, 2, 1], [1e-4, 2e-5, -1e-4]))


def travel(line, rigid, columns=NO_COLUMNS, q0=ATTITUDE, w0=FAST):
    return propagate(rigid, mass_maps(SKEWED), line, q0, w0, columns)


# --- A plain twin -----------------------------------------------------------------------------


def platform_at(d, speed):
    """Return J, mu and h with every mass a point on its rail."""
    J, mu, h = unpack_symmetric(INERTIA), MASS * COM, np.zeros(3)
    for mass, way, v in zip(SKEWED, d, speed, strict=True):
        place = mass.home + way * mass.axis
        J = J - parallel_axis(mass.mass, mass.home) + parallel_axis(mass.mass, place)
        mu = mu + mass.mass * way * mass.axis
        h = h + mass.mass * np.cross(place, v * mass.axis)
    return J, mu, h


def torques(w, g, t, warmth, c):
    """Return all torques, written out as vectors."""
    n, Q = g / GRAVITY, np.array([[c[8], c[10], c[11]], [c[10], c[9], c[12]], [c[11], c[12], 0]])
    Q[2, 2] = -c[8] - c[9]
    drag = -c[0:3] * w - c[3] * np.linalg.norm(w) * w
    return drag + c[4:7] - c[7] * n + MASS * np.cross(Q @ n + c[13:16] * t + c[16:19] * warmth, g)


def derivative(y, t, known, speed, c):
    q, H, d = y[:4], y[4:], known[KNOWN_D : KNOWN_D + 3]
    J, mu, h = platform_at(d, speed)
    w = np.linalg.solve(J, H - h - known[:3])
    g = to_matrix(q).T @ [0, 0, -GRAVITY]
    turning = 0.5 * multiply(q, np.array([0.0, *w]))
    pulled = np.cross(mu, g) + known[3:6] + torques(w, g, t, known[6], c)
    return np.concatenate([turning, pulled - np.cross(w, H)])


def twin(line, c, w0):
    """Classical Runge-Kutta in q and H, one step from node to node."""
    t, known = line.t - line.t[0], line.known
    speeds = np.diff(known[:, KNOWN_D : KNOWN_D + 3], axis=0) / np.diff(t)[:, None]
    J, _, h = platform_at(known[0, KNOWN_D : KNOWN_D + 3], speeds[0])
    y = [np.concatenate([ATTITUDE, J @ w0 + h + known[0, :3]])]
    for i, step in enumerate(np.diff(t)):
        half = 0.5 * (known[i] + known[i + 1])
        a = derivative(y[-1], t[i], known[i], speeds[i], c)
        b = derivative(y[-1] + step / 2 * a, t[i] + step / 2, half, speeds[i], c)
        e = derivative(y[-1] + step / 2 * b, t[i] + step / 2, half, speeds[i], c)
        f = derivative(y[-1] + step * e, t[i + 1], known[i + 1], speeds[i], c)
        new = y[-1] + step / 6 * (a + 2 * b + 2 * e + f)
        y.append(np.concatenate([normalise(new[:4]), new[4:]]))
    return np.array(y)


@pytest.mark.parametrize("torque", [np.zeros(N_TORQUES), EVERY_TORQUE], ids=["gravity", "every"])
def test_agrees_with_a_plain_twin(torque):
    """Same steps, other code: masses as points, torques as vectors. Rounding of 200 steps."""
    t = np.linspace(0, 20, 101)
    line = timeline(t, np.zeros(0), MOVE, 3, 1.0, WHEEL, PUSH, temperature=WARMING)
    motion, by_hand = travel(line, body(torque), w0=FAST), twin(line, torque, FAST)
    np.testing.assert_allclose(motion.q, by_hand[:, :4], rtol=0, atol=1e-12)
    np.testing.assert_allclose(motion.momentum, by_hand[:, 4:], rtol=0, atol=1e-12)
    np.testing.assert_allclose(motion.rate[0], FAST, atol=1e-15)


# --- Order ------------------------------------------------------------------------------------


def last_attitude(step, track):
    line = line_of(np.array([0.0, 20.0]), track, step)
    return travel(line, body(EVERY_TORQUE), w0=FAST).q[-1]


@pytest.mark.parametrize("track", [None, MOVE], ids=["fixed", "moving masses"])
def test_integrator_earns_order_four(track):
    """Halving the step divides the error by 16, masses moving or not: corners are nodes."""
    steps = np.array([1.0, 0.5, 0.25, 0.125])
    exact = last_attitude(1 / 64, track)
    errors = [np.linalg.norm(difference(last_attitude(h, track), exact)) for h in steps]
    slope = np.polyfit(np.log(steps), np.log(errors), 1)[0]
    assert slope == pytest.approx(4.0, abs=0.3)


# --- Sensitivities ----------------------------------------------------------------------------

KINDS = {TURN: 3, RATE_KIND: 3, INERTIA_KIND: 6, MOMENT: 3, TORQUE: N_TORQUES, ERROR: 5}
PAIRS = np.array([(kind, k) for kind, n in KINDS.items() for k in range(n)])
COLUMNS = Columns(PAIRS[:, 0].copy(), PAIRS[:, 1].copy())
TIMES = np.linspace(0, 20, 41)


def response_line():
    """A timeline whose four stops have an unknown error each, the first from the start; a lag."""
    errors = mass_errors(MOVE, SKEWED)
    return timeline(TIMES, np.zeros(0), MOVE, 3, 0.05, WHEEL, PUSH, errors.response, errors.owner,
                    temperature=WARMING)  # fmt: skip


def moved_by(line, torque, kind, k, change):
    """Return the motion with one parameter changed."""
    point = {n: np.zeros(size) for n, size in KINDS.items()}
    point[kind][k] = change
    known = line.known.copy()
    for j, (owner, unknown) in enumerate(line.owners):
        known[:, KNOWN_D + owner] += point[ERROR][unknown] * known[:, KNOWN_D + 3 + j]
    inertia, moment = INERTIA + point[INERTIA_KIND], MASS * COM + point[MOMENT]
    rigid = body_of(MASS, GRAVITY, inertia, moment, torque + point[TORQUE])
    q0 = multiply(ATTITUDE, exponential(point[TURN]))
    return travel(line._replace(known=known), rigid, q0=q0, w0=RATE + FAST + point[RATE_KIND])


@pytest.fixture(
    scope="module", params=[np.zeros(N_TORQUES), EVERY_TORQUE], ids=["gravity", "every torque"]
)
def sensed(request):
    line, torque = response_line(), request.param
    return line, torque, travel(line, body(torque), COLUMNS, w0=RATE + FAST)


@pytest.mark.parametrize("column", range(len(PAIRS)), ids=[f"{kind}-{k}" for kind, k in PAIRS])
def test_sensitivity_is_the_finite_difference(sensed, column):
    """Every kind, across a move. Central differences of 1e-4 rad leave 1e-8, rounding the same.

    The propagator integrates the sensitivities instead of differentiating its own steps: at steps
    of 0.05 s and 0.6 rad/s that leaves (0.03)^4 = 1e-6. Asked for: 1e-5 of the column's size.
    """
    line, torque, motion = sensed
    turn_by, rate_by = motion.turn_by[:, :, column], motion.rate_by[:, :, column]
    change = 1e-4 / np.abs(turn_by).max()
    more, less = (moved_by(line, torque, *PAIRS[column], s * change) for s in (1, -1))
    turned = difference(more.q, motion.q) - difference(less.q, motion.q)
    sped = more.rate - less.rate
    for found, numeric in ((turn_by, turned / (2 * change)), (rate_by, sped / (2 * change))):
        np.testing.assert_allclose(found, numeric, rtol=0, atol=1e-5 * np.abs(numeric).max())


@pytest.mark.parametrize("axis", range(3))
def test_drift_sensitivity_is_right_where_nothing_else_changes(axis):
    """The platform is then read once a step, the time is not: central differences as above."""
    line, column = line_of(TIMES), Columns(np.array([TORQUE]), np.array([DRIFT + axis]))
    motion = travel(line, body(np.zeros(N_TORQUES)), column, w0=RATE + FAST)
    found = motion.turn_by[:, :, 0]
    change = 1e-4 / np.abs(found).max()
    more, less = (
        moved_by(line, np.zeros(N_TORQUES), TORQUE, DRIFT + axis, s * change) for s in (1, -1)
    )
    turned = difference(more.q, motion.q) - difference(less.q, motion.q)
    numeric = turned / (2 * change)
    np.testing.assert_allclose(found, numeric, rtol=0, atol=1e-5 * np.abs(numeric).max())


def test_no_columns_and_all_columns_give_one_motion(sensed):
    """Asking for sensitivities changes nothing but rounding."""
    line, torque, motion = sensed
    plain = travel(line, body(torque), w0=RATE + FAST)
    np.testing.assert_allclose(plain.q, motion.q, rtol=0, atol=1e-13)
    np.testing.assert_allclose(plain.rate, motion.rate, rtol=0, atol=1e-13)


def test_columns_come_in_the_requested_order(sensed):
    """Any subset in any order."""
    line, torque, motion = sensed
    chosen = np.array([30, 2, 33, 8])
    some = Columns(COLUMNS.kinds[chosen], COLUMNS.indices[chosen])
    found = travel(line, body(torque), some, w0=RATE + FAST)
    np.testing.assert_allclose(found.turn_by, motion.turn_by[:, :, chosen], rtol=1e-10, atol=1e-12)


TURNS, INERTIAS, MOMENTS, DRAGS = np.r_[0:3], np.r_[6:12], np.r_[12:15], np.r_[15:27]
ORDERS = {
    "backwards": np.arange(len(PAIRS))[::-1],
    "across two blocks": np.r_[DRAGS, INERTIAS, MOMENTS],
    "a part of each": np.r_[TURNS, INERTIAS[:5], MOMENTS[1:]],
    "alone": np.r_[INERTIAS, MOMENTS],
    "moments first": np.r_[MOMENTS, TURNS, INERTIAS],
}


@pytest.mark.parametrize("chosen", ORDERS.values(), ids=ORDERS)
def test_columns_that_stand_together_and_others_are_the_same(sensed, chosen):
    """J and mu are written at once where all their columns stand together, else one by one."""
    line, torque, motion = sensed
    some = Columns(COLUMNS.kinds[chosen], COLUMNS.indices[chosen])
    found = travel(line, body(torque), some, w0=RATE + FAST)
    np.testing.assert_allclose(found.turn_by, motion.turn_by[:, :, chosen], rtol=1e-10, atol=1e-12)
    np.testing.assert_allclose(found.rate_by, motion.rate_by[:, :, chosen], rtol=1e-10, atol=1e-12)


@pytest.mark.parametrize(
    ("chosen", "expected"),
    [
        (ORDERS["backwards"], (-1, -1, True)),
        (ORDERS["across two blocks"], (-1, 18, True)),
        (ORDERS["a part of each"], (-1, -1, True)),
        (ORDERS["alone"], (0, 6, False)),
        (ORDERS["moments first"], (6, 0, False)),
        (np.r_[TURNS, INERTIAS, MOMENTS, DRAGS], (3, 9, True)),
        (TURNS, (-1, -1, False)),
    ],
)
def test_where_columns_stand_together(chosen, expected):
    found = groups_of(Columns(COLUMNS.kinds[chosen], COLUMNS.indices[chosen]))
    assert tuple(found) == expected
