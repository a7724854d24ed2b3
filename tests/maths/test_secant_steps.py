"""Secant steps, by hand."""

import numpy as np
import pytest

from equipoise.maths.secant_steps import BOLDEST, Evaluated, secant_step


def evaluated(of, x):
    x = np.array(x, dtype=float)
    return Evaluated(x, of(x))


def test_the_first_step_is_the_plain_one():
    now = evaluated(lambda x: 0.2 * (3.0 - x), [0.0, 1.0])
    assert np.array_equal(secant_step(now, None), now.d)


def test_of_straight_lines_the_second_step_ends_at_the_root():
    """Each quantity at its own: d = 0.2 (3 - x) and 0.5 (-1 - x)."""
    slope, root = np.array([0.2, 0.5]), np.array([3.0, -1.0])

    def of(x):
        return slope * (root - x)

    first = evaluated(of, [0.0, 0.0])
    second = evaluated(of, first.x + secant_step(first, None))
    assert second.x == pytest.approx([0.6, -0.5])
    assert second.x + secant_step(second, first) == pytest.approx(root)


def test_what_does_not_fall_or_stands_takes_the_plain_step():
    before = Evaluated(np.array([0.0, 2.0]), np.array([0.5, 0.4]))
    now = Evaluated(np.array([0.5, 2.0]), np.array([0.7, 0.4]))
    assert secant_step(now, before) == pytest.approx([0.7, 0.4])


def test_slopes_count_within_bounds():
    """A fall by 0.001 would ask for a step of 249, one by 4 for less than the plain step."""
    before = Evaluated(np.zeros(2), np.array([0.5, 1.0]))
    now = Evaluated(np.ones(2), np.array([0.499, -3.0]))
    assert secant_step(now, before) == pytest.approx([0.499 * BOLDEST, -3.0])
