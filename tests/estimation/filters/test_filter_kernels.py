"""The filters' kernels are the textbook's filters: twins, derivatives, limits."""

from dataclasses import replace

import numpy as np
import pytest

from equipoise.dynamics.regressor import WIDTH
from equipoise.dynamics.rigid_body import body_at, gravity_of, times
from equipoise.estimation.filters import driver
from equipoise.estimation.filters.jacobian import change_of, write_jacobian
from equipoise.estimation.filters.model import Walks, axes_of, first_covariance, model_of
from equipoise.estimation.filters.predict import Drive, placed, slope
from equipoise.estimation.filters.rows import Rows, camera_rows, gyro_rows, taken
from equipoise.estimation.methods import (
    ekf_6,
    ekf_9,
    ekf_12,
    kf_simplified,
    ukf_4,
    ukf_6,
    ukf_9,
    ukf_12,
)
from equipoise.maths.attitude import difference, exponential, multiply
from equipoise.maths.kernels.compiled import kernel
from equipoise.maths.linalg import unpack_symmetric
from equipoise.model.estimate import COM as COM_NAMES
from equipoise.model.mass_properties import MassProperties
from equipoise.model.recording import Samples
from tests.estimation.filters import plain_filters as plain
from tests.support import thorough
from tests.support.builders import (
    COM,
    GYRO_SD,
    INERTIA,
    MASS,
    RATE,
    move_at,
    noisy,
    platform,
    recording,
)

KINDS = {
    m.METHOD.card.name: m.KIND
    for m in (kf_simplified, ekf_6, ekf_9, ekf_12, ukf_4, ukf_6, ukf_9, ukf_12)
}
PLAIN = list(KINDS) if thorough.THOROUGH else ["kf_simplified", "ekf_9", "ekf_12", "ukf_4"]
END = 30.0
PUSH = Samples(np.array([0.0, 7, 7.03, 20, END]), np.outer([1, 1, -1, 1, 2], [2e-4, -1e-4, 3e-4]))
WHEEL = Samples(np.array([0.0, 12, 18]), np.outer([1, 1, 4], [2e-4, -1e-4, 3e-4]))
WALKS = Walks(3e-6, 2e-7)


def bench(inertia_sd=0.05):
    """A platform whose guess is off: com by 0.3 sd, moments by up to 4 %."""
    testbed = platform(gyro=True)
    guess = MassProperties(
        MASS, COM + [20e-6, -30e-6, 25e-6], unpack_symmetric(INERTIA * [1.04, 0.97, 1.02, 1, 1, 1])
    )
    tilted = np.array([0.1, -0.2, 1.0]) / np.linalg.norm([0.1, -0.2, 1.0])
    return replace(testbed, body=guess, inertia_sd=inertia_sd, up=tilted)


@pytest.fixture(scope="module")
def observed():
    """A move, a torque, a wheel, and a gap of both sensors: what the filters have to know."""
    record = noisy(recording(END, move_at(10.0, END), 5.0, 10.0), 3)

    def gapped(channel):
        keep = (channel.t < 21) | (channel.t > 24)
        return Samples(channel.t[keep], channel.values[keep])

    return replace(
        record, attitude=gapped(record.attitude), rate=gapped(record.rate), torque=PUSH,
        momentum=WHEEL,
    )  # fmt: skip


def rows_of(kind, record, testbed):
    if kind.attitude:
        return camera_rows(record, testbed), testbed.attitude.noise
    return gyro_rows(record, testbed)[0], testbed.gyro.noise


@pytest.mark.parametrize("name", PLAIN)
def test_kernels_are_the_plain_filters(observed, name):
    """To 1e-6 sd of every parameter after every row, and of every covariance.

    Through a move, a torque with an edge between two rows, a wheel and a gap.
    """
    kind, testbed = KINDS[name], bench()
    rows, noise = rows_of(kind, observed, testbed)
    end, passed = driver.advance(driver.begin(kind, testbed, noise, WALKS), rows)
    twin = plain.Plain(kind, testbed, axes_of(kind, testbed.up), noise, WALKS)
    found = plain.run(twin, rows, plain.begun(twin))
    values = np.array([[*b.com, *plain.six(b.J)] for b in found])
    separation = (values @ end.shown.T - passed.course.values) / passed.course.sd
    assert np.abs(separation).max() < 1e-6
    scale = np.sqrt(np.diag(end.covariance))
    assert np.abs((found[-1].P - end.covariance) / np.outer(scale, scale)).max() < 1e-6
    np.testing.assert_allclose(found[-1].H, end.mean[4:7], rtol=1e-7)
    assert np.array_equal(end.covariance, end.covariance.T)


# --- derivatives ----------------------------------------------------------------------------------


