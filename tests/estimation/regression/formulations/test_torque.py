"""Rates differentiated, by hand."""

import numpy as np
import pytest

from equipoise.estimation.regression.formulations.torque import central


def test_a_central_difference_of_a_square_is_its_slope():
    """Of t^2 every half second: 2 t at each row but the first and the last."""
    t = 0.5 * np.arange(6)
    slope, first, _ = central((t**2)[:, None], 0.5)
    assert first == 1
    assert slope[:, 0] == pytest.approx(2 * t[1:-1])
