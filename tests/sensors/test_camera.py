"""What a camera says of an attitude: worked by hand, against plain NumPy, and its derivatives."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from equipoise.maths.attitude import difference, exponential, multiply, to_matrix
from equipoise.model.sensor_terms import TERMS
from equipoise.sensors.camera import (
    DELAY,
    GYRO,
    HEADING,
    N_SENSOR,
    PLUMB,
    column,
    heading,
    less_cross,
    said,
    seeing,
)
from tests.support.builders import camera_says

X = (1.0, 0.0, 0.0)
HALF = np.sqrt(0.5)
# two waves of an order about each body axis, no two alike: cos x y z, sin x y z
SECOND = np.array([1.0, 2.0, 3.0, 10.0, 20.0, 30.0]) * 1e-4
THIRD = np.array([5.0, -7.0, 11.0, -13.0, 17.0, 19.0]) * 1e-4
LEAN = np.array([4e-3, -6e-3])


def coefficients(plumb=(0.0, 0.0), second=(0.0,) * 6, third=(0.0,) * 6):
    """Return the list as kernels keep it."""
    return np.concatenate([plumb, second, third, np.zeros(N_SENSOR - DELAY)])


EVERY = coefficients(LEAN, SECOND, THIRD)


def yawed(degrees):
    return exponential(np.radians([0.0, 0.0, degrees]))


def as_said(q, sensor, forward=X):
    """Return the attitude said, by the kernels."""
    return np.array(said(q, sensor, seeing(q, forward, sensor).turn))


# --- By hand ------------------------------------------------------------------------------------


def test_places_are_those_of_the_names():
    """The kernels count where the model names."""
    assert (TERMS[PLUMB], TERMS[HEADING], TERMS[DELAY]) == (
        "plumb_x", "heading2_cos_x", "camera_delay",
    )  # fmt: skip
    assert TERMS[HEADING + 3] == "heading2_sin_x"
    assert TERMS[HEADING + 6] == "heading3_cos_x"
    assert TERMS[GYRO] == "gyro_xx"
    assert len(TERMS) == N_SENSOR


@pytest.mark.parametrize("psi", [0, 45, 90, 200])
def test_plumb_leans_the_vertical_about_laboratory_axes(psi):
    """0.01 rad about laboratory x: a level platform's z points to -y, whatever its heading."""
    found = to_matrix(as_said(yawed(psi), coefficients((0.01, 0.0))))
    np.testing.assert_allclose(found[:, 2], [0, -np.sin(0.01), np.cos(0.01)], atol=1e-15)
    found = to_matrix(as_said(yawed(psi), coefficients((0.0, 0.01))))
    np.testing.assert_allclose(found[:, 2], [np.sin(0.01), 0, np.cos(0.01)], atol=1e-15)


def test_plumb_lifts_what_points_along_y():
    """Heading 90 deg: body x lies along laboratory y, and a lean about x lifts it."""
    found = to_matrix(as_said(yawed(90), coefficients((0.01, 0.0))))
    np.testing.assert_allclose(found[:, 0], [0, np.cos(0.01), np.sin(0.01)], atol=1e-15)


C2, S2, C3, S3 = SECOND[:3], SECOND[3:], THIRD[:3], THIRD[3:]
BY_HAND = {  # heading: eta and d eta / d psi from cos and sin of 0, 90, 180 and 0, 135, 270 deg
    0: (C2 + C3, 2 * S2 + 3 * S3),
    45: (S2 + HALF * (S3 - C3), -2 * C2 - 3 * HALF * (C3 + S3)),
    90: (-C2 - S3, -2 * S2 + 3 * C3),
}


@pytest.mark.parametrize("psi", BY_HAND)
def test_harmonics_by_hand(psi):
    """cos 2 psi, sin 2 psi, cos 3 psi, sin 3 psi at headings where everybody knows them."""
    now = seeing(yawed(psi), X, EVERY)
    turn, by_heading = BY_HAND[psi]
    np.testing.assert_allclose(now.turn, turn, atol=1e-17)
    np.testing.assert_allclose(now.by_heading, by_heading, atol=1e-17)
    np.testing.assert_allclose(now.cos, np.cos(np.radians(psi) * np.arange(1, 4)), atol=1e-15)
    np.testing.assert_allclose(now.sin, np.sin(np.radians(psi) * np.arange(1, 4)), atol=1e-15)