@kernel
def _jacobian(model, body, dt, known, q, w, share, F):  # noqa: PLR0913, PLR0917 - a kernel
    """F of a platform with com and J of ``body`` at a share of a step."""
    rigid, t = placed(model.body, body), np.array([0.0, dt])
    here = body_at(rigid, model.maps, t, known, 0, 0.0)
    end = body_at(rigid, model.maps, t, known, 0, 1.0)
    now, dy, y = body_at(rigid, model.maps, t, known, 0, share), np.zeros(7), np.empty(7)
    rate = (w[0], w[1], w[2])
    H = times(now.inertia, rate)
    y[:4] = q
    for j in range(3):
        y[4 + j] = H[j] + now.momentum[j]
    g = gravity_of(y, model.body.gravity)
    slope(model, rigid, now, g, y, np.zeros((3, WIDTH)), dy)
    push, change = (dy[4], dy[5], dy[6]), change_of(here, end, dt)
    write_jacobian(model, now, change, rate, push, g, np.zeros((3, 6)), np.zeros((3, 6)), F)


def slopes_of(kind, testbed, step, q, w):
    """The right-hand side dth', w' as a function of the error state, and where it may be complex.

    Of the simplified model: f + s (f_whole - f), and the error of J in f_whole.
    """
    (a, b, dt, share), axes = step, axes_of(kind, testbed.up)
    o, g = (3 if kind.attitude else 0), plain.gravity_of(q, testbed.gravity)
    six = INERTIA if kind.gyroscopic else INERTIA * [1, 1, 1, 0, 0, 0]

    def accelerated(J, com, rate, weight, swirl):
        ends = [plain.platform_at(testbed, com, J, (a, b, dt), s) for s in (0, 1)]
        change = (ends[1].J - ends[0].J) / dt, (ends[1].h - ends[0].h) / dt
        here = plain.platform_at(testbed, com, J, (a, b, dt), share)
        return plain.acceleration(here, change, rate, weight, swirl)

    def slopes(x):
        x = np.append(x, np.zeros(o + 13 - len(x)))
        com, dJ = COM + axes @ x[o + 3 : o + 6], plain.full(x[o + 6 : o + 12])
        rate, weight = w + x[o : o + 3], g + (np.cross(g, x[:3]) if o else 0)
        if kind.gyroscopic:
            out = accelerated(plain.full(six) + dJ, com, rate, weight, True)
            return np.concatenate([x[3:6] - np.cross(w, x[:3]), out]) if o else out
        out = accelerated(plain.full(six), com, rate, weight, False)
        whole = accelerated(plain.full(INERTIA), com, rate, weight, True)
        wrong = accelerated(plain.full(INERTIA) + dJ, com, rate, weight, True)
        return out + x[o + 12] * (whole - out) + wrong - whole

    return slopes


@pytest.mark.parametrize("name", KINDS)
def test_jacobian_is_the_complex_step(name):
    """Im f(x + i h e_j) / h, h = 1e-20 (review Eq. 38, three columns, divided by h).

    To 1e-12 of each block's size: masses under way, wheel and torque changing.
    """
    kind, testbed = KINDS[name], bench()
    testbed = replace(testbed, body=MassProperties(MASS, COM, unpack_symmetric(INERTIA)))
    rng = np.random.default_rng(5)
    stored, torque = 1e-2 * rng.normal(size=3), 1e-3 * rng.normal(size=3)
    a = np.concatenate([stored, torque, [0.0], [0.01, -0.02, 0.03]])
    b = a + np.concatenate([1e-3 * rng.normal(size=6), [0.0], [0.001, 0.002, -0.001]])
    q, w, dt = exponential(np.array([0.2, -0.1, 2.0])), np.array([0.3, -0.5, 0.7]), 0.1
    model = model_of(kind, testbed, 1.0, WALKS)
    rows, n = (6, 15) if kind.attitude else (3, 12 if kind.gyroscopic else 13)
    F, known = np.zeros((rows, n)), np.vstack([a, b])
    body = np.concatenate([COM, INERTIA if kind.gyroscopic else INERTIA * [1, 1, 1, 0, 0, 0]])
    _jacobian(model, body, dt, known, q, w, 0.3, F)
    slopes, h = slopes_of(kind, testbed, (a, b, dt, 0.3), q, w), 1e-20
    wanted = np.column_stack([slopes(1j * h * e).imag / h for e in np.eye(n)])
    for k in range(0, n, 3):
        size = max(np.abs(wanted[:, k : k + 3]).max(), 1e-2)  # J' is a difference over 0.1 s
        np.testing.assert_allclose(F[:, k : k + 3], wanted[:, k : k + 3], atol=1e-12 * size, rtol=0)


# --- one step -------------------------------------------------------------------------------------


