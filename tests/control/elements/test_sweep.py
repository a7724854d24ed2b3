"""The momentum trajectory: its slopes, and where it leads gravity."""

import numpy as np
import pytest

from equipoise.control.elements.sweep import Sweep, cone, wanted

AXES = np.array([[0.0, 0.8, 0.6], [1.0, 0.0, 0.0], [0.0, 0.6, -0.8]])  # columns e1, e2, up
SWEEP = Sweep(AXES, 0.2, 0.7, 0.3)


@pytest.mark.parametrize("t", [0.0, 1.3, 9.0, 60.0])
def test_slopes_of_the_cone_are_slopes(t):
    """Against central differences."""
    step = 1e-4
    n, n1, n2 = cone(SWEEP, t)
    before, after = cone(SWEEP, t - step), cone(SWEEP, t + step)
    assert np.linalg.norm(n) == pytest.approx(1.0, abs=1e-12)
    np.testing.assert_allclose((after[0] - before[0]) / (2 * step), n1, atol=1e-8)
    np.testing.assert_allclose((after[1] - before[1]) / (2 * step), n2, atol=1e-8)


def test_the_cone_opens_from_level_without_a_jump():
    n, n1, n2 = cone(SWEEP, 0.0)
    np.testing.assert_allclose(n, -AXES[:, 2], atol=1e-15)
    np.testing.assert_allclose(n1, 0, atol=1e-15)
    assert np.linalg.norm(n2) < 0.2 * 0.7**2
    late = cone(SWEEP, 200.0)[0]
    assert -late @ AXES[:, 2] == pytest.approx(np.cos(0.2), abs=1e-6)


def test_the_rate_leads_gravity_along_the_cone_and_back_to_it():
    """n' = n x w_d: on the cone n follows; from 0.1 rad off it comes back as exp(-k t)."""
    for off in (0.0, 0.1):
        axis = np.cross(cone(SWEEP, 100.0)[0], AXES[:, 0])
        n = cone(SWEEP, 100.0)[0] + off * axis / np.linalg.norm(axis)
        n, t, step = n / np.linalg.norm(n), 100.0, 5e-3
        for _ in range(1000):
            middle = n + step / 2 * np.cross(n, wanted(SWEEP, t, n, np.zeros(3)).rate)
            n = n + step * np.cross(middle, wanted(SWEEP, t + step / 2, middle, np.zeros(3)).rate)
            t += step
        separation = np.linalg.norm(n - cone(SWEEP, t)[0])
        assert separation == pytest.approx(off * np.exp(-0.3 * 5.0), rel=0.02, abs=1e-6)


def test_the_slope_of_the_rate_is_its_slope():
    """With gravity turning at a rate w: n' = n x w."""
    n, w, step = np.array([0.1, 0.2, -0.97]), np.array([0.05, -0.1, 0.2]), 1e-4
    before = wanted(SWEEP, 20.0 - step, n - step * np.cross(n, w), w).rate
    after = wanted(SWEEP, 20.0 + step, n + step * np.cross(n, w), w).rate
    slope = wanted(SWEEP, 20.0, n, w).slope
    np.testing.assert_allclose((after - before) / (2 * step), slope, atol=1e-8)


def test_no_cone_and_no_hold_command_rest():
    still = wanted(SWEEP._replace(angle=0.0, hold=0.0), 3.0, np.array([0.6, 0, 0.8]), np.ones(3))
    np.testing.assert_array_equal(still.rate, np.zeros(3))
    np.testing.assert_array_equal(still.slope, np.zeros(3))
