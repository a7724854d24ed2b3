"""Cross products, six numbers of a symmetric matrix, inverses and whiteness."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from equipoise.maths.linalg import (
    eigen_symmetric,
    element_sizes,
    inverse_blocks,
    inverse_of_each,
    inverse_spd,
    inverse_where,
    lag_one,
    pack_symmetric,
    schur_complement,
    skew,
    unit_eigenvalues,
    unpack_symmetric,
)

vectors = arrays(np.float64, 3, elements=st.floats(-10.0, 10.0))
sixes = arrays(np.float64, 6, elements=st.floats(-10.0, 10.0))


@given(vectors, vectors)
def test_skew_is_the_cross_product(a, b):
    """[a x] b = a x b, and [a x] is antisymmetric."""
    np.testing.assert_allclose(skew(a) @ b, np.cross(a, b), atol=1e-13)
    assert (skew(a) + skew(a).T == 0).all()


def test_order_of_the_six_numbers_by_hand():
    """xx yy zz xy xz yz."""
    expected = [[1.0, 4.0, 5.0], [4.0, 2.0, 6.0], [5.0, 6.0, 3.0]]
    assert unpack_symmetric(np.arange(1.0, 7.0)).tolist() == expected


@given(sixes)
def test_six_numbers_there_and_back(six):
    """Nothing is lost: the way back gives the same bits, and the matrix is symmetric."""
    matrix = unpack_symmetric(six)
    assert pack_symmetric(matrix).tolist() == six.tolist()
    assert (matrix == matrix.T).all()


@pytest.mark.parametrize("rows", [3, 25, 40])
def test_eigenvalues_and_vectors_reconstruct_a_symmetric_matrix(rows):
    """V diag(values) V^T is the matrix 1 / (1 + i + j), V^T V the unit matrix; values ascend."""
    k = np.arange(rows)
    matrix = 1.0 / (1.0 + k[:, None] + k)
    values, V = eigen_symmetric(matrix)
    np.testing.assert_allclose((V * values) @ V.T, matrix, atol=1e-14)
    np.testing.assert_allclose(V.T @ V, np.eye(rows), atol=1e-13)
    assert (np.diff(values) >= 0).all()


@pytest.mark.parametrize("powers", [(0, 0, 0, 0), (-8, 0, 6, 3), (10, -10, 0, 5)])
def test_inverse_does_not_mind_units(powers):
    """Rounding stays that of the unit-diagonal matrix (condition below 30) in any units."""
    unit = 0.3 * np.ones((4, 4)) + 0.7 * np.eye(4)
    scale = 10.0 ** np.array(powers)
    matrix = unit * np.outer(scale, scale)
    found = inverse_spd(matrix) * np.outer(scale, scale)
    np.testing.assert_allclose(found @ unit, np.eye(4), atol=1e-14)
    assert (found == found.T).all()


@pytest.mark.parametrize("rho", [-0.5, 0.0, 0.8])
def test_lag_one_of_an_autoregression(rho):
    """x_k = rho x_{k-1} + noise has lag-one correlation rho; 4 sd of 60 000 rows are 0.016."""
    rng = np.random.default_rng(7)
    x = np.zeros((20_000, 3))
    noise = rng.normal(size=x.shape)
    for k in range(1, len(x)):
        x[k] = rho * x[k - 1] + noise[k]
    assert lag_one(x + [1.0, -2.0, 0.0]) == pytest.approx(rho, abs=0.017)


def test_lag_one_by_hand():
    """-1 1 -1 1: three neighbours of product -1 over a power of 4."""
    assert lag_one(np.array([[-1.0], [1.0], [-1.0], [1.0]])) == -0.75


@pytest.mark.parametrize("rows", [0, 1, 2])
def test_lag_one_of_too_few_rows_is_nothing(rows):
    """Two rows always have correlation -1/2: that says nothing."""
    with np.errstate(invalid="raise"):
        assert lag_one(np.arange(3.0 * rows).reshape(rows, 3)) == 0.0


def test_lag_one_of_a_constant_is_nothing():
    """No power, no correlation, and no division by zero."""
    assert lag_one(np.ones((5, 3))) == 0.0


def test_element_sizes_by_hand():
    """sqrt(4 x 9) = 6, sqrt(4 x 16) = 8, sqrt(9 x 16) = 12; products do not count."""
    found = element_sizes(np.array([[4.0, 1, 2], [1, 9, 3], [2, 3, 16]]))
    np.testing.assert_allclose(found, [4, 9, 16, 6, 8, 12])


BY_HAND = np.array([[4.0, 2.0, 1.0], [2.0, 5.0, 0.0], [1.0, 0.0, 2.0]])


def test_schur_complement_by_hand():
    """4 - 2 * 2 / 5 with the second known; - 1 * 1 / 2 with the third known too."""
    assert schur_complement(BY_HAND, [0], []).item() == 4.0
    assert schur_complement(BY_HAND, [0], [1]).item() == pytest.approx(3.2)
    assert schur_complement(BY_HAND, [0], [1, 2]).item() == pytest.approx(2.7)


def test_schur_complement_of_information_is_that_of_the_covariance_left():
    """(A / A_bb)^-1 is the block of A^-1: others that are free, and others that are ignored."""
    left = np.linalg.inv(schur_complement(BY_HAND, [0, 2], [1]))
    np.testing.assert_allclose(left, np.linalg.inv(BY_HAND)[np.ix_([0, 2], [0, 2])], rtol=1e-13)


def test_what_is_held_has_no_covariance():
    """[[4, 1], [1, 2]] is left, of determinant 7."""
    found = inverse_where(BY_HAND, np.array([True, False, True]))
    expected = np.array([[2.0, 0.0, -1.0], [0.0, 0.0, 0.0], [-1.0, 0.0, 4.0]]) / 7.0
    np.testing.assert_allclose(found, expected, atol=1e-15)


def test_eigenvalues_at_unit_diagonal_by_hand():
    """Correlation 1 / 2: 1 -+ 1 / 2."""
    np.testing.assert_allclose(unit_eigenvalues(np.array([[4.0, 1.0], [1.0, 1.0]])), [0.5, 1.5])


@pytest.mark.parametrize(
    ("matrix", "positive"),
    [
        ([[4.0, 1.0], [1.0, 1.0]], True),  # det 3
        ([[4.0, 3.0], [3.0, 1.0]], False),  # det -5
        ([[1e20, 0.5e10], [0.5e10, 1.0]], True),  # rows of other units: correlation 1/2
        ([[0.0, 0.0], [0.0, 1.0]], False),
        ([[np.nan, 0.0], [0.0, 1.0]], False),
    ],
)
def test_a_matrix_is_positive_where_each_eigenvalue_at_unit_diagonal_is(matrix, positive):
    assert bool(unit_eigenvalues(np.array(matrix))[0] > 0) is positive


def test_inverses_of_many_are_those_of_each():
    """One that is not positive has none; it does not stop the others."""
    free = np.array([True, False, True])
    found = inverse_of_each(np.array([BY_HAND, -BY_HAND, 2 * BY_HAND]), free)
    np.testing.assert_allclose(found[0], inverse_where(BY_HAND, free), atol=1e-15)
    np.testing.assert_allclose(found[2], inverse_where(2 * BY_HAND, free), atol=1e-15)
    assert np.isnan(found[1][np.ix_(free, free)]).all()


def test_blocks_of_inverses_are_those_of_each_inverse():
    """In the order that is asked for, whatever the sizes of rows."""
    rng = np.random.default_rng(4)
    rows = rng.standard_normal((3, 7, 5)) * [1.0, 1e4, 1e-3, 1.0, 30.0]
    matrices = rows.transpose(0, 2, 1) @ rows
    found = inverse_blocks(matrices, [3, 1])
    for block, matrix in zip(found, matrices, strict=True):
        np.testing.assert_allclose(block, inverse_spd(matrix)[np.ix_([3, 1], [3, 1])], rtol=1e-9)


def test_the_block_of_an_inverse_by_hand():
    """[[2, 1], [1, 1]] has the inverse [[1, -1], [-1, 2]]; all of it is a block, too."""
    matrix = np.array([[[2.0, 1.0], [1.0, 1.0]]])
    np.testing.assert_allclose(inverse_blocks(matrix, [1]), [[[2.0]]])
    np.testing.assert_allclose(inverse_blocks(matrix, [0, 1]), [[[1.0, -1.0], [-1.0, 2.0]]])


def test_no_block_of_what_is_not_positive_definite():
    with pytest.raises(np.linalg.LinAlgError):
        inverse_blocks(np.array([[[1.0, 2.0], [2.0, 1.0]]]), [0])
