"""Lee's error indices, by hand and against what repeated noise does."""

import numpy as np
import pytest

from equipoise.estimation.regression.error_indices import error_indices
from equipoise.model.errors import InputError

H = np.array([[1.0, 0.0], [0.0, 1.0], [1.0, 1.0]])
Y = np.array([1.0, 2.0, 6.0])


def test_three_rows_by_hand():
    """H^T H = [2 1; 1 2], H^T y = (7, 8): x = (2, 3), y - H x = (-1, -1, 1), SSE = 3.

    (H^T H)^-1_ii = 2/3, y^T y = 41; one row is to spare.
    """
    found = error_indices(H, Y)
    assert found.index == pytest.approx(np.sqrt(3 / 41))
    np.testing.assert_allclose(found.parameter, np.sqrt(2))
    np.testing.assert_allclose(found.relative, np.sqrt(2) / np.array([2, 3]))


def test_the_index_is_one_when_nothing_is_explained_and_zero_when_all_is():
    """(1, 1, -1) is orthogonal to both columns."""
    nothing = error_indices(H, np.array([1.0, 1.0, -1.0]))
    assert nothing.index == pytest.approx(1.0)
    everything = error_indices(H, H @ np.array([2.0, 3.0]))
    assert everything.index == pytest.approx(0.0, abs=1e-14)
    np.testing.assert_allclose(everything.relative, 0.0, atol=1e-14)


def test_the_printed_index_has_units_and_the_relative_error_has_none():
    """x in another unit: PEI changes with it, the relative error does not."""
    other = error_indices(H * [1e-3, 1.0], Y)
    np.testing.assert_allclose(other.parameter, error_indices(H, Y).parameter * [1e3, 1.0])
    np.testing.assert_allclose(other.relative, error_indices(H, Y).relative)


def test_the_printed_index_is_no_standard_error():
    """1000 records of 40 rows: the errors are as large as the relative errors, PEI is not."""
    rng = np.random.default_rng(1)
    A, x = rng.normal(size=(40, 2)), np.array([2.0, -3.0])
    found, errors = [], []
    for _ in range(1000):
        y = A @ x + 0.1 * rng.normal(size=40)
        found.append(error_indices(A, y))
        errors.append(np.linalg.lstsq(A, y)[0] - x)
    scatter = np.std(errors, axis=0)
    relative = np.mean([f.relative for f in found], axis=0) * np.abs(x)
    np.testing.assert_allclose(relative, scatter, rtol=0.09)  # 4 / sqrt(2000)
    assert np.all(np.mean([f.parameter for f in found], axis=0) > 5 * scatter)


def test_a_value_of_zero_has_no_relative_error():
    """One column that y is orthogonal to."""
    found = error_indices(np.eye(3)[:, :1], np.array([0.0, 1.0, 0.0]))
    assert np.isinf(found.relative[0])


@pytest.mark.parametrize(
    ("matrix", "right"),
    [(H[:2], Y[:2]), (np.ones((3, 2)), Y), (H, np.zeros(3))],
    ids=["as many rows as unknowns", "dependent columns", "nothing to explain"],
)
def test_what_has_no_answer_is_refused(matrix, right):
    with pytest.raises(InputError):
        error_indices(matrix, right)
