"""One share for all."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from equipoise.actuators.limiting import scaled

inputs = arrays(np.int64, 4, elements=st.integers(-10_000, 10_000)).map(lambda n: n / 997)
limits = arrays(np.int64, 4, elements=st.integers(0, 10_000)).map(lambda n: n / 997)


@given(inputs, limits)
def test_within_limits_along_the_same_direction_and_no_less_than_need_be(x, most):
    found = scaled(x, most)
    assert np.all(np.abs(found) <= most)
    np.testing.assert_allclose(np.outer(found, x), np.outer(x, found), atol=1e-12)
    assert found @ x >= 0
    at_limit = np.abs(np.abs(found) - most) <= 1e-12 * (1 + most)
    assert np.array_equal(found, x) or at_limit.any()


def test_inputs_within_limits_are_left_alone():
    x = np.array([1.0, -2.0])
    np.testing.assert_array_equal(scaled(x, np.array([1.0, 2.0])), x)
