"""Small linear algebra: cross products as matrices, symmetric matrices as six numbers."""

from collections.abc import Sequence

import numpy as np
import scipy

from equipoise.model.arrays import Bools, Floats, Matrix3, Series, Series1, Square, Vector3, Vector6

PAIRS = ((0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2))  # xx yy zz xy xz yz


def skew(a: Vector3) -> Matrix3:
    """Return [a x], so that ``skew(a) @ b = a x b``."""
    return np.array([[0.0, -a[2], a[1]], [a[2], 0.0, -a[0]], [-a[1], a[0], 0.0]])


def cross(a: Vector3, b: Vector3) -> Vector3:
    """Return a x b of one pair of vectors, for which ``np.cross`` takes much longer."""
    return np.array(
        [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
    )


def pack_symmetric(matrix: Matrix3) -> Vector6:
    """Return xx yy zz xy xz yz."""
    return np.array([matrix[i, j] for i, j in PAIRS])


def unpack_symmetric(six: Vector6) -> Matrix3:
    """Return the symmetric matrix of xx yy zz xy xz yz."""
    xx, yy, zz, xy, xz, yz = six
    return np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])


def element_sizes(matrix: Matrix3) -> Vector6:
    """Return sqrt(M_ii M_jj), a size for each element xx yy zz xy xz yz of a positive M."""
    diagonal = np.diag(matrix)
    return np.sqrt(pack_symmetric(np.outer(diagonal, diagonal)))


def symmetrise(matrix: Square) -> Square:
    """Return the symmetric part."""
    return 0.5 * (matrix + matrix.T)


def eigen_symmetric(matrix: Square) -> tuple[Floats, Square]:
    """Return the eigenvalues of a symmetric matrix, ascending, and its eigenvectors as columns.

    By QR steps: from 26 rows on LAPACK's divide and conquer, which ``np.linalg.eigh`` takes, wakes
    every core for a few hundred multiplications, and waits a hundred times as long for a busy one.
    """
    values, vectors = scipy.linalg.eigh(matrix, driver="ev", check_finite=False)
    return values, vectors


def inverse_spd(matrix: Square) -> Square:
    """Return the inverse of a positive definite matrix, scaled to unit diagonal first.

    LinAlgError when an element of the diagonal is not positive, or no number.
    """
    diagonal = np.diag(matrix)
    if not np.all(diagonal > 0):
        raise np.linalg.LinAlgError("the matrix is not positive definite")
    scale = 1.0 / np.sqrt(diagonal)
    unit = matrix * np.outer(scale, scale)
    inverse: Square = np.linalg.inv(unit).astype(np.float64, copy=False)
    return symmetrise(inverse) * np.outer(scale, scale)


def unit_eigenvalues(matrix: Square) -> Series1:
    """Return the eigenvalues of a symmetric matrix scaled to unit diagonal, ascending.

    All zero when an element of the diagonal is not positive, or no number.
    """
    diagonal = np.diag(matrix)
    if not np.all(diagonal > 0):
        return np.zeros(len(matrix))
    unit = matrix / np.sqrt(np.outer(diagonal, diagonal))
    return np.linalg.eigvalsh(unit).astype(np.float64, copy=False)


def inverse_where(matrix: Square, free: Bools) -> Square:
    """Return the inverse of the block of rows and columns that are free, and zero elsewhere."""
    inverse = np.zeros_like(matrix)
    inverse[np.ix_(free, free)] = inverse_spd(matrix[np.ix_(free, free)])
    return inverse


def inverse_of_each(matrices: Floats, free: Bools) -> Floats:
    """Return ``inverse_where`` of each matrix (k, n, n); nan of one that is not positive."""
    found = np.zeros_like(matrices)
    for matrix, inverse in zip(matrices, found, strict=True):
        try:
            inverse[:] = inverse_where(matrix, free)
        except np.linalg.LinAlgError:
            inverse[np.ix_(free, free)] = np.nan
    return found


def inverse_blocks(matrices: Floats, own: Sequence[int]) -> Floats:
    """Return one block of the inverse of each positive definite matrix, (k, n, n) to (k, m, m).

    Of Cholesky's factor L with the own rows last, the last block F is that of L L^T with the others
    eliminated: (F F^T)^-1 is the block. LinAlgError for a matrix that is not positive definite.
    """
    others = [k for k in range(matrices.shape[-1]) if k not in own]
    order, first = [*others, *own], len(others)
    scale = 1.0 / np.sqrt(np.diagonal(matrices, axis1=1, axis2=2)[:, order])
    unit = matrices[:, order][:, :, order] * scale[:, :, None] * scale[:, None, :]
    factors = np.linalg.inv(np.linalg.cholesky(unit)[:, first:, first:])
    size = scale[:, first:]
    return factors.transpose(0, 2, 1) @ factors * size[:, :, None] * size[:, None, :]


def lag_one(residual: Series) -> float:
    """Return the correlation of neighbouring rows, pooled over columns; 0 for fewer than 3 rows."""
    if len(residual) < 3:
        return 0.0
    centred: Floats = residual - residual.mean(axis=0)
    power = float(np.sum(centred**2))
    return float(np.sum(centred[1:] * centred[:-1])) / power if power > 0 else 0.0


def given(covariance: Square, own: Sequence[int], known: Sequence[int]) -> Square:
    """Return the covariance of some normal numbers when others are known exactly.

    P_aa - P_ab P_bb^-1 P_ba; numbers without any doubt are known already.
    """
    return schur_complement(covariance, own, [k for k in known if covariance[k, k] > 0])


def schur_complement(matrix: Square, own: Sequence[int], others: Sequence[int]) -> Square:
    """Return M_aa - M_ab M_bb^-1 M_ba: a covariance given others, or information with others free.

    The others' block has to be positive definite.
    """
    cross = matrix[np.ix_(own, others)]
    return matrix[np.ix_(own, own)] - cross @ inverse_spd(matrix[np.ix_(others, others)]) @ cross.T
