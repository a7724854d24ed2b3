"""Where a platform that sags should have its centre of mass."""

import numpy as np
import pytest

from equipoise.dynamics.sag_trim import residual_torque, sag_matrix, trimmed_com

UP = np.array([0.0, 0.0, 1.0])
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


@pytest.mark.parametrize("up", [UP, np.array([0.0, -0.6, 0.8])])
def test_residual_is_the_mean_over_directions(up):
    com = np.array([1e-6, -2e-6, 3e-6])
    assert residual_torque(com, SAG, up, 0.6) == pytest.approx(brute(com, SAG, up, 0.6), rel=0.02)


@pytest.mark.parametrize("up", [UP, np.array([0.0, -0.6, 0.8])])
def test_nothing_near_the_trim_leaves_less(up):
    best = trimmed_com(SAG, up, 0.35)
    least = residual_torque(best, SAG, up, 0.35)
    for step in 1e-7 * np.vstack([np.eye(3), -np.eye(3)]):
        assert residual_torque(best + step, SAG, up, 0.35) > least


def test_the_trim_takes_sag_torque_down_as_published():
    """Methods 5.8: at 20 deg the greatest torque falls to about 1/62; the mean falls alike."""
    sag = np.diag([0, 0, 25e-6])
    before = residual_torque(np.zeros(3), sag, UP, np.radians(20))
    after = residual_torque(trimmed_com(sag, UP, np.radians(20)), sag, UP, np.radians(20))
    assert 50 < before / after < 80
