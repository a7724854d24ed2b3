"""What masses can reach and how fast, by hand."""

from dataclasses import replace

import numpy as np
import pytest

from equipoise.control.plant.actuator_limits import (
    filling_time,
    greatest_shift,
    greatest_slew,
    limited,
)
from tests.support.simple_loop import masses, table


def test_a_limited_vector_keeps_its_direction():
    np.testing.assert_allclose(limited(np.array([3.0, 4.0]), 1.0), [0.6, 0.8])
    np.testing.assert_array_equal(limited(np.array([0.3, 0.4]), 1.0), [0.3, 0.4])


def test_reach_by_hand():
    """200 g over 70 mm and 20 g over 20 mm along each axis of 14 kg: 14.4 g m / 14 kg."""
    assert greatest_shift(table()) == pytest.approx((0.2 * 0.07 + 0.02 * 0.02) / 14)


def test_the_faster_of_parallel_masses_counts():
    """200 g at 1 mm/s, and not the 20 g beside it."""
    assert greatest_slew(table()) == pytest.approx(0.2e-3 / 14)


def test_slanting_rails_reach_a_smaller_shift_between_them():
    """x, y and a rail at 60 degrees to x in their plane's upright: the face is that of y and it."""
    three = masses()[:3]
    slanting = replace(three[2], axis=np.array([0.5, 0.0, np.sqrt(0.75)]))
    testbed = replace(table(), masses=(three[0], three[1], slanting))
    one = 0.2 * 0.07 / 14
    assert greatest_shift(testbed) == pytest.approx(one * np.sqrt(0.75))


@pytest.mark.parametrize("keep", [slice(0, 0), slice(0, 1), slice(0, 2)])
def test_rails_that_leave_a_direction_out_reach_nothing(keep):
    assert greatest_shift(replace(table(), masses=masses()[keep])) == 0.0


def test_filling_time_by_hand():
    """Half of 200 g x 0.1 mm by 20 g at 1 mm/s: 0.5 s; without fine masses there is none."""
    assert filling_time(table()) == pytest.approx(0.5)
    assert filling_time(replace(table(), masses=masses()[:3])) == 0.0
