"""Rows that stand out are left out, unless they are so many that the rest stands out."""

import numpy as np
import pytest

from equipoise.model.recording import Samples
from equipoise.procedure.steps.clean_record import kept

ROWS = 10


def channel():
    return Samples(np.arange(float(ROWS)), np.arange(3.0 * ROWS).reshape(ROWS, 3))


@pytest.mark.parametrize(("odd", "left"), [(0, 10), (1, 9), (2, 8), (3, 10), (10, 10)])
def test_a_fifth_of_the_rows_at_most_is_left_out(odd, left):
    found = kept(channel(), np.arange(ROWS) < odd)
    np.testing.assert_array_equal(found.t, np.arange(float(ROWS))[ROWS - left :])
    np.testing.assert_array_equal(found.values, channel().values[ROWS - left :])
