"""The sequence of Sobol: evenness by its definition, and SciPy's own points."""

import numpy as np
import pytest
from scipy.stats.qmc import Sobol

from equipoise.maths.sobol_points import MOST, sobol_points


@pytest.mark.parametrize("dimensions", range(1, MOST + 1))
def test_it_is_scipys(dimensions):
    expected = Sobol(dimensions, scramble=False).fast_forward(5).random(300)
    assert np.array_equal(sobol_points(5, 300, dimensions), expected)


def test_every_slice_of_every_axis_has_one_point():
    slices = np.floor(sobol_points(0, 256, MOST) * 256)
    assert np.array_equal(np.sort(slices, axis=0), np.tile(np.arange(256.0)[:, None], MOST))


def test_every_rectangle_of_two_axes_has_one_point():
    """Of the first two, 2^a by 2^b: what makes a sequence better than a grid (Niederreiter)."""
    points = sobol_points(0, 64, 2)
    for a in range(7):
        cells = np.floor(points * [2**a, 2 ** (6 - a)]).astype(int)
        assert len({*map(tuple, cells.tolist())}) == 64
