"""The attitude filter beneath the laws: by hand, against whole matrices, against the truth."""

from dataclasses import replace
from functools import cache

import numpy as np
import pytest

from equipoise.estimation.motion.attitude_filter import WALK, followed
from equipoise.maths.attitude import difference, exponential, multiply, to_matrix
from equipoise.model.mass_properties import MassProperties
from equipoise.model.recording import Recording, Samples, window
from equipoise.model.testbed import AttitudeSensor, Gyro, Testbed

CAMERA, GYRO, BIAS_SD = 1e-3, 2e-4, 2e-3  # rad, rad/s, rad/s
LEVEL = np.array([1.0, 0.0, 0.0, 0.0])


def bed(gyro=100.0, **of_gyro):
    body = MassProperties(14.0, np.zeros(3), np.diag([0.3, 0.28, 0.45]))
    return Testbed(
        "filtered", body, 0.1, np.full(3, 1e-4), np.array([0.0, 0.0, 1.0]), 0.5, 9.81,
        attitude=AttitudeSensor(20.0, CAMERA), gyro=Gyro(gyro, GYRO, BIAS_SD, **of_gyro),
    )  # fmt: skip


FAST, SLOW = 0.2, 0.02  # rad/s: a slew, a platform that swings


def turning(t, size=FAST):
    """A rate (rad/s) that goes through all three axes, and is nowhere constant."""
    return size * np.column_stack([np.sin(0.7 * t), np.cos(0.5 * t), np.sin(0.3 * t + 1.0)])


@cache
def attitudes(end, rate, size=FAST):
    """The attitude at ``rate`` (Hz) until ``end`` (s), by steps of 2 ms at most."""
    fine = max(round(500 / rate), 1)
    dt, q, found = 1 / (rate * fine), LEVEL, []
    for k, w in enumerate(turning((np.arange(round(end * rate) * fine) + 0.5) * dt, size)):
        if k % fine == 0:
            found.append(q)
        q = multiply(q, exponential(dt * w))
    return np.array(found)


def observed(end, seed, bias, gyro=100.0, size=FAST):
    """A record with the noise that the testbed states."""
    rng = np.random.default_rng(seed)
    t_w, t_q = np.arange(round(end * gyro)) / gyro, np.arange(round(end * 20.0)) / 20.0
    q = attitudes(end, 20.0, size)
    rows_q = multiply(q, exponential(CAMERA * rng.normal(size=(len(t_q), 3))))
    # What carries an attitude from row to row is the rate between them.
    rows_w = turning(t_w - 0.5 / gyro, size) + bias + GYRO * rng.normal(size=(len(t_w), 3))
    return Recording(Samples(t_q, rows_q), Samples(t_w, rows_w))


def test_by_hand_one_row_of_each():
    """A camera row, a gyro row half a second later, a camera row with it.

    P00 = c^2 at first; after dt it is c^2 + dt^2 b^2 + s^2 dt_w dt, P01 = -dt b^2, P11 = b^2 and
    what the bias walks. The second camera row is 2 mrad off where the gyro led.
    """
    dt, rate = 0.5, np.array([0.0, 0.0, 0.1])
    off = np.array([2e-3, 0.0, 0.0])
    led = exponential(dt * rate)
    record = Recording(
        Samples(np.array([0.0, dt]), np.array([LEVEL, multiply(led, exponential(off))])),
        Samples(np.array([dt]), rate[None]),
    )
    found = followed(None, record, bed())
    p00 = CAMERA**2 + dt**2 * BIAS_SD**2 + GYRO**2 / 100.0 * dt
    p01, p11 = -dt * BIAS_SD**2, BIAS_SD**2 + WALK**2 * dt
    k0, k1 = p00 / (p00 + CAMERA**2), p01 / (p00 + CAMERA**2)
    assert k1 < 0  # the gyro led too little, so its bias is negative
    np.testing.assert_allclose(found.q, multiply(led, exponential(k0 * off)), rtol=1e-12)
    np.testing.assert_allclose(found.bias, k1 * off, atol=1e-15)
    np.testing.assert_allclose(found.rate, rate - k1 * off, atol=1e-15)
    np.testing.assert_allclose(
        found.values[8:11], [(1 - k0) * p00, (1 - k0) * p01, p11 - k1 * p01], rtol=1e-9
    )
    assert found.t == dt


def plainly(record, testbed, turns=False):
    """The multiplicative filter with whole 6 x 6 matrices: q, b, P and mean rate after all rows.

    ``turns``: an error of attitude turns against the body, as it does; then no scalars serve.
    """
    rows = [(t, 0, w) for t, w in zip(record.rate.t, record.rate.values, strict=True)]
    rows += [(t, 1, q) for t, q in zip(record.attitude.t, record.attitude.values, strict=True)]
    rows.sort(key=lambda row: row[:2])
    first = next(k for k, row in enumerate(rows) if row[1] == 1)
    t, q, b = rows[first][0], rows[first][2], np.zeros(3)
    E, Z, led = np.eye(3), np.zeros((3, 3)), []
    P = np.block([[CAMERA**2 * E, Z], [Z, testbed.gyro.bias_sd**2 * E]])
    for now, kind, row in rows[first + 1 :]:
        dt, t = now - t, now
        if kind == 0:
            led.append(row)
        w = (row if kind == 0 else np.mean(led, axis=0) if led else b) - b
        against = to_matrix(exponential(dt * w)).T if turns else E
        F = np.block([[against, -dt * E], [Z, E]])
        Q = np.block([[GYRO**2 / testbed.gyro.rate * dt * E, Z], [Z, WALK**2 * dt * E]])
        q, P = multiply(q, exponential(dt * w)), F @ P @ F.T + Q
        if kind == 1:
            H = np.hstack([E, Z])
            K = P @ H.T @ np.linalg.inv(H @ P @ H.T + CAMERA**2 * E)
            change = K @ difference(row, q)
            q, b = multiply(q, exponential(change[:3])), b + change[3:]
            P = (np.eye(6) - K @ H) @ P
    return q, b, P, np.mean(led, axis=0) - b


