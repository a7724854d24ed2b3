"""Programmes of three rows against scipy's."""

import numpy as np
import pytest
from scipy.optimize import linprog

from equipoise.maths.bounded_simplex import Table, level_of, minimise


def table_of(cost, A, b, upper, dear=1e4):
    """Return a table that begins with an error column for each row."""
    sign = np.where(b >= 0, 1.0, -1.0)
    n = len(cost)
    rows = np.hstack([sign[:, None] * A, np.eye(3)])
    cost, upper = np.append(cost, [dear] * 3), np.append(upper, [np.inf] * 3)
    full = np.zeros(n + 3, dtype=np.bool_)
    return Table(rows, np.arange(n, n + 3), np.abs(b), cost, upper, full)


def programme(rng, whole):
    """Bounded columns around a point that solves the rows; whole numbers make many ties."""
    n = int(rng.integers(4, 15))
    draw = rng.integers(-3, 4, (3, n)) if whole else rng.normal(size=(3, n))
    upper = rng.integers(0, 4, n).astype(float) if whole else rng.uniform(0, 3, n)
    cost = rng.integers(0, 4, n).astype(float) if whole else rng.uniform(0, 3, n)
    return cost, draw.astype(float), draw @ (upper * rng.integers(0, 2, n)), upper


@pytest.mark.parametrize("whole", [False, True])
def test_optimum_is_that_of_scipy(whole):
    """200 random programmes, among them degenerate ones: same cost, rows kept, within bounds."""
    rng = np.random.default_rng(4)
    for _ in range(200):
        cost, A, b, upper = programme(rng, whole)
        at = table_of(cost, A, b, upper)
        minimise(at)
        x = np.array([level_of(at, j) for j in range(len(cost))])
        best = linprog(cost, A_eq=A, b_eq=b, bounds=list(zip(0 * upper, upper, strict=True)))
        np.testing.assert_allclose(A @ x, b, atol=1e-8)
        assert np.all((x >= -1e-9) & (x <= upper + 1e-9))
        assert cost @ x == pytest.approx(best.fun, abs=1e-7)


def test_by_hand():
    """Two columns for the first row, the cheap one up to 1: then the dear one does the rest."""
    A = np.array([[1.0, 1.0], [0.0, 0.0], [0.0, 0.0]])
    at = table_of(np.array([1.0, 2.0]), A, np.array([3.0, 0.0, 0.0]), np.array([1.0, 5.0]))
    minimise(at)
    assert [level_of(at, j) for j in range(2)] == [1.0, 2.0]


def test_what_cannot_be_done_is_left_as_error():
    """Row 1 wants 3 of a column that has 2."""
    A = np.array([[1.0], [0.0], [0.0]])
    at = table_of(np.array([1.0]), A, np.array([3.0, 0.0, 0.0]), np.array([2.0]))
    minimise(at)
    assert level_of(at, 0) == 2.0
    assert level_of(at, 1) == 1.0
