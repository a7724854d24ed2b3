"""Where a platform that sags should have its centre of mass."""

import numpy as np
import pytest

from equipoise.dynamics.sag_trim import acting_com, residual_torque, sag_matrix, trimmed_com

UP = np.array([0.0, 0.0, 1.0])
LEANING = np.array([0.0, -0.6, 0.8])
SAG = sag_matrix({"sag_xx": 3e-6, "sag_yy": -8e-6, "sag_xy": 2e-6, "sag_xz": 4e-6, "sag_yz": -5e-6})


@pytest.mark.parametrize("degrees", [10, 20, 45])
def test_sag_along_the_vertical_is_trimmed_by_the_integral_over_the_cap(degrees):
    """Minimum of int sin^2 (r - c cos)^2 over the cap: r = c (s^4/4) / ((2 - 3 c + c^3) / 3)."""
    a = np.radians(degrees)
    by_hand = (np.sin(a) ** 4 / 4) / ((2 - 3 * np.cos(a) + np.cos(a) ** 3) / 3)
    com = trimmed_com(np.diag([0, 0, 25e-6]), UP, a)
    assert com == pytest.approx([0, 0, 25e-6 * by_hand], abs=1e-15)


def test_isotropic_sag_needs_no_trim():
    assert trimmed_com(25e-6 * np.eye(3), UP, 0.3) == pytest.approx(np.zeros(3), abs=1e-18)


def brute(com, sag, up, tilt):
    """Mean square torque over many directions drawn evenly within the cap."""
    rng = np.random.default_rng(4)
    n = rng.normal(size=(400_000, 3))
    n = -n / np.linalg.norm(n, axis=1, keepdims=True)
    n = n[n @ -up > np.cos(tilt)]
    return np.sqrt(np.mean(np.sum(np.cross(com + n @ sag, n) ** 2, axis=1)))


@pytest.mark.parametrize("up", [UP, LEANING])
def test_residual_is_the_mean_over_directions(up):
    com = np.array([1e-6, -2e-6, 3e-6])
    assert residual_torque(com, SAG, up, 0.6) == pytest.approx(brute(com, SAG, up, 0.6), rel=0.02)


@pytest.mark.parametrize("up", [UP, LEANING])
def test_nothing_near_the_trim_leaves_less(up):
    best = trimmed_com(SAG, up, 0.35)
    least = residual_torque(best, SAG, up, 0.35)
    for step in 1e-7 * np.vstack([np.eye(3), -np.eye(3)]):
        assert residual_torque(best + step, SAG, up, 0.35) > least


def test_a_deck_that_sinks_acts_as_one_that_is_lower():
    """C = diag(p, p, c): level at r_z - c; at a tilt, C n leans by p, as a height of p."""
    com = acting_com(np.array([1e-6, 2e-6, -5e-6]), np.diag([4e-6, 4e-6, 7e-6]), UP)
    assert com == pytest.approx([1e-6, 2e-6, -5e-6 - 7e-6 + 4e-6], abs=1e-15)


def around(up):
    """Two directions across up."""
    first = np.cross(up, [1.0, 0.0, 0.0])
    first = first / np.linalg.norm(first)
    return first, np.cross(up, first)


@pytest.mark.parametrize("up", [UP, LEANING])
def test_to_first_order_it_is_turned_as_the_stiff_platform_is(up):
    """(r + C n) x n and r' x n, level and a mrad to every side, where C is alike to all sides.

    The weight's shift with C n alone, as if level, misses 4 um times a mrad.
    """
    (first, second), across = around(up), np.eye(3) - np.outer(up, up)
    side = np.outer(up, first)
    C = 4e-6 * across + 7e-6 * np.outer(up, up) + 3e-6 * (side + side.T)
    r = np.array([1e-6, -2e-6, -30e-6])
    stiff = acting_com(r, C, up)
    for tilt in (0.0, 1e-3):
        for heading in np.arange(0.0, 6.0, 0.7):
            aside = np.cos(heading) * first + np.sin(heading) * second
            n = np.sin(tilt) * aside - np.cos(tilt) * up
            truth = across @ np.cross(r + C @ n, n)
            np.testing.assert_allclose(across @ np.cross(stiff, n), truth, atol=2e-11)
            off = np.linalg.norm(across @ np.cross(r - C @ up, n) - truth)
            assert off == pytest.approx(4e-6 * tilt, abs=2e-11)


def test_with_two_stiffnesses_it_is_their_mean():
    """diag(2, 6, 1) um across z: a height of 4 um less 1; the sides are 2 um off."""
    r, C = np.array([0.0, 0.0, -20e-6]), np.diag([2e-6, 6e-6, 1e-6])
    assert acting_com(r, C, UP) == pytest.approx([0, 0, -20e-6 - 1e-6 + 4e-6], abs=1e-15)
    slopes = []
    for axis in np.eye(3)[:2]:
        n = -UP + 1e-4 * axis
        slopes.append(np.linalg.norm(np.cross(r + C @ n, n)) / 1e-4)
    assert np.mean(slopes) == pytest.approx(17e-6, rel=1e-3)
    assert slopes == pytest.approx([19e-6, 15e-6], rel=1e-3)


def test_the_trim_takes_sag_torque_down_as_published():
    """Of a trim along the vertical: to 1/62 of the greatest torque at 20 deg; the mean alike."""
    sag = np.diag([0, 0, 25e-6])
    before = residual_torque(np.zeros(3), sag, UP, np.radians(20))
    after = residual_torque(trimmed_com(sag, UP, np.radians(20)), sag, UP, np.radians(20))
    assert 50 < before / after < 80
