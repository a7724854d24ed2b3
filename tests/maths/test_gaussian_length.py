"""The length of a vector with normal errors: hand-worked bounds, brute force, rates of error."""

import numpy as np
import pytest
from scipy.optimize import minimize
from scipy.stats import chi2, ncx2, norm

from equipoise.maths.gaussian_length import bounded_length, distances, normal_points
from tests.support.thorough import count

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
def test_the_distance_from_an_ellipsoid_is_that_of_its_nearest_point(seed):
    """Against a general minimiser, of an ellipsoid that is nobody's choice; 0 within it."""
    rng = np.random.default_rng(seed)
    g, curvature = rng.normal(size=3), rng.uniform(0.1, 3.0, 3)
    z = np.array([*(3 * rng.normal(size=(3, 3))), -g / curvature])
    for one, found in zip(z, distances(z, g, curvature), strict=True):
        inside = {"type": "ineq", "fun": lambda v: -(2 * g @ v + curvature @ v**2)}
        nearest = minimize(
            lambda v, one=one: np.sum((v - one) ** 2), -g / curvature, constraints=inside
        )
        assert found == pytest.approx(np.sqrt(nearest.fun), abs=1e-3)


@pytest.mark.parametrize("length", [3.2, 4.0, 6.0, 20.0])
def test_of_equal_errors_the_lower_bound_is_known_in_closed_form(length):
    """|x + z| is noncentral chi: L + r is its quantile where x is as long as L; 3 sd at L = 0."""
    low = bounded_length(np.array([0.0, length, 0.0]), E3, E3).low
    assert np.sqrt(ncx2.ppf(0.975, 3, low**2)) == pytest.approx(length, abs=0.06)


@pytest.mark.parametrize("unit", [1e-9, 1e-6, 1e3])
def test_bounds_are_the_same_in_any_unit(unit):
    """Of micrometres in metres: fails of what is right were 8 % when a search had a scale."""
    rng = np.random.default_rng(5)
    mean, P = np.array([0.4, -0.2, 1.5]), np.diag([1e-4, 4e-4, 0.06]) + 1e-5 * random_metric(rng)
    one, other = bounded_length(mean, P, E3), bounded_length(unit * mean, unit**2 * P, E3)
    assert np.array(other) / unit == pytest.approx(np.array(one), rel=1e-6)
    assert 0.0 < one.low < one.value


def test_a_vector_no_longer_than_its_errors_may_be_none():
    """sqrt(chi2(0.975, 3)) = 3.057 sd."""
    assert bounded_length(np.array([2.9, 0.0, 0.0]), E3, E3).low == 0.0


SLENDER = [
    ((0.5, 0.5, 0.01), (0.0, 0.0, 0.2)),
    ((0.5, 0.3, 0.01), (0.0, 0.0, 1.0)),
    ((0.01, 0.01, 0.5), (0.2, 0.0, 0.01)),
]


@pytest.mark.parametrize(("sd", "truth"), SLENDER)
def test_no_vector_is_often_found_longer_than_it_is(sd, truth):
    """Errors much unlike each other, length 0.4 to 100 sd: 4 % and three sd of it at most."""
    rng, length, draws = np.random.default_rng(4), float(np.linalg.norm(truth)), count(600, 200)
    means = np.array(truth) + rng.normal(size=(draws, 3)) * sd
    P = np.diag(np.square(sd))
    longer = [bounded_length(m, P, E3).low > length for m in means if np.linalg.norm(m) > length]
    assert np.sum(longer) / draws < 0.04 + 3 * (0.04 * 0.96 / draws) ** 0.5


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
    """2.5 % to either side, whatever the errors, within three sd of the share in so many draws."""
    rng, truth, draws = np.random.default_rng(3), np.array([0.6, 0.0, -0.8]), count(1000, 300)
    found = [bounded_length(truth + sd * rng.normal(size=3), sd**2 * E3, E3) for _ in range(draws)]
    most = 0.025 + 3 * (0.025 * 0.975 / draws) ** 0.5
    passed = np.mean([each.high < 1.0 for each in found])
    failed = np.mean([each.low > 1.0 for each in found])
    assert passed < most
    assert failed < most


def test_the_points_are_those_of_a_normal_distribution():
    points = normal_points(4)
    np.testing.assert_allclose(points.mean(axis=0), 0.0, atol=2e-3)
    np.testing.assert_allclose(np.cov(points.T), np.eye(4), atol=0.01)
