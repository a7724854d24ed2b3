"""Levenberg-Marquardt: one step for a quadratic, the valley of Rosenbrock, honest convergence."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from equipoise.maths.levenberg_marquardt import Quadratic, minimise, promise, scaled_solve

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


def straight(x, local, damping):
    step = scaled_solve(local.normal, local.descent, damping)
    return x + step, promise(local, step)


def test_linear_problem_takes_one_step():
    """One evaluation at the start, one at the optimum; the damping of 1e-6 is all that is left."""
    found = minimise(quadratic(linear), straight, np.array([5.0, -3.0]))
    best, *_ = np.linalg.lstsq(STEEP, np.ones(3))
    assert found.converged
    assert found.evaluations == 2
    np.testing.assert_allclose(found.point, best, atol=1e-4)


@pytest.mark.parametrize("unit", [1.0, np.array([1e6, 1e-7])])
@pytest.mark.parametrize("start", [(-1.2, 1.0), (3.0, -4.0), (0.0, 10.0)])
def test_rosenbrock_in_any_units(start, unit):
    """The valley leads to (1, 1): converged to tolerance 1e-12 means 1e-6 sd, well below 1e-4."""
    evaluate = quadratic(rosenbrock, unit)
    found = minimise(evaluate, straight, np.array(start) / unit, tolerance=1e-12, most=200)
    assert found.converged
    np.testing.assert_allclose(found.point * unit, [1.0, 1.0], atol=1e-4)


def test_rosenbrock_does_not_mind_units():
    """The path is the same in any units: as many evaluations."""
    units = (np.ones(2), np.array([1e6, 1e-7]))
    runs = [minimise(quadratic(rosenbrock, u), straight, np.array([-1.2, 1.0]) / u) for u in units]
    assert runs[0].evaluations == runs[1].evaluations


def test_cost_never_rises():
    """What is accepted is never worse than what was before."""
    seen = []

    def propose(x, local, damping):
        seen.append(local.cost)
        return straight(x, local, damping)

    minimise(quadratic(rosenbrock), propose, np.array([-1.2, 1.0]))
    assert len(seen) > 5
    assert (np.diff(seen) <= 0).all()


@given(pairs, pairs)
def test_promise_is_kept_by_a_linear_problem(x, step):
    """Twice the cost falls by exactly what was promised, whatever the step."""
    evaluate = quadratic(linear)
    gained = 2 * (evaluate(x).cost - evaluate(x + step).cost)
    assert promise(evaluate(x), step) == pytest.approx(gained, abs=1e-10)


def test_step_into_nowhere_is_taken_back():
    """log x from 3: Newton goes to 3 - 3 log 3 < 0, where it is not a number; 1 is found anyway."""

    def residuals(x):
        with np.errstate(invalid="ignore"):
            return np.array([-np.log(x[0])]), np.array([[1 / x[0]]])

    found = minimise(quadratic(residuals), straight, np.array([3.0]), tolerance=1e-12)
    assert found.converged
    np.testing.assert_allclose(found.point, 1.0, atol=1e-5)


def test_too_few_evaluations_are_not_called_converged():
    """Three evaluations are not enough for Rosenbrock, and it says so."""
    found = minimise(quadratic(rosenbrock), straight, np.array([-1.2, 1.0]), most=3)
    assert not found.converged
    assert found.evaluations == 3


def test_damping_by_hand():
    """Damped by 1 the diagonal doubles: half of Newton's step when A is diagonal."""
    A, b = np.diag([4.0, 1e-12]), np.array([8.0, 3e-12])
    np.testing.assert_allclose(scaled_solve(A, b, 0.0), [2.0, 3.0])
    np.testing.assert_allclose(scaled_solve(A, b, 1.0), [1.0, 1.5])


def test_unseen_parameter_stays():
    """A zero row says nothing about its parameter: no step along it."""
    step = scaled_solve(np.diag([2.0, 0.0]), np.array([2.0, 0.0]), 1e-9)
    np.testing.assert_allclose(step, [1.0, 0.0], atol=1e-8)


def test_a_point_where_every_step_fails_is_not_called_converged():
    """A gradient of the wrong sign: the cost can only rise, and that is no convergence."""

    def misled(x):
        right = quadratic(linear)(x)
        return Quadratic(right.cost, right.normal, -right.descent)

    assert not minimise(misled, straight, np.array([5.0, -3.0])).converged
