"""The length of a vector with normal errors: hand-worked bounds, brute force, rates of error."""

import numpy as np
import pytest
from scipy.optimize import minimize
from scipy.stats import chi2, norm

from equipoise.maths.gaussian_length import bounded_length, normal_points

E3 = np.eye(3)


def random_metric(rng, size=3):
    A = rng.normal(size=(size, size))
    return A @ A.T


def test_well_above_zero_the_bounds_are_those_of_a_scalar_normal_variable():
    """1 +/- 0.1: 0.804 to 1.196 by hand."""
    found = bounded_length(np.array([1.0]), np.array([[0.01]]), np.eye(1))
    assert found.value == pytest.approx(1.0)
    assert found.low == pytest.approx(1 - 1.96 * 0.1, abs=1e-4)
    assert found.high == pytest.approx(1 + 1.96 * 0.1, abs=2e-3)


def test_the_floor_is_the_quantile_of_the_errors_alone():
    """Of three equal errors the chi distribution, of one the two-sided normal quantile."""
    one = bounded_length(np.array([5.0]), np.array([[0.04]]), np.eye(1))
    assert one.floor == pytest.approx(0.2 * norm.ppf(0.9875), rel=0.01)
    three = bounded_length(np.zeros(3), 0.04 * E3, E3)
    assert three.floor == pytest.approx(0.2 * np.sqrt(chi2.ppf(0.975, 3)), rel=0.01)
    assert three.high == three.floor


def test_errors_in_proportion_are_no_part_of_the_floor():
    whole = bounded_length(np.array([3.0, 0, 0]), np.diag([0.09, 1e-4, 1e-4]), E3, 1e-4 * E3)
    assert whole.floor == pytest.approx(0.01 * np.sqrt(chi2.ppf(0.975, 3)), rel=0.01)
    assert whole.high == pytest.approx(3 + 1.96 * 0.3, rel=0.01)


@pytest.mark.parametrize("seed", range(4))
def test_the_lower_bound_is_the_shortest_vector_in_the_ellipsoid(seed):
    """Against a general minimiser, in a metric and with errors that are nobody's choice."""
    rng = np.random.default_rng(seed)
    Q, P, mean = random_metric(rng), 0.02 * random_metric(rng), rng.normal(size=3) * 2
    C = np.linalg.cholesky(P)
    radius = chi2.ppf(0.95, 3)
    answer = minimize(
        lambda u: (mean + C @ u) @ Q @ (mean + C @ u),
        np.zeros(3),
        jac=lambda u: 2 * C.T @ Q @ (mean + C @ u),
        constraints={"type": "ineq", "fun": lambda u: radius - u @ u, "jac": lambda u: -2 * u},
        method="SLSQP",
    )
    assert bounded_length(mean, P, Q).low == pytest.approx(np.sqrt(answer.fun), rel=1e-4)


def test_a_vector_within_its_errors_of_zero_may_be_none():
    assert bounded_length(np.array([0.1, 0.0, 0.0]), E3, E3).low == pytest.approx(0.0, abs=1e-9)


def test_directions_that_do_not_matter_do_not_count():
    """A metric of one direction in three: the bounds of one number."""
    Q = np.diag([1.0, 0.0, 0.0])
    found = bounded_length(np.array([1.0, 9.0, -9.0]), 0.01 * E3, Q)
    assert found.low == pytest.approx(1 - 1.96 * 0.1, abs=1e-4)
    assert found.high == pytest.approx(1 + 1.96 * 0.1, abs=2e-3)


@pytest.mark.parametrize("sd", [0.05, 0.3, 1.0])
def test_a_vector_at_the_limit_is_seldom_found_within_it_or_beyond(sd):
    """2.5 % to either side, whatever the errors, in 1000 draws (sd 0.5 %)."""
    rng, truth = np.random.default_rng(3), np.array([0.6, 0.0, -0.8])
    found = [bounded_length(truth + sd * rng.normal(size=3), sd**2 * E3, E3) for _ in range(1000)]
    passed = np.mean([each.high < 1.0 for each in found])
    failed = np.mean([each.low > 1.0 for each in found])
    assert passed < 0.025 + 3 * 0.005
    assert failed < 0.025 + 3 * 0.005


def test_the_points_are_those_of_a_normal_distribution():
    points = normal_points(4)
    np.testing.assert_allclose(points.mean(axis=0), 0.0, atol=2e-3)
    np.testing.assert_allclose(np.cov(points.T), np.eye(4), atol=0.01)
