"""Series of straight lines."""

import numpy as np

from equipoise.maths.straight_lines import bends, read_at

T = np.array([0.0, 1.0, 3.0, 4.0, 6.0])


def test_a_bend_is_where_any_column_changes_its_slope():
    """One column bends at 3 s, the other at 4 s; unequal steps alone are no bend."""
    values = np.column_stack([[0, 1, 3, 3, 3], [2, 2, 2, 2, 4.0]])
    assert bends(T, values).tolist() == [False, True, True]


def test_what_stands_or_goes_straight_bends_nowhere():
    """Not even by rounding: a slope of 0.1 in steps that no float holds exactly."""
    assert not bends(T, np.column_stack([0.1 * T, np.full(5, 7.0)])).any()


def test_lines_are_the_same_when_read_between_their_bends_alone():
    """Rows on a line between two others say nothing more."""
    values = np.column_stack([[0, 1, 3, 3, 3], [2, 2, 2, 2, 4.0]])
    kept, at = np.concatenate([[True], bends(T, values), [True]]), np.linspace(0, 6, 61)
    np.testing.assert_allclose(
        read_at(at, T[kept], values[kept]), read_at(at, T, values), rtol=0, atol=1e-15
    )