def step_of(dt):
    """One step in which masses travel, a wheel and a torque change."""
    a = np.array([1e-3, -2e-3, 1e-3, 1e-3, 2e-3, -1e-3, 0.0, 0.0, 0.0, 0.0])
    b = a + dt * np.array([1e-3, 1e-3, -2e-3, 1e-3, 0, 1e-3, 0, 0.01, -0.01, 0.01])
    q = exponential(np.array([0.2, -0.1, 2.0]))
    q = np.array([q, multiply(q, exponential(dt * 10 * RATE))])
    return Drive(np.array([0.0, dt]), np.vstack([a, b]), q, np.zeros((2, 3, 3)))


def start_of(kind, testbed, drive):
    """A state that turns ten times as fast as the shared platform."""
    six = INERTIA if kind.gyroscopic else INERTIA * [1, 1, 1, 0, 0, 0]
    here = plain.platform_at(testbed, COM, plain.full(six), (*drive.known, drive.t[1]), 0)
    return np.concatenate([drive.q[0], here.J @ (10 * RATE) + here.h, COM, six])


def covariance_of(kind, testbed, model):
    """Attitude, rate and parameters unsure, and correlated as after some rows."""
    P = first_covariance(kind, model, testbed)
    rows = 6 if kind.attitude else 3
    sd = np.append(np.full(rows - 3, 0.02), np.full(3, 0.02))
    P[:rows, :rows] = np.diag(sd**2)
    size = np.sqrt(np.diag(P))
    mix = np.eye(len(P)) + 0.1 * np.random.default_rng(2).normal(size=P.shape)
    return np.outer(size, size) * (mix @ mix.T)


def carried(kind, scale, dt=0.2):
    """Mean and covariance after a step, begun with the sd times ``scale``; its row is noise."""
    testbed = bench()
    model, drive = model_of(kind, testbed, 1e20, Walks(0.0, 0.0)), step_of(dt)
    posterior, P = start_of(kind, testbed, drive), covariance_of(kind, testbed, model) * scale**2
    state = driver.State(kind, model, COM_NAMES, np.eye(9)[:3], posterior, P)
    rows = Rows(drive, np.array([1]), np.array([False]), np.zeros((1, 3)))
    after, _ = driver.advance(state, rows)
    return after.mean, after.covariance / scale**2


def differences(twin, drive, first, sizes):
    """What small changes before a step do behind it: central differences of the step."""
    step = *drive.known, drive.t[1]
    here = plain.platform_at(twin.testbed, first.com, first.J, step, 0)

    def after(x):
        q, dw, com, J = plain.moved(twin, first, x)
        now = plain.platform_at(twin.testbed, com, J, step, 0)
        H = now.J @ (plain.rate(here, first.H) + dw) + now.h
        y, _, end = plain.stride(twin, drive, 0, (com, J), np.append(q, H))
        return y[:4], plain.rate(end, y[4:])

    columns = []
    for e in np.diag(sizes):
        (q1, w1), (q0, w0) = after(e), after(-e)
        columns.append(np.append(difference(q1, q0), w1 - w0) / (2 * e.max()))
    return np.column_stack(columns)


@pytest.mark.parametrize("name", ["ekf_6", "ekf_9", "ekf_12"])
def test_transition_is_good_to_second_order(name):
    """Half the step, an eighth of the error, beside small changes before and behind the step."""
    kind, testbed, errors = KINDS[name], bench(), []
    o, n = (3, 15) if kind.attitude else (0, 12)
    sizes = np.repeat([1e-4, 1e-4, 1e-6, 1e-4, 1e-4], 3)[3 - o :]
    for dt in (0.8, 0.4):
        drive, twin = step_of(dt), plain.Plain(kind, testbed, np.eye(3), 1.0, Walks(0.0, 0.0))
        whole = start_of(kind, testbed, drive)
        first = plain.Posterior(whole[:4], whole[4:7], COM, plain.full(INERTIA), np.eye(n))
        phi, *_ = plain.transition(twin, drive, 0, first)
        off = phi[: o + 3] - differences(twin, drive, first, sizes)[3 - o :]
        size = np.abs((phi - np.eye(n))[: o + 3]).max(axis=0) / dt  # of F
        errors.append(np.abs(off / size).max())
    assert 6 < errors[0] / errors[1] < 10


@pytest.mark.parametrize("size", ["6", "9", "12"])
def test_points_and_linearisation_agree_to_second_order(size):
    """A tenth of the sd, a hundredth of the difference, in the mean and in the covariance.

    Points of no spread give the covariance of the linear model, but for the third order of Phi.
    """
    means, spreads = [], []
    (a, P), (_, flat) = carried(KINDS["ekf_" + size], 1e-3), carried(KINDS["ukf_" + size], 1e-3)
    sd = np.sqrt(np.diag(P))
    for scale in (0.3, 0.03):
        b, Q = carried(KINDS["ukf_" + size], scale)
        means.append(np.abs(a - b).max())
        spreads.append(np.abs((Q - flat) / np.outer(sd, sd)).max())
    assert 80 < means[0] / means[1] < 120
    assert 80 < spreads[0] / spreads[1] < 120
    assert np.abs((P - flat) / np.outer(sd, sd)).max() < 1e-3


