"""A running slope, and the mean that goes with it."""

import numpy as np
import pytest

from equipoise.maths.running_slope import running_slope

WHOLE = np.array([[0, 3]])


def test_three_even_rows_by_hand():
    """Slope (x3 - x1) / 2; mean (y1 + 2 y2 + y3) / 4."""
    t, x, y = np.array([0.0, 1, 2]), np.array([[1.0], [7], [5]]), np.array([[4.0], [2], [8]])
    slope, mean = running_slope(t, x, y, WHOLE)
    assert (slope.item(), mean.item()) == pytest.approx((2.0, 4.0), abs=1e-14)


def test_mean_is_the_slope_of_the_integral():
    """For any y and uneven times: x is the integral of y by the trapezoid, jumps and all."""
    rng = np.random.default_rng(4)
    t = np.cumsum(rng.uniform(0.5, 1.5, 60))
    y = rng.normal(size=(60, 3))
    steps = 0.5 * (y[1:] + y[:-1]) * np.diff(t)[:, None]
    x = np.vstack([np.zeros(3), np.cumsum(steps, axis=0)])
    windows = np.array([[0, 11], [3, 40], [59 - 20, 60]])
    slope, mean = running_slope(t, x, y, windows)
    np.testing.assert_allclose(slope, mean, atol=1e-13)


def test_weights_are_a_parabola_and_add_up_to_one():
    """On even rows the mean of an impulse at u of half a window is near 3/4 (1 - u^2) / half."""
    t, y = np.arange(41.0), np.eye(41)
    _, mean = running_slope(t, np.zeros((41, 1)), y, np.array([[0, 41]]))
    assert mean.sum() == pytest.approx(1.0, abs=1e-13)
    u = (t - 20) / 20
    np.testing.assert_allclose(mean[0], 0.75 * (1 - u**2) / 20, atol=0.002)


def test_noise_of_a_slope():
    """One sd s in each of n rows is s sqrt(12 / n^3) / dt, here with n = 101 rows of 10 ms."""
    noise = np.random.default_rng(5).normal(size=(101, 4000))
    t = 0.01 * np.arange(101.0)
    slope, _ = running_slope(t, noise, np.zeros((101, 1)), np.array([[0, 101]]))
    assert slope.std() == pytest.approx(np.sqrt(12 / 101**3) / 0.01, rel=0.04)
