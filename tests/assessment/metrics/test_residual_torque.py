"""Torque and swing of an unbalanced platform, against numbers worked by hand."""

import numpy as np
import pytest

from equipoise.assessment.metrics.residual_torque import (
    level_torque,
    swing_period,
    with_doubtful_inertia,
)

UP = np.array([0.0, 0.0, 1.0])
WEIGHT = 10.0  # N
SD = np.array([1e-6, 2e-6, 5e-6])
INERTIA = np.diag([0.4, 0.9, 1.5])


def test_torque_of_a_3_4_5_offset():
    """10 N on an arm of (3, 4) um: 50 uN m; the height does not matter, its sd does not either."""
    torque = level_torque(WEIGHT, np.array([3e-6, 4e-6, -100e-6]), SD, UP)
    assert torque.value == pytest.approx(50e-6)
    assert torque.sd == pytest.approx(WEIGHT * np.hypot(0.6 * 1e-6, 0.8 * 2e-6))


def test_torque_follows_the_axis_that_points_up():
    across = level_torque(WEIGHT, np.array([3e-6, -100e-6, 4e-6]), SD, np.array([0.0, 1.0, 0.0]))
    assert across.value == pytest.approx(50e-6)


def test_an_unobservable_height_does_not_widen_the_level_torque():
    unseen = np.array([1e-6, 2e-6, np.inf])
    torque = level_torque(WEIGHT, np.array([3e-6, 4e-6, -100e-6]), unseen, UP)
    assert torque.sd == pytest.approx(WEIGHT * np.hypot(0.6 * 1e-6, 0.8 * 2e-6))


def test_period_is_that_of_the_slower_axis():
    """J = 0.9, m g h = 10 * 90 um = 9e-4: T = 2 pi sqrt(1000) = 198.69 s."""
    period = swing_period(WEIGHT, np.array([0, 0, -90e-6]), SD, INERTIA, UP)
    assert period.value == pytest.approx(198.692, rel=1e-5)
    assert period.sd == pytest.approx(period.value / 2 * 5 / 90)


@pytest.mark.parametrize("height", [0.0, 10e-6])
def test_a_platform_with_its_centre_above_topples(height):
    assert np.isinf(swing_period(WEIGHT, np.array([0, 0, height]), SD, INERTIA, UP).value)


def test_an_uncertainty_of_one_step_is_the_slope():
    """First order: the sd equals the change over one sd, to a few per cent."""
    com, small = np.array([3e-6, 4e-6, -90e-6]), SD * 1e-3
    ahead = swing_period(WEIGHT, com + UP * small[2], small, INERTIA, UP)
    here = swing_period(WEIGHT, com, small, INERTIA, UP)
    assert ahead.value - here.value == pytest.approx(here.sd, rel=0.01)


def test_what_is_unobservable_across_up_does_not_widen_the_period():
    """A run that ends unmeasured knows nothing of x and y; half of 3 um in 90 is the period's."""
    period = swing_period(WEIGHT, np.array([0, 0, -90e-6]), np.array([np.inf, np.inf, 3e-6]),
                          INERTIA, UP)  # fmt: skip
    assert period.sd / period.value == pytest.approx(0.5 * 3 / 90)


def test_a_doubtful_inertia_makes_the_period_doubtful():
    """Both 4 % and 3 % of r and J: half of 5 % of the period."""
    sd = np.array([0.0, 0.0, 0.04 * 90e-6])
    period = swing_period(WEIGHT, np.array([0, 0, -90e-6]), sd, INERTIA, UP)
    assert with_doubtful_inertia(period, 0.03).sd == pytest.approx(0.025 * period.value)
