"""The covariance goes with the point, in coordinates that keep what is unobservable constant."""

import numpy as np
import pytest

from equipoise.estimation.tracker.linearisation_point import (
    distance,
    doubt,
    doubt_of_shape,
    moved,
    nearer,
    transport,
    transport_sag,
)
from equipoise.estimation.tracker.stored_covariance import SAG_ROW, SIZE, WITH_SAG

POINT = np.array([2e-6, -3e-6, -80e-6, 0.35, 0.54, 0.85, 0.01, -0.02, 0.015])
POSTERIOR = np.array([3e-6, -2e-6, -95e-6, 0.38, 0.50, 0.92, 0.02, -0.01, 0.0])
SAG = np.array([5e-6, -3e-6, 1e-6, 2e-6, -4e-6])
SPREAD = np.array([1e-5, 1e-5, 1e-5, 0.05, 0.05, 0.05, 0.02, 0.02, 0.02])


def in_scale(x: np.ndarray) -> np.ndarray:
    """s = ln tr J, then r / tr J and five of the six J / tr J: nine coordinates."""
    size = x[3:6].sum()
    return np.array([np.log(size), *(x[:3] / size), *(x[4:] / size)])


def slope(x: np.ndarray) -> np.ndarray:
    """d(coordinates)/dx by central differences."""
    steps = 1e-6 * np.maximum(np.abs(x), 1e-2 * SPREAD)
    columns = [
        (in_scale(x + h * e) - in_scale(x - h * e)) / (2 * h)
        for h, e in zip(steps, np.eye(9), strict=True)
    ]
    return np.array(columns).T


def some_covariance() -> np.ndarray:
    """Of all errors, correlated."""
    root = np.random.default_rng(1).normal(size=(SIZE, SIZE))
    sd = np.concatenate([np.full(6, 1e-3), SPREAD, np.full(SIZE - 15, 1e-4)])
    return root @ root.T * np.outer(sd, sd)


def posterior_at(body: np.ndarray) -> np.ndarray:
    return np.concatenate([[1, 0, 0, 0], np.zeros(3), body, np.zeros(3)])


def carried(P: np.ndarray, *stations: np.ndarray) -> np.ndarray:
    """P after going from POINT by way of the stations."""
    P, point = P.copy(), POINT.copy()
    for body in stations:
        transport(P, point, posterior_at(body))
        np.testing.assert_array_equal(point, body)
    return P


def test_transport_is_a_constant_covariance_in_scale_coordinates():
    """T = (d coordinates/dx at the estimate)^-1 (d coordinates/dx at the point), by differences."""
    T = np.eye(SIZE)
    T[6:15, 6:15] = np.linalg.solve(slope(POSTERIOR), slope(POINT))
    P = some_covariance()
    scale = np.sqrt(np.outer(np.diag(P), np.diag(P)))
    np.testing.assert_allclose(carried(P, POSTERIOR) / scale, T @ P @ T.T / scale, atol=2e-5)


def test_the_unobservable_direction_goes_along():
    """P = x x^T at the point becomes x' x'^T at the estimate."""
    P = np.zeros((SIZE, SIZE))
    P[6:15, 6:15] = np.outer(POINT, POINT)
    there = carried(P, POSTERIOR)[6:15, 6:15]
    np.testing.assert_allclose(there, np.outer(POSTERIOR, POSTERIOR), rtol=1e-9, atol=1e-15)


def test_the_way_does_not_matter():
    """By way of another point, and back to where it began."""
    P, detour = some_covariance(), 1.3 * POSTERIOR + 0.1 * POINT
    np.testing.assert_allclose(carried(P, detour, POSTERIOR), carried(P, POSTERIOR), rtol=1e-9)
    np.testing.assert_allclose(carried(P, POSTERIOR, POINT), P, rtol=1e-9)


def test_the_distance_unit_is_one_percent_of_a_moment_or_three_percent_of_r():
    """1 % of sqrt(J_xx J_yy) = 4.35e-3 kg m^2; 3 % of |r| = 2.4 um."""
    for k, step in ((6, 4.35e-3), (3, 3.5e-3), (2, 2.4e-6)):
        near, beyond = POINT.copy(), POINT.copy()
        near[k] += 0.98 * step
        beyond[k] += 1.02 * step
        assert distance(POINT, posterior_at(near)) == pytest.approx(0.98, rel=2e-3)
        assert distance(POINT, posterior_at(beyond)) == pytest.approx(1.02, rel=2e-3)


def test_an_impossible_inertia_is_approached_and_stays_possible():
    """J_xx from 0.35: the whole way -0.35, half 0, a quarter 0.175, an eighth 0.2625: that."""
    body = POINT.copy()
    body[6:] = 0.0
    wild = body.copy()
    wild[3] = -0.35
    assert nearer(body, wild)[3] == pytest.approx(0.2625)
    np.testing.assert_array_equal(nearer(body, POSTERIOR), POSTERIOR)


def test_products_decide_whether_an_inertia_is_possible():
    """From diag(2, 2, 2): products c, c, c leave eigenvalues 2 + 2 c, 2 - c, 2 - c; least 1.

    c = 0.9 leaves 1.1: all the way. c = -0.9 leaves 0.2: half-way 1.1.
    """
    body = np.array([0, 0, -1e-4, 2.0, 2.0, 2.0, 0.0, 0.0, 0.0])
    for product, expected in ((0.9, 0.9), (-0.9, -0.45)):
        wild = body.copy()
        wild[6:] = product
        np.testing.assert_allclose(nearer(body, wild)[6:], expected)


def test_scale_is_doubt_but_no_doubt_of_shape():
    """Only the common factor unknown, by 20 %: every moment 20 %, the shape not at all."""
    P = np.zeros((SIZE, SIZE))
    P[6:15, 6:15] = 0.04 * np.outer(POINT, POINT)
    assert doubt(POINT, P) == pytest.approx(0.2)
    assert doubt_of_shape(POINT, P) < 1e-7


def test_a_sag_scales_as_r_and_j_do():
    """T takes x = (r, J, C) to x', and a change of x along itself stays one."""
    point, new = np.append(POINT, SAG), np.append(POSTERIOR, 1.1 * SAG)
    x = np.r_[6:15, SAG_ROW:WITH_SAG]
    along = np.zeros(WITH_SAG)
    along[x] = point
    P, end = np.outer(along, along), np.zeros(1 + WITH_SAG)
    end[7:16] = POSTERIOR
    transport_sag(P, point, new)
    transport(P, point, end)
    expected = np.zeros(WITH_SAG)
    expected[x] = new
    expected = np.outer(expected, expected)
    np.testing.assert_allclose(P, expected, rtol=0, atol=1e-12 * expected.max())
    np.testing.assert_array_equal(point, new)


def test_the_point_moves_when_the_sag_has_moved_by_as_much_as_r_may():
    """3 % of |r|: beyond it the stiffness that the platform swings by is another."""
    point, end = np.append(POINT, SAG), np.zeros(1 + WITH_SAG)
    end[7:16], end[1 + SAG_ROW :] = POINT, SAG
    assert moved(point, end) == 0.0
    end[1 + SAG_ROW] += 0.06 * np.linalg.norm(POINT[:3])
    assert moved(point, end) == pytest.approx(2.0)
