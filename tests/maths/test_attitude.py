"""Quaternions form a group, stand for rotations, and have a logarithm that undoes the exponential.

ROUNDING: products of numbers of size 1 carry a few units of 1e-16.
"""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from scipy.linalg import expm

from equipoise.maths.attitude import (
    conjugate,
    continuous,
    difference,
    euler321_sd,
    exponential,
    from_euler321,
    logarithm,
    multiply,
    normalise,
    tilt,
    to_euler321,
    to_matrix,
)
from equipoise.maths.linalg import skew

ROUNDING = 1e-14
ONE = np.array([1.0, 0.0, 0.0, 0.0])

fours = arrays(np.float64, 4, elements=st.floats(-1.0, 1.0))
quaternions = fours.filter(lambda v: np.linalg.norm(v) > 0.1).map(normalise)
directions = arrays(np.float64, 3, elements=st.floats(-1.0, 1.0)).filter(
    lambda v: np.linalg.norm(v) > 0.1
)
vectors = arrays(np.float64, 3, elements=st.floats(-1.7, 1.7))  # shorter than pi


def assert_near(a, b, tolerance=ROUNDING):
    np.testing.assert_allclose(a, b, rtol=0, atol=tolerance)


@given(quaternions, quaternions, quaternions)
def test_group(p, q, r):
    """Products stay unit and associate; 1 changes nothing; the conjugate undoes."""
    assert_near(np.linalg.norm(multiply(p, q)), 1.0)
    assert_near(multiply(multiply(p, q), r), multiply(p, multiply(q, r)))
    assert_near(multiply(ONE, q), q)
    assert_near(multiply(q, ONE), q)
    assert_near(multiply(q, conjugate(q)), ONE)


def test_hamilton_by_hand():
    """i j = k, j k = i, k i = j, i i = -1."""
    one, i, j, k = np.eye(4)
    assert multiply(i, j).tolist() == k.tolist()
    assert multiply(j, k).tolist() == i.tolist()
    assert multiply(k, i).tolist() == j.tolist()
    assert multiply(i, i).tolist() == (-one).tolist()


@given(quaternions, quaternions)
def test_matrix_is_a_rotation_and_keeps_products(p, q):
    """R(q) is orthonormal with determinant 1; R(p q) = R(p) R(q); R(-q) = R(q)."""
    R = to_matrix(q)
    assert_near(R @ R.T, np.eye(3))
    assert np.linalg.det(R) == pytest.approx(1.0)
    assert_near(to_matrix(multiply(p, q)), to_matrix(p) @ R)
    assert_near(to_matrix(-q), R)


def test_quarter_turn_by_hand():
    """A body turned by 90 deg about z has its x axis along the laboratory's y."""
    R = to_matrix(np.array([np.sqrt(0.5), 0.0, 0.0, np.sqrt(0.5)]))
    assert_near(R @ [1.0, 0.0, 0.0], [0.0, 1.0, 0.0])


@given(vectors)
def test_exponential_is_the_matrix_exponential(v):
    """R(exp v) is the exponential series of [v x]."""
    assert_near(to_matrix(exponential(v)), expm(skew(v)), 1e-13)


@pytest.mark.parametrize("angle", [0.0, 1e-300, 1e-15, 1e-12, 1e-9, 1e-4, 1.0, 3.1])
@given(direction=directions)
def test_logarithm_undoes_exponential(angle, direction):
    """From no turn at all to nearly half a turn, to rounding of the angle itself."""
    v = angle * direction / np.linalg.norm(direction)
    assert_near(logarithm(exponential(v)), v, 1e-14 * angle)


@pytest.mark.parametrize("short_of", [1e-3, 1e-6, 1e-9, 1e-12])
@given(direction=directions)
def test_logarithm_near_half_a_turn(short_of, direction):
    """The direction is kept until the other way round is shorter."""
    v = (np.pi - short_of) * direction / np.linalg.norm(direction)
    assert_near(logarithm(exponential(v)), v)


@given(quaternions)
def test_logarithm_takes_the_shorter_way(q):
    """Both signs of q give one rotation vector, of at most half a turn; it leads back to q."""
    v = logarithm(q)
    assert np.linalg.norm(v) <= np.pi + ROUNDING
    if abs(q[0]) > 1e-6:  # at exactly half a turn both ways are equally long
        assert_near(logarithm(-q), v)
    assert_near(to_matrix(exponential(v)), to_matrix(q))


