"""The single-sample rotations of kernels against the plain quaternions of ``attitude``."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from equipoise.maths.attitude import difference, exponential, multiply
from equipoise.maths.turns import turn, turned

vectors = arrays(np.float64, 3, elements=st.floats(-1.8, 1.8))
sizes = st.sampled_from([1.0, 1e-3, 1e-10, 0.0])


@given(vectors, vectors, sizes)
def test_turned_is_the_product_with_the_exponential(start, vector, size):
    """Any rotation up to half a turn and any small one, none included."""
    q, step = exponential(start), size * vector
    expected = multiply(q, exponential(step))
    np.testing.assert_allclose(turned(q, *step), expected, rtol=0, atol=1e-15)


@given(vectors, vectors, st.sampled_from([1.0, 1e-3, 1e-10]), st.sampled_from([1, -1]))
def test_turn_is_the_logarithm(start, vector, size, sign):
    """Either sign of a quaternion is the same attitude."""
    p = exponential(start)
    q = sign * multiply(p, exponential(size * vector))
    np.testing.assert_allclose(turn(p, q), difference(q, p), rtol=0, atol=1e-14)