def test_it_is_the_textbooks_filter_with_whole_matrices():
    """Camera rows between those of the gyro, too: 20 Hz against 70 Hz."""
    testbed = bed(gyro=70.0)
    record = observed(5.0, 3, np.array([1e-3, -2e-3, 5e-4]), gyro=70.0)
    q, b, P, rate = plainly(record, testbed)
    found = followed(None, record, testbed)
    np.testing.assert_allclose(difference(found.q, q), 0.0, atol=1e-12)
    np.testing.assert_allclose(found.bias, b, rtol=1e-9)
    np.testing.assert_allclose(found.rate, rate, rtol=1e-9)
    blocks = [P[0, 0], P[0, 3], P[3, 3]]
    np.testing.assert_allclose(found.values[8:11], blocks, rtol=1e-9)
    np.testing.assert_allclose(P[:3, 3:], P[0, 3] * np.eye(3), atol=1e-18)


def test_what_the_turning_of_errors_would_change_is_small_at_a_swing():
    """Less than a tenth of an sd at 0.02 rad/s. (At 0.2 rad/s the bias is 1.5 sd off.)"""
    testbed = bed()
    record = observed(10.0, 5, np.array([1e-3, -2e-3, 5e-4]), size=SLOW)
    q, b, P, _ = plainly(record, testbed, turns=True)
    found = followed(None, record, testbed)
    assert np.all(np.abs(difference(found.q, q)) < 0.1 * np.sqrt(P[0, 0]))
    assert np.all(np.abs(found.bias - b) < 0.1 * np.sqrt(P[3, 3]))


def test_the_difference_of_the_twin_is_the_turn_that_leads_from_one_to_the_other():
    """q exp(difference(p, q)) = p: what the twin rests on."""
    p, q = exponential(np.array([0.1, 0.2, -0.3])), exponential(np.array([-0.2, 0.1, 0.4]))
    np.testing.assert_allclose(multiply(q, exponential(difference(p, q))), p, rtol=1e-12)


def test_cut_into_parts_it_comes_to_the_same():
    """A law sees a record a tenth of a second at a time; only the mean rate is of the last part."""
    testbed = bed()
    record = observed(4.0, 1, np.zeros(3))
    whole, state = followed(None, record, testbed), None
    for k in range(40):
        start = 0.1 * k - 1e-6
        state = followed(state, window(record, start, start + 0.1 - 1e-6), testbed)
    np.testing.assert_allclose(state.values[:11], whole.values[:11], rtol=1e-9, atol=1e-15)
    last = turning(np.arange(390, 400) / 100.0 - 0.005).mean(axis=0)
    np.testing.assert_allclose(state.rate, last, atol=4 * GYRO / 10**0.5 + 4e-4)


@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_the_sign_of_a_quaternion_is_nothing(sign):
    testbed = bed()
    record = observed(2.0, 2, np.zeros(3))
    turned = record.attitude.values.copy()
    turned[1::2] *= sign
    found = followed(None, replace(record, attitude=Samples(record.attitude.t, turned)), testbed)
    plain = followed(None, record, testbed)
    np.testing.assert_allclose(difference(found.q, plain.q), 0.0, atol=1e-12)
    np.testing.assert_allclose(found.bias, plain.bias, rtol=1e-9)


def test_there_is_no_state_before_the_first_camera_row():
    testbed = bed()
    record = observed(1.0, 1, np.zeros(3))
    blind = replace(record, attitude=None)
    assert followed(None, blind, testbed) is None
    state = followed(None, record, testbed)
    later = followed(state, replace(blind, rate=Samples(record.rate.t + 1.0, record.rate.values)),
                     testbed)  # fmt: skip
    assert later.t == pytest.approx(1.99)  # without a camera the gyro goes on
    assert later.values[8] > state.values[8]


def test_delayed_sensor_rows_are_processed_at_their_measurement_time():
    """Both stamped 50 ms after they measured: the state is as without, 50 ms earlier."""
    plain, late = bed(), bed(delay=0.05)
    late = replace(late, attitude=replace(late.attitude, delay=0.05))
    record = observed(3.0, 4, np.zeros(3))
    stamped = Recording(
        Samples(record.attitude.t + 0.05, record.attitude.values),
        Samples(record.rate.t + 0.05, record.rate.values),
    )
    np.testing.assert_allclose(
        followed(None, stamped, late).values, followed(None, record, plain).values,
        rtol=1e-7, atol=1e-14,
    )  # fmt: skip


def test_bias_and_attitude_are_found_within_their_stated_sd():
    """Thirty swings of 20 s: squares of errors over variances have a mean of one."""
    rng, testbed, scores = np.random.default_rng(0), bed(), []
    now = attitudes(20.0, 100.0, SLOW)[
        -1
    ]  # at 19.99 s, the gyro's last row; the camera's is at 19.95 s
    for seed in range(30):
        bias = BIAS_SD * rng.normal(size=3)
        found = followed(None, observed(20.0, seed, bias, size=SLOW), testbed)
        angle, off = difference(now, found.q), found.bias - bias
        scores.append([angle @ angle / found.values[8], off @ off / found.values[10]])
    # A chi-square of 90 degrees of freedom: 15 % are one sd.
    np.testing.assert_allclose(np.mean(scores, axis=0) / 3, 1.0, atol=0.5)
    assert np.all(np.sqrt(found.values[[8, 10]]) < [3e-4, 6e-5])
