"""The single-sample rotations of kernels against the plain quaternions of ``attitude``."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from equipoise.maths.attitude import difference, exponential, multiply, to_matrix
from equipoise.maths.turns import to_body, to_laboratory, turn, turned

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


@given(vectors, vectors)
def test_to_laboratory_is_the_matrix(start, vector):
    """R v for any attitude."""
    q = exponential(start)
    expected = to_matrix(q) @ vector
    np.testing.assert_allclose(to_laboratory(q, tuple(vector)), expected, rtol=0, atol=1e-14)


@given(vectors, vectors)
def test_to_body_is_the_transposed_matrix(start, vector):
    """R^T v for any attitude."""
    q = exponential(start)
    expected = to_matrix(q).T @ vector
    np.testing.assert_allclose(to_body(q, tuple(vector)), expected, rtol=0, atol=1e-14)


def test_a_quarter_turn_by_hand():
    """Yaw of 90 deg: body x points along laboratory y, which is where -y of the body was."""
    q = exponential(np.array([0, 0, np.pi / 2]))
    np.testing.assert_allclose(to_laboratory(q, (1.0, 0.0, 0.0)), [0, 1, 0], atol=1e-15)
    np.testing.assert_allclose(to_body(q, (1.0, 0.0, 0.0)), [0, -1, 0], atol=1e-15)