@given(quaternions, vectors)
def test_difference_is_in_body_axes(q, v):
    """After a turn v about body axes the difference is v."""
    assert_near(difference(multiply(q, exponential(v)), q), v, 1e-13)


def test_series_and_single_agree():
    """Row by row, a series gives what its rows give."""
    v = np.random.default_rng(1).normal(size=(5, 3))
    q = exponential(v)
    assert q.tolist() == [exponential(row).tolist() for row in v]
    assert_near(logarithm(q), [logarithm(row) for row in q])
    assert to_matrix(q).tolist() == [to_matrix(row).tolist() for row in q]


def test_euler_by_hand():
    """Yaw 90 and pitch 90 deg: body x points down, y along -X, z along Y."""
    quarter = np.array(np.pi / 2)
    R = to_matrix(from_euler321(np.array(0.0), quarter, quarter))
    assert_near(R, [[0, -1, 0], [0, 0, 1], [-1, 0, 0]])


@given(*[st.floats(-3.0, 3.0)] * 3)
def test_euler_is_three_plain_turns(roll, pitch, yaw):
    """R = Rz(yaw) Ry(pitch) Rx(roll), each written out."""

    def plain(angle, a, b):
        R = np.eye(3)
        R[a, a] = R[b, b] = np.cos(angle)
        R[b, a], R[a, b] = np.sin(angle), -np.sin(angle)
        return R

    expected = plain(yaw, 0, 1) @ plain(pitch, 2, 0) @ plain(roll, 1, 2)
    q = from_euler321(np.array(roll), np.array(pitch), np.array(yaw))
    assert_near(to_matrix(q), expected)


@given(st.lists(st.booleans(), min_size=9, max_size=9))
def test_continuous_removes_every_sign_flip(flips):
    """Whatever the signs, the smooth series comes back, as the first row has it."""
    smooth = exponential(np.linspace(0, 7, 9)[:, None] * [0.3, 0.5, 0.8])
    signs = np.where(flips, -1.0, 1.0)[:, None]
    assert_near(continuous(smooth * signs), signs[0] * smooth, 0.0)


@given(st.floats(0.0, np.pi), st.floats(-np.pi, np.pi), st.floats(-np.pi, np.pi))
def test_tilt_is_the_angle_from_the_vertical(angle, heading, spin):
    """Turns about the vertical, before or after leaning, do not count (arccos: rounding's root)."""
    turns = [np.array([0, 0, heading]), np.array([angle, 0, 0]), np.array([0, 0, spin])]
    first, lean, last = (exponential(v) for v in turns)
    q = multiply(first, multiply(lean, last))
    assert tilt(q, np.array([0.0, 0.0, 1.0])) == pytest.approx(angle, abs=1e-7)


def test_tilt_of_another_axis_by_hand():
    """A platform whose y axis points up when level, against z up: 90 deg."""
    assert tilt(ONE, np.array([0.0, 1.0, 0.0])) == pytest.approx(np.pi / 2)
    up = exponential(np.array([np.pi / 2, 0.0, 0.0]))
    assert tilt(up, np.array([0.0, 1.0, 0.0])) == pytest.approx(0.0, abs=1e-7)


@given(vectors)
def test_roll_pitch_and_yaw_lead_back(vector):
    q = exponential(vector)
    roll, pitch, yaw = to_euler321(q)
    assert abs(pitch) <= np.pi / 2
    assert_near(abs(from_euler321(roll, pitch, yaw) @ q), 1.0)


def test_each_of_roll_pitch_and_yaw_is_its_own():
    assert_near(np.array(to_euler321(from_euler321(0.3, -0.4, 2.5))), [0.3, -0.4, 2.5])
    series = from_euler321(np.array([0.1, 0.2]), np.array([0.0, -1.0]), np.array([3.0, -3.0]))
    assert_near(np.array(to_euler321(series)), [[0.1, 0.2], [0.0, -1.0], [3.0, -3.0]])


def test_spread_of_roll_pitch_and_yaw_is_that_of_drawn_attitudes():
    """200 000 errors of 1e-3 rad about each axis, at a pitch of 50 deg: the spread to 1 %."""
    rng, sd = np.random.default_rng(4), 1e-3
    q = from_euler321(*np.radians([20.0, 50.0, -70.0]))
    observed = multiply(
        np.tile(q, (200_000, 1)), exponential(sd * rng.standard_normal((200_000, 3)))
    )
    found = [float(np.std(angle)) for angle in to_euler321(observed)]
    assert found == pytest.approx([float(s) for s in euler321_sd(np.radians(50.0), sd)], rel=0.01)
