"""Whether a device follows its inputs: by hand, by noise, and by what is no fault."""

import numpy as np
import pytest

from equipoise.hardware.links.device_following import Following
from equipoise.model.devices import ControlMomentGyro, JetPair, Magnetorquer, ReactionWheel
from equipoise.model.reasons.interlocks import Interlock

X, Y = np.array([1.0, 0.0, 0.0]), np.array([0.0, 1.0, 0.0])
# 2 mN m on 1e-4 kg m^2: 20 rad/s^2
WHEEL = ReactionWheel("w", X, 1e-4, 500.0, 0.005, speed_noise=0.05, lag=0.02)
GYRO = ControlMomentGyro("g", X, Y, 0.2, 1.0)
COIL = Magnetorquer("m", X, 0.4)
JET = JetPair("j", X, 0.05, 0.01)
STEP = 0.02  # s, between reports


def run(following, seconds, count, start=0.0, at=0.0):
    """Report what a device counts from ``start`` (s) on; return when a deviation was found."""
    for t in np.arange(start + STEP, start + seconds, STEP):
        at = count(t - start, at)
        following.reported(float(t), float(at))
        if following.deviation is not None:
            return float(t) - start
    return None


def begun(device, value, at=0.0):
    following = Following(device)
    following.reported(0.0, at)
    following.given(0.0, value)
    return following


def test_a_wheel_that_speeds_up_as_it_is_driven_follows():
    """With its lag: n = 20 (t - 0.02 (1 - e^(-t / 0.02)))."""
    rng = np.random.default_rng(0)

    def speed(t, _):
        return 20.0 * (t - 0.02 * (1 - np.exp(-t / 0.02))) + 0.05 * rng.standard_normal()

    assert run(begun(WHEEL, 0.002), 20.0, speed) is None


def test_a_stuck_wheel_is_found_after_ten_times_what_may_be_late():
    """Lag and delay are 0.12 s, so it takes 1.2 s, whatever the torque; nothing is counted."""
    following = begun(WHEEL, 0.002)
    assert run(following, 5.0, lambda _t, _: 0.0) == pytest.approx(1.2, abs=2 * STEP)
    reason = following.deviation
    assert (reason.code, reason.parameters) == (Interlock.NOT_FOLLOWING, ("w", "rad/s"))
    assert reason.numbers["wanted"] == pytest.approx(24.0, abs=0.5)
    assert reason.numbers["counted"] == 0.0
    assert "rad/s were commanded within 1.2 s, and 0 rad/s measured" in reason.sentence


def test_a_wheel_that_turns_the_other_way_or_by_less_than_half_is_found():
    assert run(begun(WHEEL, 0.002), 5.0, lambda t, _: -20.0 * t) == pytest.approx(1.2, abs=0.04)
    assert run(begun(WHEEL, 0.002), 5.0, lambda t, _: 9.0 * t) == pytest.approx(1.2, abs=0.04)
    assert run(begun(WHEEL, 0.002), 20.0, lambda t, _: 11.0 * t) is None


def test_a_little_torque_needs_longer_to_exceed_the_noise():
    """5e-6 N m: 0.05 rad/s^2; twelve sd of noise are 0.6 rad/s, so 12 s and too long.

    Twice as much needs 6 s.
    """
    assert run(begun(WHEEL, 5e-6), 60.0, lambda _t, _: 0.0) is None
    assert run(begun(WHEEL, 1e-5), 60.0, lambda _t, _: 0.0) == pytest.approx(6.0, abs=0.1)


def test_a_torque_that_changes_its_sign_at_every_step_is_followed():
    """The wheel is late by 0.1 s, as much as is allowed."""
    following, rng, speed = Following(WHEEL), np.random.default_rng(1), 0.0
    given = [(0.1 * k, 0.005 * float(rng.choice([-1, 1]))) for k in range(400)]
    late = 0.0
    for k in range(1, 2000):
        t = STEP * k
        now = [u for when, u in given if when <= t - 0.1]
        late = now[-1] if now else 0.0
        speed += late / 1e-4 * STEP
        following.reported(t, speed)
        for when, u in given:
            if t - STEP < when <= t:
                following.given(when, u)
    assert following.deviation is None


def test_a_wheel_at_its_greatest_speed_need_not_follow_and_one_beyond_it_is_found():
    assert run(begun(WHEEL, 0.002, at=495.0), 5.0, lambda _t, _: 495.0) is None
    following = begun(WHEEL, 0.0)
    following.reported(0.02, 530.0)
    assert following.deviation.code is Interlock.DEVICE_LIMIT
    assert following.deviation.numbers == {"at": 530.0, "limit": 500.0}


def test_a_gimbal_that_turns_by_itself_is_found():
    """1 rad/s for a second is what it could at most."""
    found = run(begun(GYRO, 0.0), 20.0, lambda t, _: 0.5 * t)
    assert found == pytest.approx(2.0, abs=2 * STEP)
    assert run(begun(GYRO, 0.0), 60.0, lambda t, _: 0.01 * t) is None  # friction, or drift


def test_a_gimbal_that_follows_a_sine_follows():
    following = Following(GYRO)
    for k in range(1500):
        t = STEP * k
        following.reported(t, float(np.sin(t)))
        following.given(t, float(np.cos(t)))
    assert following.deviation is None


@pytest.mark.parametrize(("share", "found"), [(1.0, None), (0.6, None), (0.0, 1.0)])
def test_a_dipole_is_integrated(share, found):
    """No lag: 0.1 s may be late, so it takes a second."""
    at = run(begun(COIL, 0.3), 10.0, lambda _t, _: 0.3 * share)
    assert at == (None if found is None else pytest.approx(found, abs=2 * STEP))


def test_a_dipole_beyond_its_greatest_is_found():
    following = begun(COIL, 0.4)
    following.reported(0.02, 0.43)
    assert following.deviation.code is Interlock.DEVICE_LIMIT


@pytest.mark.parametrize(("share", "pulses"), [(1.0, None), (0.0, 10), (0.7, None), (0.3, 10)])
def test_jets_that_give_no_impulse_are_found_after_ten_pulses(share, pulses):
    following, total, found = Following(JET), 0.0, None
    following.reported(0.0, 0.0)
    for k in range(40):
        t = 0.5 * k
        following.given(t + 0.001, -0.001)
        total += share * (-0.001)
        following.reported(t + 0.1, total)
        if following.deviation is not None and found is None:
            found = k + 1
    assert found == pulses


def test_what_began_anew_is_compared_anew():
    following = begun(WHEEL, 0.002)
    run(following, 5.0, lambda _t, _: 0.0)
    following.begin()
    assert following.deviation is None
    assert run(following, 5.0, lambda _t, _: 100.0, start=5.0) is None
