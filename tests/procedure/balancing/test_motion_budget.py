"""Masses travel no faster than their budget allows, by hand on one mass and on all of a preset."""

from dataclasses import replace

import numpy as np
import pytest

from equipoise.io.testbed.presets import read_preset
from equipoise.procedure.balancing.motion_budget import (
    NO_LIMIT,
    MotionBudget,
    longest_first,
    reached,
    slowed,
    speed_for,
)

BED = read_preset("nanosat")
X = np.array([1.0, 0.0, 0.0])


def test_one_mass_by_hand():
    """60 g on a rail along x, home (0, 70, -40) mm: h = 60 g x 80.6 mm v, gravity's rate 0.588 v.

    2 h^2 / 0.01 s + (0.588 v)^2 / 3 = (2 uN m)^2 at v = 5.79 um/s; 1 uN m/s at 1.70 um/s.
    """
    h, rate = 0.06 * np.hypot(0.07, 0.04), 0.06 * 9.80665
    by_torque = 2e-6 / np.sqrt(2 * h**2 / 0.01 + rate**2 / 3)
    assert by_torque == pytest.approx(5.79e-6, rel=0.01)
    assert speed_for(BED, X, MotionBudget(2e-6)) == pytest.approx(by_torque)
    assert speed_for(BED, -1e-3 * X, MotionBudget(2e-6)) == pytest.approx(by_torque)
    assert speed_for(BED, X, MotionBudget(2e-6, 1e-6)) == pytest.approx(1e-6 / rate)
    assert speed_for(BED, X, MotionBudget(2e-6, 1.0)) == pytest.approx(by_torque)


def test_masses_that_compensate_each_other_are_no_burden():
    """Two alike on one rail, in opposite directions: nothing is moved, and no momentum taken up."""
    x = BED.masses[0]
    twins = replace(BED, masses=(x, replace(x, name="x2")))
    assert speed_for(twins, np.array([1.0, -1.0]), MotionBudget(1e-9)) == np.inf
    alone, both = (speed_for(twins, np.array(way), MotionBudget(1e-6)) for way in ([1, 0], [1, 1]))
    assert alone == pytest.approx(2 * both)


def test_who_stands_still_or_has_no_limit_goes_at_any_speed():
    assert speed_for(BED, np.zeros(3), MotionBudget(1e-9)) == np.inf
    assert speed_for(BED, X, NO_LIMIT) == np.inf
    assert [m.speed for m in slowed(BED, NO_LIMIT).masses] == [m.speed for m in BED.masses]


def test_the_slowest_of_all_ways_is_what_a_slowed_testbed_has():
    ways = np.array(np.meshgrid(*[[-1.0, 0.0, 1.0]] * 3)).reshape(3, -1).T
    budget = MotionBudget(2e-6)
    least = min(speed_for(BED, way, budget) for way in ways)
    assert {mass.speed for mass in slowed(BED, budget).masses} == {least}


def test_on_the_way_each_mass_goes_until_it_arrives():
    """5 s at 2 um/s: 10 um of 100, and the mass that needs less is there."""
    slow = slowed(BED, MotionBudget(np.inf))
    slow = replace(slow, masses=tuple(replace(m, speed=2e-6) for m in slow.masses))
    there = reached(slow, np.zeros(3), np.array([1e-4, -4e-6, 0.0]), 5.0)
    np.testing.assert_allclose(there, [1e-5, -4e-6, 0.0])


def test_masses_of_little_way_wait_where_the_others_may_then_go_faster():
    """x and y at once go at 4.14 um/s, y alone at 5.77: with 20 of 50 um to go, x waits.

    A reported place is off a whole step by rounding alone; that is no way to go.
    """
    now, budget = np.array([1430e-6, -280e-6, 5400e-6]) * (1 + 1e-15), MotionBudget(2e-6)
    goal = np.array([1410e-6, -330e-6, 5400e-6])
    fewer = longest_first(BED, now, goal, budget)
    assert fewer == pytest.approx([1430e-6, -330e-6, 5400e-6], abs=1e-12)
    assert speed_for(BED, goal - now, budget) == pytest.approx(4.14e-6, rel=0.01)
    assert speed_for(BED, fewer - now, budget) == pytest.approx(5.77e-6, rel=0.01)


def test_masses_of_much_way_do_not_wait_nor_do_any_without_a_budget():
    now = np.array([1430e-6, -280e-6, 5400e-6])
    goal = np.array([1400e-6, -330e-6, 5400e-6])
    assert np.array_equal(longest_first(BED, now, goal, MotionBudget(2e-6)), goal)
    short = np.array([1420e-6, -330e-6, 5400e-6])
    assert np.array_equal(longest_first(BED, now, short, NO_LIMIT), short)
