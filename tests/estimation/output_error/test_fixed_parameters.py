"""Held moments and centre of mass: put where they are held, and there when a search has ended."""

from dataclasses import replace

import numpy as np
import pytest

from equipoise.estimation.output_error.fixed_parameters import is_pinned, pinned, settle_pinned
from equipoise.estimation.output_error.trajectory import Params, problem_of
from equipoise.maths.linalg import pack_symmetric, unpack_symmetric
from equipoise.maths.pseudo_inertia import from_inertia
from equipoise.model.mass_properties import parallel_axis
from tests.support.builders import COM, INERTIA, MASS, noisy, platform, recording
from tests.support.event_records import TRUTH

HOLD = Params(hold=("inertia_P_zz", "com_x"))
HELD = [2, 6]  # of six moments and com
WRONG = np.append(1.02 * INERTIA, COM + [1e-3, 2e-4, -1e-3])  # kg m2, m


def posed(params, seed=0):
    """Forty seconds of camera without a move; the testbed is true."""
    return problem_of(noisy(recording(40.0), seed), platform(), params)


def body_at(values):
    """The true motion with another body: six moments about P, and com."""
    inertia_C = unpack_symmetric(values[:6]) - parallel_axis(MASS, values[6:])
    return replace(TRUTH, six=from_inertia(inertia_C), com=values[6:])


def values_at(point):
    body = point.body(MASS)
    return np.append(pack_symmetric(body.inertia_P), body.com)


def test_what_is_held_is_put_right_and_nothing_else():
    """Moments about P: com that moves takes none of them along."""
    problem, wrong = posed(HOLD), body_at(WRONG)
    right = WRONG.copy()
    right[HELD] = INERTIA[2], COM[0]
    assert not is_pinned(problem, wrong)
    found = pinned(problem, wrong)
    assert is_pinned(problem, found)
    np.testing.assert_allclose(values_at(found), right, rtol=1e-9, atol=1e-12)


@pytest.mark.parametrize("k", HELD)
def test_one_that_is_off_is_enough(k):
    """By a hundred millionth."""
    values = np.append(INERTIA, COM)
    values[k] *= 1 + 1e-8
    assert not is_pinned(posed(HOLD), body_at(values))


def test_with_an_open_scale_any_value_is_as_good():
    """Nothing is held but one moment, for the search: it may have any value."""
    problem, wrong = posed(Params()), body_at(WRONG)
    assert is_pinned(problem, wrong)
    assert pinned(problem, wrong) is wrong


def test_zero_is_held_at_any_scale():
    """A product held at zero: it is put there while the moments keep their open scale."""
    testbed, wrong = platform(), body_at(WRONG)
    inertia = unpack_symmetric(INERTIA * [1, 1, 1, 0, 1, 1])
    testbed = replace(testbed, body=replace(testbed.body, inertia_P=inertia))
    problem = problem_of(noisy(recording(40.0), 0), testbed, Params(hold=("inertia_P_xy",)))
    assert problem.scale_open
    assert not is_pinned(problem, wrong)
    found = pinned(problem, wrong)
    assert is_pinned(problem, found)
    right = WRONG.copy()
    right[3] = 0.0
    np.testing.assert_allclose(values_at(found), right, rtol=1e-9, atol=1e-12)


@pytest.mark.parametrize("seed", range(3))
def test_a_search_settles_with_what_is_held(seed):
    """From a body so far off that the search meets the boundary of those that can exist."""
    problem = posed(HOLD, seed)
    found = settle_pinned(problem, replace(TRUTH, six=TRUTH.six + 0.1, com=COM + 2e-5))
    assert found.converged
    held = values_at(found.point)[HELD]
    np.testing.assert_allclose(held, [INERTIA[2], COM[0]], rtol=1e-9)
