import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from equipoise.model.mass_properties import (
    MassProperties,
    from_centre,
    inertia_from_second_moments,
    is_possible,
    parallel_axis,
    second_moments,
    smallest_second_moment,
)

NEAR = 1e-9  # kg m^2 and m: bodies below are of kilograms and metres, rounding is 1e-15 of them

lengths = st.floats(-2.0, 2.0)
places = arrays(np.float64, 3, elements=lengths)
masses = st.floats(0.01, 50.0)


@st.composite
def bodies(draw):
    """A box about its own centre, turned and put somewhere: possible by construction."""
    mass = draw(masses)
    sides = draw(arrays(np.float64, 3, elements=st.floats(0.05, 1.0)))
    turn, _ = np.linalg.qr(draw(arrays(np.float64, (3, 3), elements=lengths)) + 3 * np.eye(3))
    sigma = turn @ np.diag(mass * sides**2 / 12) @ turn.T
    return from_centre(mass, draw(places), inertia_from_second_moments(0.5 * (sigma + sigma.T)))


def cube() -> MassProperties:
    """6 kg, sides of 1 m, about its centre: m a^2 / 6 = 1 kg m^2 about every axis."""
    return MassProperties(6.0, np.zeros(3), np.eye(3))


def test_point_mass_by_hand():
    """2 kg at (1, 2, 3) m: |r|^2 = 14, so xx = 2 (14 - 1), xy = -2 x 1 x 2, and so on."""
    by_hand = [[26.0, -4.0, -6.0], [-4.0, 20.0, -12.0], [-6.0, -12.0, 10.0]]
    assert parallel_axis(2.0, np.array([1.0, 2.0, 3.0])).tolist() == by_hand


def test_cube_about_its_corner_by_hand():
    """Textbook: 2/3 m a^2 on the diagonal, -1/4 m a^2 off it."""
    corner = from_centre(6.0, np.full(3, -0.5), np.eye(3))
    np.testing.assert_allclose(corner.inertia_P, 5.5 * np.eye(3) - 1.5, atol=1e-15)
    np.testing.assert_allclose(corner.inertia_C, np.eye(3), atol=1e-15)


def test_first_moment_by_hand():
    """14.24 kg, 100 um low: -1.424e-3 kg m."""
    body = from_centre(14.24, np.array([0.0, 0.0, -1e-4]), np.eye(3))
    np.testing.assert_allclose(body.first_moment, [0.0, 0.0, -1.424e-3])


def test_second_moments_of_a_cube_by_hand():
    """m a^2 / 12 = 0.5 kg m^2 along every axis."""
    np.testing.assert_allclose(second_moments(np.eye(3)), 0.5 * np.eye(3))
    assert smallest_second_moment(np.eye(3)) == pytest.approx(0.5)


@pytest.mark.parametrize(
    ("inertia", "least"),
    [
        (np.diag([1.0, 1.0, 3.0]), -0.5),  # breaks the triangle inequality: (1 + 1 - 3) / 2
        (np.diag([1.0, 1.0, 2.0]), 0.0),  # a plate without thickness: the border
        (np.diag([-1.0, 1.0, 1.0]), -0.5),
        (np.array([[1.0, 0.9, 0.0], [0.9, 1.0, 0.0], [0.0, 0.0, 1.0]]), -0.4),  # 0.5 - 0.9
    ],
)
def test_impossible_inertia_is_detected(inertia, least):
    assert smallest_second_moment(inertia) == pytest.approx(least, abs=1e-15)
    assert not is_possible(MassProperties(1.0, np.zeros(3), inertia - 1e-12 * np.eye(3)))


def test_inertia_possible_about_P_may_be_impossible_about_C():
    """Unit moments about P with 10 kg half a metre away leave 1 - 2.5 < 0 about the centre."""
    assert smallest_second_moment(np.eye(3)) > 0
    assert not is_possible(MassProperties(10.0, np.array([0.5, 0.0, 0.0]), np.eye(3)))


@pytest.mark.parametrize("mass", [0.0, -1.0])
def test_mass_must_be_positive(mass):
    assert not is_possible(MassProperties(mass, np.zeros(3), np.eye(3)))
    assert is_possible(cube())


@given(bodies())
def test_a_box_is_possible(body):
    assert is_possible(body)


@given(bodies())
def test_inertia_is_least_about_the_centre_of_mass(body):
    """J_P - J_C is what a point mass at C would have: never negative."""
    assert np.linalg.eigvalsh(body.inertia_P - body.inertia_C)[0] > -NEAR * max(body.mass, 1.0)


@given(arrays(np.float64, (3, 3), elements=st.floats(-5.0, 5.0)))
def test_second_moments_there_and_back(any_matrix):
    J = any_matrix + any_matrix.T
    np.testing.assert_allclose(inertia_from_second_moments(second_moments(J)), J, atol=1e-13)
    np.testing.assert_allclose(second_moments(inertia_from_second_moments(J)), J, atol=1e-13)


@given(arrays(np.float64, 3, elements=st.floats(0.01, 5.0)))
def test_possible_means_triangle_inequality(moments):
    """For principal moments: the greatest is less than the sum of the others, and no more."""
    greatest, others = moments.max(), moments.sum() - moments.max()
    assume(abs(greatest - others) > 1e-9)
    body = MassProperties(1.0, np.zeros(3), np.diag(moments))
    assert is_possible(body) == (greatest < others)
