"""Slopes of polynomials: by hand, on polynomials, and as SciPy has them."""

import numpy as np
import pytest
from scipy.signal import savgol_coeffs

from equipoise.maths.sampled.savitzky_golay import slope_weights


def test_a_line_through_three_rows_by_hand():
    """(x3 - x1) / 2T."""
    np.testing.assert_allclose(slope_weights(3, 1, 0.5), [-1.0, 0.0, 1.0], atol=1e-14)


def test_a_cubic_through_five_rows_by_hand():
    """The printed weights (1, -8, 0, 8, -1) / 12 T."""
    expected = np.array([1, -8, 0, 8, -1]) / 12
    np.testing.assert_allclose(slope_weights(5, 3, 1.0), expected, atol=1e-14)


@pytest.mark.parametrize("rows", [5, 6, 51])
def test_the_slope_of_a_cubic_is_exact_in_the_middle(rows):
    t = 0.01 * (np.arange(rows) - (rows - 1) / 2)
    slope = slope_weights(rows, 3, 0.01) @ (4.0 - 3.0 * t + 2.0 * t**2 + 5.0 * t**3)
    assert slope == pytest.approx(-3.0, rel=1e-11)


@pytest.mark.parametrize(("rows", "degree"), [(5, 3), (6, 3), (51, 3), (101, 1), (2001, 3)])
def test_weights_are_those_of_scipy(rows, degree):
    expected = savgol_coeffs(rows, degree, deriv=1, delta=0.01, use="dot")
    found = slope_weights(rows, degree, 0.01)
    np.testing.assert_allclose(found, expected, atol=1e-10 * np.abs(expected).max())