# --- the linear model -----------------------------------------------------------------------------


def ball():
    """A platform with equal moments and no products: Euler's equation is the simplified model."""
    return replace(
        platform(gyro=True), inertia_sd=0.0,
        body=MassProperties(MASS, COM + 20e-6, 0.5 * np.eye(3)),
    )  # fmt: skip


def textbook(rows, testbed, noise):
    """Review Eqs. 28 to 30 with R11 and R12, word for word; Phi is the trapezoid of [g x]."""
    m, J = MASS, 0.5
    x, P = np.zeros(6), np.diag(np.repeat([0.1**2, 1e-8], 3))
    x[3:], H, E = testbed.body.com, np.eye(3, 6), np.eye(6)
    g = [plain.cross(plain.gravity_of(q, testbed.gravity)) for q in rows.drive.q]
    for k, w in enumerate(rows.observed):
        if k:
            T = rows.drive.t[k] - rows.drive.t[k - 1]
            A = np.eye(6)
            A[:3, 3:] = -(m * T / 2) / J * (g[k - 1] + g[k])
            Q = np.repeat([WALKS.torque**2 / J**2, WALKS.com**2], 3) * T
            x, P = A @ x, A @ P @ A.T + np.diag(Q)
        K = P @ H.T @ np.linalg.inv(H @ P @ H.T + noise**2 * np.eye(3))
        x = x + K @ (w - x[:3])
        P = (E - K @ H) @ P @ (E - K @ H).T + K @ K.T * noise**2
    return x[3:], P[3:, 3:]


@pytest.mark.parametrize("name", ["kf_simplified", "ekf_6", "ukf_6"])
def test_every_filter_is_the_linear_one_where_the_model_is_linear(name):
    """To 1e-9 sd: on a ball no filter differs from the linear filter of the review."""
    testbed, kind = ball(), KINDS[name]
    rows, _ = gyro_rows(noisy(recording(20.0, None, 5.0, 20.0), 1), testbed)
    end, _ = driver.advance(driver.begin(kind, testbed, GYRO_SD, WALKS), rows)
    com, covariance = textbook(rows, testbed, GYRO_SD)
    values, found = driver.reported(end)
    sd = np.sqrt(np.diag(covariance))
    np.testing.assert_allclose(values / sd, com / sd, atol=1e-9 * np.abs(com / sd).max())
    assert np.abs((found - covariance) / np.outer(sd, sd)).max() < 1e-9


# --- the driver -----------------------------------------------------------------------------------


@pytest.mark.parametrize("name", KINDS)
@pytest.mark.parametrize("chunk", [1, 37])
def test_rows_one_by_one_give_what_a_file_gives(observed, name, chunk):
    """To the last bit: states, courses and surprises."""
    kind, testbed = KINDS[name], bench()
    rows, noise = rows_of(kind, observed, testbed)
    first = driver.begin(kind, testbed, noise, WALKS)
    whole, at_once = driver.advance(first, rows)
    state, parts, n = first, [], len(rows.node)
    for k in range(0, n, chunk):
        state, passed = driver.advance(state, taken(rows, k, min(k + chunk, n)))
        parts.append(passed)
    assert np.array_equal(state.mean, whole.mean)
    assert np.array_equal(state.covariance, whole.covariance)
    for field in ("t", "values", "sd"):
        joined = np.concatenate([getattr(part.course, field) for part in parts])
        assert np.array_equal(joined, getattr(at_once.course, field))
    surprise = np.concatenate([part.surprise for part in parts])
    assert np.array_equal(surprise, at_once.surprise, equal_nan=True)


@pytest.mark.parametrize("name", KINDS)
def test_nothing_given_is_changed_and_twice_is_the_same(observed, name):
    kind, testbed = KINDS[name], bench()
    rows, noise = rows_of(kind, observed, testbed)
    state = driver.begin(kind, testbed, noise, WALKS)
    kept = [x.copy() for x in (state.mean, state.covariance, *rows.drive, rows.node, rows.observed)]
    a, _ = driver.advance(state, rows)
    b, _ = driver.advance(state, rows)
    now = (state.mean, state.covariance, *rows.drive, rows.node, rows.observed)
    assert all(np.array_equal(x, y) for x, y in zip(kept, now, strict=True))
    assert np.array_equal(a.mean, b.mean)
    assert np.array_equal(a.covariance, b.covariance)
