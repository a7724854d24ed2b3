"""Six numbers give every possible inertia and no other."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from equipoise.maths.linalg import pack_symmetric
from equipoise.maths.pseudo_inertia import (
    FLOOR,
    exceeds,
    from_inertia,
    inertia_of,
    slope_of_inertia,
    to_inertia,
)
from equipoise.model.mass_properties import (
    inertia_from_second_moments,
    second_moments,
    smallest_second_moment,
)


def nearest_possible(inertia):
    """There and back: what the six numbers keep of an inertia."""
    return to_inertia(from_inertia(inertia))


sixes = arrays(np.float64, 6, elements=st.floats(-3.0, 3.0))


@st.composite
def possible(draw):
    """Inertias of boxes with sides of 0.05 to 2 m in any orientation."""
    sides = draw(arrays(np.float64, 3, elements=st.floats(0.05, 2.0)))
    turn, _ = np.linalg.qr(draw(arrays(np.float64, (3, 3), elements=st.floats(-1, 1))) + np.eye(3))
    sigma = turn @ np.diag(sides**2) @ turn.T
    return inertia_from_second_moments(0.5 * (sigma + sigma.T))


@given(possible())
def test_inertia_there_and_back(inertia):
    """A possible inertia comes back to rounding of its size."""
    back = to_inertia(from_inertia(inertia))
    np.testing.assert_allclose(back, inertia, rtol=0, atol=1e-13 * np.trace(inertia))


@given(sixes)
def test_every_six_numbers_are_a_body(six):
    """J is symmetric, its second moments are positive, hence so are its moments.

    Positive means the determinant of the factor, e^(a1 + a2 + a3) > 0; rounding may hide moments
    less than 1e-15 of the largest, so it is asked of the numbers' own determinant.
    """
    inertia = to_inertia(six)
    assert (inertia == inertia.T).all()
    assert smallest_second_moment(inertia) > -1e-14 * np.trace(inertia)
    sign, log_det = np.linalg.slogdet(np.linalg.cholesky(second_moments(inertia)))
    assert sign == 1
    assert log_det == pytest.approx(six[:3].sum(), abs=1e-3)


def test_sphere_by_hand():
    """Sigma = E: a_i = 0, b = 0, J = 2 E."""
    assert to_inertia(np.zeros(6)).tolist() == (2 * np.eye(3)).tolist()
    np.testing.assert_allclose(from_inertia(2 * np.eye(3)), 0.0, atol=1e-16)


@pytest.mark.parametrize(
    "impossible",
    [
        np.diag([1.0, 1.0, 3.0]),  # triangle inequality
        np.diag([-0.2, 1.0, 1.0]),
        np.array([[1.0, 0.9, 0.0], [0.9, 1.0, 0.2], [0.0, 0.2, 1.0]]),
    ],
)
def test_impossible_is_moved_to_the_floor_and_no_further(impossible):
    """Second moments below the floor are raised to it; directions and the others stay."""
    values, vectors = np.linalg.eigh(second_moments(impossible))
    moved = second_moments(nearest_possible(impossible))
    expected = np.maximum(values, FLOOR * np.trace(impossible))
    assert values[0] < 0 < smallest_second_moment(nearest_possible(impossible))
    np.testing.assert_allclose(vectors.T @ moved @ vectors, np.diag(expected), atol=1e-13)


@given(possible())
def test_possible_stays(inertia):
    """Nothing is done to what needs nothing."""
    found = nearest_possible(inertia)
    np.testing.assert_allclose(found, inertia, rtol=0, atol=1e-13 * np.trace(inertia))


def test_nothing_at_all_still_gives_a_body():
    """A zero or negative trace has no size to take a fraction of; the result is finite."""
    assert smallest_second_moment(nearest_possible(np.zeros((3, 3)))) > 0
    assert smallest_second_moment(nearest_possible(-np.eye(3))) > 0


@given(arrays(np.float64, (3, 3), elements=st.floats(-2, 2)), st.floats(-1.0, 1.0))
def test_exceeds_is_the_least_eigenvalue_above_the_floor(matrix, floor):
    """Leading minors against eigenvalues, away from the edge where rounding decides."""
    symmetric = matrix + matrix.T
    least = np.linalg.eigvalsh(symmetric)[0]
    if abs(least - floor) > 1e-9:
        assert exceeds(tuple(pack_symmetric(symmetric)), floor) == (least > floor)


# --- Plain twins ------------------------------------------------------------------------------


def factor_of(six):
    """L of the six numbers."""
    a1, a2, a3, b12, b13, b23 = six
    return np.array([[np.exp(a1), 0, 0], [b12, np.exp(a2), 0], [b13, b23, np.exp(a3)]])


@given(sixes)
def test_inertia_agrees_with_a_plain_twin(six):
    """L L^T by matrices."""
    factor = factor_of(six)
    expected = inertia_from_second_moments(factor @ factor.T)
    found = to_inertia(six)
    np.testing.assert_allclose(found, expected, rtol=0, atol=1e-14 * np.trace(expected))


@given(possible())
def test_six_numbers_agree_with_a_plain_twin(inertia):
    """The factor by LAPACK; a condition of 1600 leaves 1e-12."""
    factor = np.linalg.cholesky(second_moments(inertia))
    expected = [*np.log(np.diag(factor)), factor[1, 0], factor[2, 0], factor[2, 1]]
    np.testing.assert_allclose(from_inertia(inertia), expected, rtol=0, atol=1e-9)


@given(sixes)
def test_the_slope_is_the_complex_steps(six):
    """Each column by a step of 1e-30 i in the plain twin: exact to rounding."""
    steps = six + 1e-30j * np.eye(6)
    columns = [np.imag(inertia_of.py_func(tuple(step))) / 1e-30 for step in steps]
    size = np.abs(columns).max()
    np.testing.assert_allclose(slope_of_inertia(six), np.transpose(columns), atol=1e-14 * size)