def test_harmonics_turn_about_body_axes():
    """Heading 45 deg, sin 2 psi = 1: 0.01 rad about body x, which points to (1, 1, 0) / sqrt 2.

    Body y, which pointed to (-1, 1, 0) / sqrt 2, rises by 0.01; about laboratory x it would rise
    by 0.01 / sqrt 2 only, and body x with it.
    """
    found = to_matrix(as_said(yawed(45), coefficients(second=(0, 0, 0, 0.01, 0, 0))))
    np.testing.assert_allclose(found[:, 0], [HALF, HALF, 0], atol=1e-15)
    c, s = np.cos(0.01), np.sin(0.01)
    np.testing.assert_allclose(found[:, 1], [-HALF * c, HALF * c, s], atol=1e-15)


def test_heading_of_another_axis():
    """Body y forward: at a yaw of 30 deg it points to 120 deg."""
    c, s, _ = heading(yawed(30), (0.0, 1.0, 0.0))
    np.testing.assert_allclose([c, s], [-0.5, np.sqrt(0.75)], atol=1e-15)


def test_a_tilted_axis_turns_its_heading_faster():
    """Body x points up by 45 deg in the x-z plane: p = (1, 0, 1) / sqrt 2, da = (-1, 0, 1)."""
    c, s, da = heading(exponential(np.radians([0.0, -45.0, 0.0])), X)
    np.testing.assert_allclose([c, s], [1, 0], atol=1e-15)
    np.testing.assert_allclose(da, [-1, 0, 1], atol=1e-15)


def test_less_cross_by_hand():
    """x - turn x x / 2 of unit vectors: y - (x x y) / 2 = y - z / 2."""
    assert less_cross((0.0, 1.0, 0.0), (1.0, 0.0, 0.0), 0.5) == (0.0, 1.0, -0.5)


# --- Plain NumPy --------------------------------------------------------------------------------


tilts = arrays(np.float64, 2, elements=st.floats(-0.5, 0.5))
yaws = st.floats(-3.1, 3.1)
axes = st.sampled_from([X, (0.0, 1.0, 0.0), (0.8, 0.0, -0.6)])


def tilted(yaw, tilt):
    return multiply(exponential(np.array([0, 0, yaw])), exponential(np.array([*tilt, 0.0])))


@given(yaws, tilts, axes)
def test_agrees_with_plain_numpy(yaw, tilt, forward):
    """Any heading, tilts up to 40 deg."""
    q = tilted(yaw, tilt)
    expected = camera_says(q, EVERY, forward)
    np.testing.assert_allclose(as_said(q, EVERY, forward), expected, rtol=0, atol=1e-15)


# The derivatives leave out squares of the errors: 1e-2 rad of error leaves 1e-4 of a column; a
# wrong sign of a product that they do keep would leave 1e-2.
LEFT_OUT = 1.5e-4


@given(yaws, tilts, axes, st.integers(0, DELAY - 1))
def test_columns_are_central_differences(yaw, tilt, forward, term):
    """One unit of each coefficient, at a point where all others are there."""
    q, step = tilted(yaw, tilt), 1e-5 * (np.arange(N_SENSOR) == term)
    found = column(term, q, EVERY, seeing(q, forward, EVERY))
    more, less = (camera_says(q, sensor, forward) for sensor in (EVERY + step, EVERY - step))
    np.testing.assert_allclose(found, difference(more, less) / 2e-5, rtol=0, atol=LEFT_OUT)


@given(yaws, tilts, axes, st.integers(0, 2))
def test_heading_turns_with_the_body(yaw, tilt, forward, axis):
    """d psi by a small turn about a laboratory axis."""
    q, step = tilted(yaw, tilt), 1e-6 * np.eye(3)[axis]
    _, _, da = heading(q, forward)
    now, then = (np.array(heading(multiply(exponential(s), q), forward)[:2]) for s in (-step, step))
    numeric = (now[0] * then[1] - now[1] * then[0]) / 2e-6  # sine of the small angle between
    np.testing.assert_allclose(da[axis], numeric, rtol=0, atol=1e-7)
