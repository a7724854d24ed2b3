"""Levenberg-Marquardt: one step for a quadratic, the valley of Rosenbrock, honest convergence.

The compiled rule, driven by the loop that ``estimation.descent`` has, in plain Python.
"""

from typing import NamedTuple

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from equipoise.maths.levenberg_marquardt import (
    FIRST,
    FREE,
    LEAST,
    NEAR,
    TOLERANCE,
    judge,
    promise,
    tolerated,
)
from equipoise.maths.scaled_solve import scaled_solve

pairs = arrays(np.float64, 2, elements=st.floats(-3.0, 3.0))
STEEP = np.array([[2.0, 1.0], [1.0, 3.0], [0.0, 1.0]])


def linear(x):
    """Residuals 1 - M x: the least squares solution is known from lstsq."""
    return np.ones(3) - STEEP @ x, STEEP


def rosenbrock(x):
    """Residuals 10 (y - x^2), 1 - x, both 0 at (1, 1)."""
    e = np.array([-10 * (x[1] - x[0] ** 2), -(1 - x[0])])
    return e, np.array([[-20 * x[0], 10.0], [-1.0, 0.0]])


def quadratic(residuals, unit=1.0):
    """Cost, A and b of residuals e(x) with de = -J dx, x counted in ``unit``."""

    def evaluate(x):
        e, J = residuals(x * unit)
        J = J * unit
        return Quadratic(0.5 * float(e @ e), J.T @ J, J.T @ e)

    return evaluate


class Quadratic(NamedTuple):
    cost: float
    normal: np.ndarray
    descent: np.ndarray


class Found(NamedTuple):
    point: np.ndarray
    converged: bool
    evaluations: int


def minimise(evaluate, start, tolerance=TOLERANCE, most=300, watch=lambda cost: None):
    """The loop of the descent, for parameters that do form a vector space."""
    point, local, damping, growth = start, evaluate(start), FIRST, 2.0
    for evaluations in range(1, most):
        watch(local.cost)
        step = scaled_solve(local.normal, local.descent, damping)
        promised = promise(local.normal, local.descent, step)
        if promised < tolerance:
            bold = scaled_solve(local.normal, local.descent, FREE) if damping >= FREE else step
            near = abs(promise(local.normal, local.descent, bold)) < NEAR * tolerance
            return Found(point, near, evaluations)
        there = evaluate(point + step)
        taken, damping, growth = judge(2 * (local.cost - there.cost), promised, damping, growth)
        if taken:
            point, local = point + step, there
    return Found(point, False, most)


def test_linear_problem_takes_one_step():
    """One evaluation at the start, one at the optimum; the damping of 1e-6 is all that is left."""
    found = minimise(quadratic(linear), np.array([5.0, -3.0]))
    best, *_ = np.linalg.lstsq(STEEP, np.ones(3))
    assert found.converged
    assert found.evaluations == 2
    np.testing.assert_allclose(found.point, best, atol=1e-4)


@pytest.mark.parametrize("unit", [1.0, np.array([1e6, 1e-7])])
@pytest.mark.parametrize("start", [(-1.2, 1.0), (3.0, -4.0), (0.0, 10.0)])
def test_rosenbrock_in_any_units(start, unit):
    """The valley leads to (1, 1): converged to tolerance 1e-12 means 1e-6 sd, well below 1e-4."""
    evaluate = quadratic(rosenbrock, unit)
    found = minimise(evaluate, np.array(start) / unit, tolerance=1e-12, most=200)
    assert found.converged
    np.testing.assert_allclose(found.point * unit, [1.0, 1.0], atol=1e-4)


def test_rosenbrock_does_not_mind_units():
    """The path is the same in any units: as many evaluations."""
    units = (np.ones(2), np.array([1e6, 1e-7]))
    runs = [minimise(quadratic(rosenbrock, u), np.array([-1.2, 1.0]) / u) for u in units]
    assert runs[0].evaluations == runs[1].evaluations


def test_cost_never_rises():
    """What is accepted is never worse than what was before."""
    observed = []
    minimise(quadratic(rosenbrock), np.array([-1.2, 1.0]), watch=observed.append)
    assert len(observed) > 5
    assert (np.diff(observed) <= 0).all()


@given(pairs, pairs)
def test_promise_is_kept_by_a_linear_problem(x, step):
    """Twice the cost falls by exactly what was promised, whatever the step."""
    evaluate = quadratic(linear)
    gained = 2 * (evaluate(x).cost - evaluate(x + step).cost)
    assert promise(*evaluate(x)[1:], step) == pytest.approx(gained, abs=1e-10)


def test_step_into_nowhere_is_taken_back():
    """log x from 3: Newton goes to 3 - 3 log 3 < 0, where it is not a number; 1 is found anyway."""

    def residuals(x):
        with np.errstate(invalid="ignore"):
            return np.array([-np.log(x[0])]), np.array([[1 / x[0]]])

    found = minimise(quadratic(residuals), np.array([3.0]), tolerance=1e-12)
    assert found.converged
    np.testing.assert_allclose(found.point, 1.0, atol=1e-5)


def test_too_few_evaluations_are_not_called_converged():
    """Three evaluations are not enough for Rosenbrock, and it says so."""
    found = minimise(quadratic(rosenbrock), np.array([-1.2, 1.0]), most=3)
    assert not found.converged
    assert found.evaluations == 3


def test_a_point_where_every_step_fails_is_not_called_converged():
    """A gradient of the wrong sign: the cost can only rise, and that is no convergence."""

    def misled(x):
        right = quadratic(linear)(x)
        return Quadratic(right.cost, right.normal, -right.descent)

    assert not minimise(misled, np.array([5.0, -3.0])).converged


# --- The rule, by hand ------------------------------------------------------------------------


def test_a_rise_is_refused_and_damped_twice_as_hard_each_time():
    """Nielsen: lam nu, nu doubles. From no damping at all it begins at 1e-6."""
    assert judge(-1.0, 2.0, 1e-3, 2.0) == (False, 2e-3, 4.0)
    assert judge(-1.0, 2.0, 2e-3, 4.0) == (False, 8e-3, 8.0)
    assert judge(-1.0, 2.0, 1e-12, 2.0) == (False, 2e-6, 4.0)


@pytest.mark.parametrize("lost", [np.nan, -np.inf, np.inf])
def test_a_cost_that_is_no_number_is_refused(lost):
    """Nowhere is no place to go, and no gain is infinite."""
    assert judge(lost, 1.0, 1e-3, 2.0)[0] is False


@pytest.mark.parametrize(
    ("gained", "factor"), [(2.0, 0.1), (1.0, 1.0), (1.5, 0.875), (0.5, 1.125), (0.0, 2.0)]
)
def test_an_accepted_step_adapts_damping_to_the_gain_ratio(gained, factor):
    """1 - (2 r - 1)^3 with r = gained / promised, at least a tenth."""
    taken, damping, growth = judge(gained, 2.0, 1e-3, 8.0)
    assert (taken, growth) == (True, 2.0)
    assert damping == pytest.approx(1e-3 * factor)


def test_damping_has_a_least():
    """Below rounding it says nothing."""
    assert judge(1.0, 1.0, 1e-12, 2.0)[1] == LEAST


def test_tolerance_grows_with_the_misfit():
    """Twice the cost a row, where that is more than one."""
    assert tolerated(10.0, 100) == TOLERANCE
    assert tolerated(150.0, 100) == pytest.approx(3 * TOLERANCE)
