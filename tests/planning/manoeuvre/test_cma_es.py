"""A search side by side: it finds what is known to be least, whichever valley it began in."""

from functools import partial

import numpy as np
import pytest

from equipoise.planning.manoeuvre.cma_es import SHARE, SIDE_BY_SIDE, least

GOAL = np.array([0.31, 0.62, 0.47, 0.85])


def bent(x):
    """A narrow valley across the axes, 100 times steeper across than along; 0 at the goal."""
    off = x - GOAL
    turned = np.array([off[0] + off[1], off[0] - off[1], off[2] + off[3], off[2] - off[3]])
    return float(turned @ (turned * [1.0, 100.0, 1.0, 100.0]))


def each_by(function):
    """What computes a function of several choices, one by one."""
    return partial(map, function)


def receive_nothing(_):
    pass


def test_the_least_of_a_narrow_valley_is_found():
    found = least(each_by(bent), [np.full(4, 0.5)], 2500, 1, receive_nothing)
    np.testing.assert_allclose(found, GOAL, atol=1e-4)


def test_a_worse_beginning_may_end_better():
    """Two wells: at 0.2 the floor is 1, at 0.8 it is 0; the better first choice is in the first."""

    def wells(x):
        left, right = np.sum((x - 0.2) ** 2), np.sum((x - 0.8) ** 2)
        return float(min(1.0 + left, 40.0 * right))

    first = [np.full(3, 0.2), np.full(3, 0.7)]
    assert wells(first[0]) < wells(first[1]) < 1.3
    np.testing.assert_allclose(
        least(each_by(wells), first, 1500, 1, receive_nothing), 0.8, atol=1e-3
    )


def test_trials_stay_within_bounds_and_number():
    """First choices, then generations of 4 + floor(3 ln 4) = 8 until the number is reached."""
    met, received = [], []

    def slope(x):
        met.append(x.copy())
        return float(x.sum())

    least(each_by(slope), [np.full(4, 0.5), np.full(4, 0.3)], 101, 1, received.append)
    assert len(met) == 2 + 8 * 13
    assert np.min(met) >= 0.0
    assert np.max(met) <= 1.0
    assert received == sorted(received)
    assert received[-1] == 1.0


def test_the_best_few_have_their_share_and_the_best_goes_on():
    """Flat wells of four depths: the first trials are shared, the rest all go to the deepest."""
    centres = np.linspace(0.1, 0.9, SIDE_BY_SIDE + 1)
    near = []

    def wells(x):
        near.append(int(np.argmin(np.abs(x.mean() - centres))))
        return float(np.abs(x - centres[near[-1]]).sum() + near[-1])

    first = [np.full(2, c) for c in centres]
    trials = 600
    least(each_by(wells), first, trials, 1, receive_nothing)
    begun = near[len(first) : len(first) + int(SIDE_BY_SIDE * SHARE * trials)]
    assert {0, 1, 2, 3} <= set(begun)
    assert set(near[-100:]) == {0}


def test_the_same_seed_finds_the_same():
    once, again, other = (
        least(each_by(bent), [np.full(4, 0.5)], 300, seed, receive_nothing) for seed in (1, 1, 2)
    )
    np.testing.assert_array_equal(once, again)
    assert np.any(once != other)


def test_a_first_choice_that_nothing_betters_is_kept():
    """The least is where the search begins: nothing else is returned."""
    start = np.array([0.4, 0.6])
    found = least(each_by(lambda x: float(np.any(x != start))), [start], 60, 1, receive_nothing)
    np.testing.assert_array_equal(found, start)


@pytest.mark.parametrize("trials", [1, 0])
def test_with_no_trials_left_the_best_first_choice_is_it(trials):
    first = [np.full(4, 0.1), GOAL]
    np.testing.assert_array_equal(least(each_by(bent), first, trials, 1, receive_nothing), GOAL)
