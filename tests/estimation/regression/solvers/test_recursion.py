"""Where a recursion begins that asks for no start: once the platform turns (Lee section IV)."""

from dataclasses import replace

import numpy as np
import pytest

from equipoise.estimation.regression.formulations.rows import Rows
from equipoise.estimation.regression.solvers.recursion import batch_start, turns
from equipoise.estimation.regression.solvers.recursive import Recursion, begin_with
from equipoise.model.estimate import INERTIA

NOISE, J, EVERY = 1e-3, np.array([20.0, 16.0, 14.0]), 0.1  # rad/s, kg m^2, s
LOOSE = Recursion(np.ones(3), np.full(3, 100.0), np.full(3, NOISE), 0.0, np.full(3, 100.0))
MOMENTS = INERTIA[:3]


def rows_from(rest, duration=60.0):
    """J_a w_a = h_a, measured with noise: at rest until ``rest`` (s), then 0.1 rad/s to and fro."""
    rng, t = np.random.default_rng(1), np.arange(0.0, duration, EVERY)
    turning = 0.1 * np.sin(t[:, None] * [0.5, 0.7, 0.9]) * (t[:, None] >= rest)
    A = np.zeros((len(t), 3, 3))
    A[:, range(3), range(3)] = turning + NOISE * rng.standard_normal((len(t), 3))
    return Rows(t, A, turning * J, MOMENTS)


def test_at_rest_noise_alone_would_determine_a_moment_of_zero():
    rows = rows_from(np.inf)
    state = begin_with(LOOSE, rows)
    assert np.all(np.abs(state.x) < 0.1)
    assert np.all(np.diag(state.P) ** 0.5 < 0.1)
    assert not turns(rows, NOISE)


@pytest.mark.parametrize(("rest", "begins"), [(0.0, 10.0), (12.0, 20.0)])
def test_it_begins_once_the_platform_turns(rest, begins):
    state, n = batch_start(LOOSE, rows_from(rest), NOISE)
    assert n == round(begins / EVERY) + 1
    np.testing.assert_allclose(state.x, J, rtol=5e-3)


def test_a_platform_that_never_turns_begins_with_the_loose_start():
    state, n = batch_start(LOOSE, rows_from(np.inf), NOISE)
    assert n == 0
    np.testing.assert_array_equal(state.x, LOOSE.start)


def test_an_axis_that_does_not_turn_holds_the_beginning_back():
    rows = rows_from(0.0)
    A = rows.A.copy()
    A[:, 2, 2] = NOISE * np.random.default_rng(2).standard_normal(len(rows.t))
    assert not turns(replace(rows, A=A), NOISE)


def test_with_the_moments_held_no_turning_is_needed():
    rows = rows_from(np.inf)
    assert turns(replace(rows, names=("com_x", "com_y", "com_z")), NOISE)
