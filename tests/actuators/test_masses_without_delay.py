"""Masses in a feedback loop: fine ones stay near where they are, coarse ones do the rest."""

import numpy as np
import pytest

from equipoise.actuators.mass_allocation import allocate, rails_of, without_delay
from tests.support.simple_loop import MASS, masses

RAILS = rails_of(masses(), MASS)
COARSE, FINE = 0.2 * 1e-4 / MASS, 0.02 * 1e-5 / MASS  # m, what a step does
HOME = np.zeros(6)
TEN_UM = np.array([1e-5, 0.0, 0.0])


def reached(displacement):
    return displacement @ np.array([m.mass * m.axis for m in masses()]) / MASS


def test_a_large_change_is_the_coarse_masses():
    """10 um: seven coarse steps or six; the fine mass goes a coarse step's worth, 1 mm, at most."""
    there = without_delay(RAILS, HOME, HOME, TEN_UM)
    assert abs(there[3]) <= COARSE / FINE * 1e-5 + 1e-9
    np.testing.assert_allclose(reached(there), TEN_UM, atol=FINE / 2)
    assert abs(allocate(RAILS, HOME, TEN_UM)[3]) == pytest.approx(7e-3, rel=0.01)


def test_a_small_change_leaves_the_coarse_masses_alone():
    there = without_delay(RAILS, HOME, HOME, TEN_UM / 20)
    np.testing.assert_array_equal(there[:3], 0.0)
    np.testing.assert_allclose(reached(there), TEN_UM / 20, atol=FINE / 2)


def test_what_is_near_depends_on_where_the_masses_are():
    """A fine mass at 15 mm stays there, and the coarse one makes up for it."""
    here = np.array([0.0, 0.0, 0.0, 15e-3, 0.0, 0.0])
    there = without_delay(RAILS, here, here, np.zeros(3))
    assert abs(there[3] - 15e-3) <= 1.01e-3
    np.testing.assert_allclose(reached(there), 0.0, atol=FINE / 2)


def test_fine_masses_complete_the_shift_when_coarse_rails_are_at_their_end():
    farthest = np.array([0.2 * 0.07 + 0.02 * 0.02, 0.0, 0.0]) / MASS
    there = without_delay(RAILS, HOME, HOME, farthest)
    np.testing.assert_allclose(reached(there), farthest, atol=FINE)
