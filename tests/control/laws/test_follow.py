"""Masses that follow the tilt: what they must add, by hand, and what is then left."""

import numpy as np
import pytest

from equipoise.control.law import Sample
from equipoise.control.laws.follow import following_law, shift_at
from equipoise.dynamics.sag_trim import sag_matrix, trimmed_com, trimming_shift
from equipoise.maths.attitude import exponential, to_matrix
from equipoise.model.following import Following
from tests.support.plain_loop import GRAVITY, MASS, Truth, close, platform

UP, DEPTH = np.array([0.0, 0.0, 1.0]), 25e-6
DECK = np.diag([-DEPTH / 3, -DEPTH / 3, 2 * DEPTH / 3])  # sinks by 25 um, less an isotropic part
SAG = sag_matrix({"sag_xx": 3e-6, "sag_yy": -8e-6, "sag_xy": 2e-6, "sag_xz": 4e-6, "sag_yz": -5e-6})
TILT = np.radians(20)


def tilted(angle, heading=0.0):
    """Gravity's direction in a body that leans by an angle."""
    return -np.array([
        np.sin(angle) * np.cos(heading), np.sin(angle) * np.sin(heading), np.cos(angle)
    ])  # fmt: skip


@pytest.mark.parametrize("degrees", [0.0, 10.0, 16.0, 20.0])
def test_the_trimming_shift_of_a_sagging_deck_by_hand(degrees):
    """C n + trim = c (k - cos a) up, whose part across gravity is c |k - cos a| sin a."""
    a, k = np.radians(degrees), trimmed_com(DECK, UP, TILT)[2] / DEPTH
    shift = trimming_shift(DECK, k * DEPTH * UP, tilted(a))
    # DECK is DEPTH up up^T less an isotropic third, whose part lies along gravity.
    assert np.linalg.norm(shift) == pytest.approx(DEPTH * abs(k - np.cos(a)) * np.sin(a), abs=1e-12)
    if degrees == 20.0:
        assert 1e6 * np.linalg.norm(shift) == pytest.approx(0.17, abs=0.005)


def test_nothing_of_sag_and_trim_is_left_across_gravity_and_no_less_would_do():
    trim = np.array([1e-6, -2e-6, 3e-6])
    for heading in np.arange(0.0, 6.0, 0.7):
        down = tilted(0.3, heading)
        shift = trimming_shift(SAG, trim, down)
        assert np.cross(trim + SAG @ down + shift, down) == pytest.approx(np.zeros(3), abs=1e-20)
        assert shift @ down == pytest.approx(0.0, abs=1e-20)


def test_with_the_target_reached_only_the_target_hangs():
    """r + s + C n at a tilt turns the platform as the target alone does."""
    target, sag_trim = np.array([0.0, 0.0, -1e-4]), trimmed_com(SAG, UP, TILT)
    com = np.array([5e-6, 7e-6, -3e-5])
    following = Following(target + sag_trim - com, 0.0, np.zeros(3), SAG, sag_trim)
    for heading in (0.0, 1.0, 4.0):
        down = tilted(0.25, heading)
        acting = com + shift_at(following, down, 50.0) + SAG @ down
        assert np.cross(acting, down) == pytest.approx(np.cross(target, down), abs=1e-18)


def test_drift_is_taken_back():
    """0.1 um/min along x for three minutes: 0.3 um the other way."""
    drift = np.array([0.1e-6 / 60, 0.0, 0.0])
    following = Following(np.array([1e-6, 0.0, 0.0]), 100.0, drift, np.zeros((3, 3)), np.zeros(3))
    assert shift_at(following, -UP, 280.0) == pytest.approx([0.7e-6, 0.0, 0.0], abs=1e-15)


def test_the_law_follows_and_holds_level_until_it_is_time():
    """From 5 deg aside, offsets trimmed but for 1 um: level, and the masses drift the other way."""
    drift = np.array([0.3e-6, -0.1e-6, 0.0]) / 60
    com = np.array([4e-6, -3e-6, -20e-6])
    following = Following(-com + [1e-6, 0.0, 0.0], 0.0, drift, np.zeros((3, 3)), np.zeros(3))
    truth = Truth(com, drift=drift, tilt=np.array([0.08, -0.03, 0.5]))
    course = close(following_law(following, 120.0), platform(), truth, np.zeros(3), 200.0)
    assert course.finished[0].code == "followed"
    assert course.now.t == pytest.approx(120.0, abs=0.2)
    assert course.com == pytest.approx([1e-6, 0.0, 0.0], abs=0.05e-6)
    lean = [np.degrees(np.arccos(to_matrix(q)[2, 2])) for q in course.q]
    assert lean[0] > 4.5
    assert max(lean[len(lean) // 2 :]) < 0.1


def test_it_commands_the_shift_for_the_measured_attitude():
    following = Following(np.zeros(3), 0.0, np.zeros(3), DECK, trimmed_com(DECK, UP, TILT))
    law = following_law(following, 60.0)
    state, params = law.begin(platform(), np.zeros(3))
    q = exponential(np.array([0.2, 0.1, 0.0]))
    down = to_matrix(q).T @ -UP
    zero = np.zeros(3)
    observed = Sample(59.9, q, zero, 9.81 * down, zero, zero, zero, zero, None)
    command = law.step(state, observed, params)[1]
    assert command.shift == pytest.approx(shift_at(following, down, 59.9), abs=1e-15)
    assert not command.finished


def test_wheels_carry_the_weight_of_a_target_aside():
    """Level and at rest, 5 um aside: -m r* x g, 0.69 mN m about y."""
    target, zero = np.array([5e-6, 0.0, 0.0]), np.zeros(3)
    law = following_law(Following(zero, 0.0, zero, np.zeros((3, 3)), zero), 60.0)
    state, params = law.begin(platform(), target)
    q = np.array([1.0, 0.0, 0.0, 0.0])
    observed = Sample(0.0, q, zero, -GRAVITY * UP, zero, zero, zero, zero, None)
    torque = law.step(state, observed, params)[1].torque
    assert torque == pytest.approx([0.0, -MASS * GRAVITY * 5e-6, 0.0], abs=1e-12)
