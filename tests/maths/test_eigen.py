"""Eigenvalues and vectors of symmetric matrices against LAPACK."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from equipoise.maths.eigen import eigen
from equipoise.maths.linalg import pack_symmetric, unpack_symmetric

sixes = arrays(np.float64, 6, elements=st.floats(-2.0, 2.0))


@given(sixes, st.sampled_from([1e-6, 1.0, 1e6]))
def test_any_matrix_is_reconstructed_from_its_eigendecomposition(six, size):
    """V diag(values) V^T is the matrix, V^T V the unit matrix, to rounding of its size."""
    values, vectors = eigen(tuple(size * six))
    V = np.array(vectors).T
    np.testing.assert_allclose(V.T @ V, np.eye(3), rtol=0, atol=1e-14)
    back = (V * np.array(values)) @ V.T
    np.testing.assert_allclose(back, unpack_symmetric(size * six), rtol=0, atol=2e-14 * size)


@given(sixes)
def test_values_are_those_of_lapack(six):
    """In another order."""
    values, _ = eigen(tuple(six))
    expected = np.linalg.eigvalsh(unpack_symmetric(six))
    np.testing.assert_allclose(sorted(values), expected, rtol=0, atol=2e-14)


def test_a_diagonal_matrix_is_left_alone():
    """No rotation: values and axes in the order given."""
    values, vectors = eigen((3.0, 1.0, 2.0, 0.0, 0.0, 0.0))
    assert values == (3.0, 1.0, 2.0)
    assert np.array(vectors).tolist() == np.eye(3).tolist()


def test_nearly_flat_bodies_keep_their_small_moment():
    """1e-9 of the largest, turned by odd angles: found to rounding of the largest."""
    turn, _ = np.linalg.qr(np.array([[1.0, 0.3, -0.2], [0.1, 1.0, 0.4], [0.5, -0.3, 1.0]]))
    values, _ = eigen(tuple(pack_symmetric((turn * [1.0, 0.4, 1e-9]) @ turn.T)))
    assert min(values) == pytest.approx(1e-9, abs=1e-15)
