"""An uncertain vector and its tolerances: worked by hand, and how often bounds are wrong."""

import numpy as np
import pytest
from scipy.special import ndtr

from equipoise.procedure.steps.gaussian_box import bounded_use, probability_inside

TOLERANCE = np.array([2.0, 2.0, 3.0])
NOTHING = np.zeros(3)


def test_axes_on_their_own_multiply():
    """At the middle with sd t / 2 on each axis: 0.9545^3."""
    found = probability_inside(NOTHING, np.diag((TOLERANCE / 2) ** 2), TOLERANCE)
    assert found == pytest.approx((ndtr(2) - ndtr(-2)) ** 3, abs=2e-3)


def test_axes_that_err_together_are_one():
    """All axes err by the same share of their tolerance: as one of them alone."""
    found = probability_inside(NOTHING, np.outer(TOLERANCE, TOLERANCE) / 4, TOLERANCE)
    assert found == pytest.approx(ndtr(2) - ndtr(-2), abs=2e-3)


def test_bounds_of_one_axis_by_hand():
    """1.5 of 3 used, sd 0.5: 97.5 % use less than (1.5 + 1.96 * 0.5) / 3."""
    use = bounded_use(np.array([0.0, 0.0, -1.5]), np.diag([1e-12, 1e-12, 0.25]), TOLERANCE)
    assert use.value == pytest.approx(0.5)
    np.testing.assert_allclose([use.low, use.high], [(1.5 - 0.98) / 3, (1.5 + 0.98) / 3], atol=2e-3)
    assert use.floor == pytest.approx(2.2414 * 0.5 / 3, abs=2e-3)  # 97.5 %, two-sided


def test_the_use_is_within_the_box_as_often_as_its_bound_says():
    """high <= 1 and P(inside) >= 97.5 % are one and the same, whatever the covariance."""
    rng = np.random.default_rng(0)
    for _ in range(50):
        C = rng.normal(size=(3, 3)) * rng.uniform(0.05, 0.8)
        mean = rng.uniform(-1, 1, 3) * TOLERANCE
        use, inside = (of(mean, C @ C.T, TOLERANCE) for of in (bounded_use, probability_inside))
        assert (use.high <= 1) == (inside >= 0.975)


@pytest.mark.parametrize("edge", [(2.0, 0.0, 0.0), (2.0, 2.0, 3.0), (0.5, -1.0, -3.0)])
def test_a_truth_at_the_edge_passes_in_at_most_2_5_percent(edge):
    """1000 estimates of a correlated error: 2.5 % and three sd of that share."""
    rng = np.random.default_rng(1)
    C = np.array([[0.3, 0.0, 0.0], [0.1, 0.2, 0.0], [0.2, -0.1, 0.4]])
    found = np.array(edge) + rng.normal(size=(1000, 3)) @ C.T
    passed = [bounded_use(mean, C @ C.T, TOLERANCE).high <= 1 for mean in found]
    assert np.mean(passed) <= 0.025 + 3 * np.sqrt(0.025 * 0.975 / 1000)


@pytest.mark.parametrize("edge", [(1.999, 0.0, 0.0), (0.5, -1.0, -2.999)])
def test_a_truth_just_inside_one_face_fails_in_at_most_2_5_percent(edge):
    rng = np.random.default_rng(2)
    C = np.array([[0.3, 0.0, 0.0], [0.1, 0.2, 0.0], [0.2, -0.1, 0.4]])
    found = np.array(edge) + rng.normal(size=(1000, 3)) @ C.T
    failed = [bounded_use(mean, C @ C.T, TOLERANCE).low > 1 for mean in found]
    assert np.mean(failed) <= 0.025 + 3 * np.sqrt(0.025 * 0.975 / 1000)
