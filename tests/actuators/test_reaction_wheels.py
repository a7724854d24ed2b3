"""Wheels by hand, and limits that keep the torque's direction."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from equipoise.actuators.reaction_wheels import axes_of, span, wheel_momentum, wheel_torques
from equipoise.model.devices import ReactionWheel

TETRAHEDRON = np.array([[1, 1, 1], [1, -1, -1], [-1, 1, -1], [-1, -1, 1]]) / 3**0.5
torques = arrays(np.float64, 3, elements=st.floats(-0.02, 0.02))
speeds = arrays(np.float64, 4, elements=st.floats(-300.0, 300.0))


def wheels(axes, **changes):
    plain = ReactionWheel("w", np.zeros(3), 2e-4, 300.0, 0.01)
    return tuple(
        replace(plain, name=f"w{i}", axis=np.asarray(a, float), **changes)
        for i, a in enumerate(axes)
    )


THREE, FOUR = wheels(np.eye(3)), wheels(TETRAHEDRON)


def test_momentum_by_hand():
    """2e-4 kg m^2 at 100 and -50 rad/s about x and z, one row and a series."""
    h = wheel_momentum(THREE, np.array([100.0, 0.0, -50.0]))
    np.testing.assert_allclose(h, [0.02, 0.0, -0.01])
    series = wheel_momentum(THREE, np.array([[100.0, 0.0, 0.0], [0.0, 1.0, 0.0]]))
    np.testing.assert_allclose(series, [[0.02, 0, 0], [0, 2e-4, 0]])


def test_a_rotor_pushed_forward_pushes_the_platform_back():
    given_ = wheel_torques(THREE, np.array([0.004, 0.0, -0.002]), np.zeros(3), 0.1)
    np.testing.assert_allclose(given_.inputs, [-0.004, 0.0, 0.002], atol=1e-17)
    np.testing.assert_allclose(given_.torque, [0.004, 0.0, -0.002], atol=1e-17)


def test_four_wheels_share_by_hand():
    """A A^T = 4/3 E for a tetrahedron: about z each gives 3/4 a_iz."""
    found = wheel_torques(FOUR, np.array([0.0, 0.0, 0.004]), np.zeros(4), 0.1)
    by_hand = -0.004 * 0.75 * np.array([1, -1, -1, 1]) / 3**0.5
    np.testing.assert_allclose(found.inputs, by_hand, atol=1e-17)


@given(torques, speeds)
def test_what_is_delivered_is_minus_the_slope_of_momentum(wanted, speed):
    """Held over the period, the torques move the stored momentum by minus torque times period."""
    period = 0.05
    found = wheel_torques(FOUR, wanted, speed, period)
    after = speed + found.inputs / 2e-4 * period
    slope = (wheel_momentum(FOUR, after) - wheel_momentum(FOUR, speed)) / period
    np.testing.assert_allclose(-slope, found.torque, atol=1e-13)


@given(torques, speeds)
def test_limits_hold_and_the_direction_stays(wanted, speed):
    found = wheel_torques(FOUR, wanted, speed, 0.5)
    assert np.abs(found.inputs).max() <= 0.01 * (1 + 1e-12)
    assert np.abs(speed + found.inputs / 2e-4 * 0.5).max() <= 300.0 * (1 + 1e-12)
    np.testing.assert_allclose(np.cross(found.torque, wanted), 0.0, atol=1e-17)
    assert 0 <= found.torque @ wanted <= wanted @ wanted * (1 + 1e-12)


def test_a_torque_within_limits_is_delivered_whole():
    wanted = np.array([0.003, -0.002, 0.004])
    np.testing.assert_allclose(wheel_torques(FOUR, wanted, np.zeros(4), 0.1).torque, wanted)


def test_beyond_the_drive_all_are_scaled_alike():
    """20 mN m about x and 10 about y from drives of 10 mN m: half of both."""
    found = wheel_torques(THREE, np.array([0.02, 0.01, 0.0]), np.zeros(3), 0.1)
    np.testing.assert_allclose(found.torque, [0.01, 0.005, 0.0])


def test_a_wheel_about_to_be_too_fast_slows_all():
    """10 rad/s left of 2e-4 kg m^2 in 1 s: 2 mN m of the 4 wanted; the other way there is no bound.

    Torque along +x spins wheel x down, so that its speed must be near the lower end.
    """
    speed = np.array([-290.0, 0.0, 0.0])
    wanted = np.array([0.004, 0.002, 0.0])
    np.testing.assert_allclose(wheel_torques(THREE, wanted, speed, 1.0).torque, [0.002, 0.001, 0])
    np.testing.assert_allclose(wheel_torques(THREE, -wanted, speed, 1.0).torque, -wanted)
    stopped = wheel_torques(THREE, wanted, np.array([-300.0, 0.0, 0.0]), 1.0)
    np.testing.assert_allclose(stopped.torque, 0.0, atol=1e-18)


def test_two_wheels_give_what_lies_in_their_plane():
    found = wheel_torques(THREE[:2], np.array([0.001, 0.002, 0.003]), np.zeros(2), 0.1)
    np.testing.assert_allclose(found.torque, [0.001, 0.002, 0.0], atol=1e-18)


@pytest.mark.parametrize(
    ("axes", "all_three"),
    [
        (np.eye(3), True),
        (TETRAHEDRON, True),
        (np.eye(3)[:2], False),
        ([[1, 0, 0], [0, 1, 0], [0.6, 0.8, 0]], False),
        ([[1, 0, 0], [-1, 0, 0], [0, 1, 0], [0, 0, 1]], True),
        (np.zeros((0, 3)), False),
    ],
)
def test_axes_that_span(axes, all_three):
    assert span(axes_of(wheels(axes))) is all_three
