"""The compiled descent: honest about how it ends, and the same alone or abreast."""

from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace

import numpy as np
import pytest

from equipoise.estimation.output_error.kernels.gauss_newton import HELD
from equipoise.estimation.output_error.solution import evaluate, settle
from equipoise.estimation.output_error.trajectory import Params, fit, problem_of
from equipoise.maths.levenberg_marquardt import promise
from equipoise.maths.scaled_solve import scaled_solve
from tests.support.builders import move_at, noisy, platform, recording


def record(seed):
    return noisy(recording(20.0, move_at(5.0, 20.0), gyro=20.0), seed, np.zeros(3))


TESTBED = platform(3e-4, gyro=True)


@pytest.fixture(scope="module")
def posed():
    """A problem and a point some sd off its optimum."""
    problem = problem_of(record(1), TESTBED, Params())
    point = fit(record(2), TESTBED, Params()).point
    return problem, replace(point, w0=point.w0 + 1e-3, com=point.com + 2e-5)


def test_cost_never_rises(posed):
    """With one evaluation more the cost is at most what it was."""
    costs = [settle(*posed, most=most).at.cost for most in range(1, 8)]
    assert len(set(costs)) > 2
    assert (np.diff(costs) <= 0).all()


def test_too_few_evaluations_are_not_called_converged(posed):
    """Two are not enough from so far off, and it says so."""
    found = settle(*posed, most=2)
    assert not found.converged
    assert found.evaluations == 2


def test_what_it_reports_is_the_model_at_its_point(posed):
    """Cost, A, b and residuals of the point where it ended, not of its last trial."""
    problem, _ = posed
    for most in (3, 300):
        found = settle(*posed, most=most)
        again = evaluate(problem, found.point)
        assert found.at.cost == again.cost
        for name in ("normal", "descent", "left_q", "left_w"):
            np.testing.assert_array_equal(getattr(found.at, name), getattr(again, name))


def test_at_its_end_no_step_promises_anything(posed):
    """A hundredth of a standard deviation: 1e-4 of twice the cost."""
    found = settle(*posed)
    assert found.converged
    step = scaled_solve(found.at.normal, found.at.descent, 0.0)
    assert 0 <= promise(found.at.normal, found.at.descent, step) < 1e-4


def test_a_start_that_leads_nowhere_is_not_converged(posed):
    """A motion that is no number has no local model."""
    problem, point = posed
    found = settle(problem, replace(point, w0=point.w0 * np.nan))
    assert not found.converged
    assert found.evaluations == 1
    assert np.isinf(found.at.cost)
    assert (found.at.normal == np.eye(problem.layout.size)).all()


def test_what_is_held_does_not_move(posed):
    """Its own entry alone is left in A, with the sd that is reported of it."""
    problem, point = posed
    held = np.arange(problem.layout.size) == 7
    problem = replace(problem, prior=replace(problem.prior, held=held))
    found = settle(problem, point)
    size = abs(problem.prior.mean[7])
    assert found.at.normal[7, 7] == pytest.approx((HELD * size) ** -2)
    assert not found.at.normal[7, ~held].any()
    before, after = (p.body(problem.mass).inertia_P[1, 1] for p in (point, found.point))
    assert after == pytest.approx(before, rel=1e-13)


def test_abreast_is_the_same_as_one_by_one():
    """Two threads, six records: every number to the last digit."""
    records = [record(seed) for seed in range(6)]

    def cost_and_point(one):
        found = fit(one, TESTBED, Params())
        return [found.at.cost, *found.point.flat]

    with ThreadPoolExecutor(2) as pool:
        abreast = list(pool.map(cost_and_point, records))
    assert abreast == [cost_and_point(one) for one in records]
