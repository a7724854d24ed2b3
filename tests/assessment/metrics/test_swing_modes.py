"""Small swings: periods worked by hand, and the frequencies of the full motion of a platform."""

import numpy as np
import pytest

from equipoise.actuators.sliding_masses import mass_maps
from equipoise.assessment.metrics.period import swings
from equipoise.assessment.metrics.residual_torque import swing_period
from equipoise.assessment.metrics.swing_modes import across, moment_for, swing_rates, swing_shapes
from equipoise.dynamics.propagation import body_of, propagate
from equipoise.dynamics.timeline import timeline
from equipoise.maths.attitude import exponential, to_matrix
from equipoise.maths.linalg import pack_symmetric
from tests.support.builders import GRAVITY, MASS

DOWN = np.array([0.0, 0.0, -1.0])
J = np.array([[0.30, 0.01, 0.05], [0.01, 0.40, -0.03], [0.05, -0.03, 0.60]])


def test_a_millimetre_gives_a_period_of_nine_seconds_and_a_micrometre_of_270():
    """T = 2 pi sqrt(0.265 / (14.307 x 9.81 x h)): 8.63 s, 27.3 s, 86.3 s, 273 s by hand."""
    inertia = np.diag([0.265, 0.265, 0.427])
    for height, period in ((1e-3, 8.63), (1e-4, 27.3), (1e-5, 86.3), (1e-6, 273.0)):
        rates = swing_rates(14.307 * 9.81 * height, inertia, DOWN)
        np.testing.assert_allclose(2 * np.pi / rates, period, rtol=2e-3)


def test_a_platform_that_topples_has_no_swing():
    np.testing.assert_array_equal(swing_rates(-0.01, np.diag([0.3, 0.4, 0.6]), DOWN), 0.0)


def moved(height, w0, turn, seconds=400.0, aside=(0.0, 0.0)):
    """The vertical across the body, (n, 2), of the full equations of motion without masses."""
    t = np.arange(0.0, seconds, 0.2)
    rigid = body_of(MASS, GRAVITY, pack_symmetric(J), MASS * np.array([*aside, -height]))
    line = timeline(t, np.zeros(0), None, 0, 0.5)
    path = propagate(rigid, mass_maps(()), line, exponential(turn), w0)
    return t, -to_matrix(path.q[line.attitude_node])[:, 2, :] @ across(DOWN).T


@pytest.mark.parametrize("spin", [0.0, 0.02, -0.05])
def test_the_full_motion_swings_at_these_frequencies(spin):
    """Half a degree of tilt, products of inertia, with a spin and without: to 3e-4.

    A spin about an axis that is not principal wobbles, which is left out: J_13 W^2 / m g h is 3 %
    of the tilt here, and no frequency.
    """
    height = 1e-4
    t, s = moved(height, np.array([0.0, 0.0, spin]), np.radians([0.4, 0.3, 0.0]))
    found = np.array([swing.frequency for swing in swings(t, s)])
    expected = swing_rates(MASS * GRAVITY * height, J, DOWN, spin) / (2 * np.pi)
    np.testing.assert_allclose(found, expected, rtol=1e-3 if spin else 3e-4)


@pytest.mark.parametrize("spin", [0.2, -0.3])
def test_a_spin_about_an_axis_that_is_not_principal_swings_at_these_frequencies(spin):
    """The centre of mass lies aside by W^2 (J_13, J_23) / m g, which makes the spin steady.

    Without its lever m g h would be 2 to 10 % off, by the slow swing.
    """
    height, weight = 3e-4, MASS * GRAVITY
    aside = spin**2 * J[:2, 2] / weight
    t, s = moved(height, np.array([0.0, 0.0, spin]), np.radians([0.2, 0.1, 0.0]), aside=aside)
    found = [swing.frequency for swing in swings(t, s)]
    expected = swing_rates(weight * height, J, DOWN, spin) / (2 * np.pi)
    np.testing.assert_allclose(found, expected, rtol=5e-4)
    moments = [moment_for(2 * np.pi * f, k, J, DOWN, spin) for k, f in enumerate(found)]
    np.testing.assert_allclose(moments, weight * height, rtol=4e-3)


def test_the_shape_of_a_swing_goes_round_with_a_spin_and_in_a_plane_without():
    """Equal moments and a spin: circles, the slow and the quick one in opposite senses."""
    alike = np.diag([0.3, 0.3, 0.5])
    slow, quick = swing_shapes(0.02, alike, DOWN, 0.2)
    np.testing.assert_allclose(np.abs([slow, quick]), np.sqrt(0.5), atol=1e-9)
    assert slow[1] / slow[0] == pytest.approx(-quick[1] / quick[0], abs=1e-9)
    assert abs((slow[1] / slow[0]).real) < 1e-9
    plane = swing_shapes(0.02, np.diag([0.3, 0.4, 0.6]), DOWN)
    np.testing.assert_allclose(np.abs(plane), [[1, 0], [0, 1]], atol=1e-9)


@pytest.mark.parametrize("mode", [0, 1])
def test_the_moment_is_the_one_that_the_frequency_came_from(mode):
    for spin in (0.0, 0.03):
        rate = swing_rates(0.02, J, DOWN, spin)[mode]
        assert moment_for(rate, mode, J, DOWN, spin) == pytest.approx(0.02, rel=1e-9)


def test_no_height_swings_more_slowly_than_its_spin_lets_it():
    assert np.isnan(moment_for(1e-4, 1, J, DOWN, 0.5))


def test_the_swing_about_x_moves_the_vertical_along_y():
    """The quick swing is about the axis of the least inertia."""
    slow, quick = swing_shapes(0.02, np.diag([0.3, 0.4, 0.6]), DOWN)
    np.testing.assert_allclose(np.abs(across(DOWN).T @ quick), [0, 1, 0], atol=1e-12)
    np.testing.assert_allclose(np.abs(across(DOWN).T @ slow), [1, 0, 0], atol=1e-12)


def test_the_balancing_table_gives_the_same_slow_period():
    """One formula for both: the turn about the vertical is free, and products of inertia count."""
    height, up = 5e-5, -DOWN
    com = np.array([0, 0, -height])
    period = swing_period(MASS * GRAVITY, com, np.zeros(3), J, up).value
    rates = swing_rates(MASS * GRAVITY * height, J, DOWN)
    assert period == pytest.approx(2 * np.pi / rates[0], rel=1e-9)
