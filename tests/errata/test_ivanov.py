"""Ivanov et al. 2021: the corrected equation holds, the printed one fails (`docs/errata.md`)."""

import numpy as np
import pytest

from tests.errata.point_masses import (
    MASS,
    MASSES,
    MOVED,
    PLACES,
    STEP,
    E,
    G,
    J,
    W,
    centred,
    inertia,
    matrix_of,
    random,
    skew,
    slopes,
    turn,
)
from tests.oracle.mujoco_bench import product, rotation


def test_i1_euler_about_the_centre_of_rotation_needs_the_inertia_about_it():
    """Momentum about P of points that turn about P. Eq. 2.2 itself is right."""
    momentum = sum(m * np.cross(p, np.cross(W, p)) for m, p in zip(MASSES, PLACES, strict=True))
    r, central = centred()
    (a, b, c), m = r, MASSES.sum()
    printed = central + m * np.array(
        [[b * b + c * c, -a * b, -a * c], [-a * b, a * a + c * c, -b * c],
         [-a * c, -b * c, a * a + b * b]]
    )  # fmt: skip
    np.testing.assert_allclose(printed, J)
    np.testing.assert_allclose(printed @ W, momentum)
    assert not np.allclose(central @ W, momentum)


def test_i2_masses_are_added_and_the_square_needs_the_identity():
    with_loads, body = J, inertia(MASSES[3:], PLACES[3:])
    loads = list(zip(MASSES[:3], PLACES[:3], strict=True))
    printed = body - sum(m * (p @ p - np.outer(p, p)) for m, p in loads)
    right = body + sum(m * (p @ p * E - np.outer(p, p)) for m, p in loads)
    np.testing.assert_allclose(right, with_loads)
    assert not np.allclose(printed, with_loads)


def moved_by(m, p, d):
    return inertia([m], [p + d]) - inertia([m], [p])


def test_i3_a_moved_mass():
    m, p, d = MASSES[0], PLACES[0], MOVED
    mixed = np.outer(p, d) + np.outer(d, p) + np.outer(d, d)
    right = m * ((d @ d + 2 * p @ d) * E - mixed)
    printed = m * (d @ d + 2 * (p @ d) ** 2 - mixed)
    np.testing.assert_allclose(right, moved_by(m, p, d))
    assert not np.allclose(printed, moved_by(m, p, d))
    np.testing.assert_allclose(moved_by(m, 2 * p, 2 * d), 4 * right)  # lengths twice as long
    doubled = m * (4 * d @ d + 2 * (4 * p @ d) ** 2 - 4 * mixed)
    assert not np.allclose(doubled, 4 * printed)  # has a term in m^4


def test_i4_about_the_centre_of_mass_the_centre_moves_too():
    places = PLACES.copy()
    before, (r, _) = J, centred()
    places[0] += MOVED
    total, after = MASSES.sum(), inertia(MASSES, places)
    dr = MASSES[0] * MOVED / total
    own = inertia(MASSES, places - r - dr) - inertia(MASSES, PLACES - r)
    moved = r + dr
    taken = total * ((moved @ moved - r @ r) * E - np.outer(moved, moved) + np.outer(r, r))
    np.testing.assert_allclose(own, after - before - taken)
    assert not np.allclose(own, after - before)


def test_i5_torque_and_kinematics_are_right_with_a_matrix_into_the_body():
    """Virtual work: a small turn u in body axes raises m g (R r)_z by -M.u. Eq. 2.4 as it is."""
    q, r = rotation(np.array([0.3, -0.2, 0.5])), PLACES[0]
    into_body = matrix_of(q).T

    def energy(u):
        return np.atleast_1d(MASS * G * (matrix_of(q) @ turn(u) @ r)[2])

    torque = -slopes(energy, np.zeros(3))[0]
    down = np.array([0, 0, -1.0])
    np.testing.assert_allclose(MASS * G * np.cross(r, into_body @ down), torque, atol=1e-6)
    assert not np.allclose(MASS * G * np.cross(r, into_body.T @ down), torque)
    later = product(q, rotation(W * STEP))
    a, b, c = W
    rows = [[0, c, -b, a], [-c, 0, a, b], [b, -a, 0, c], [-a, -b, -c, 0]]
    slope = 0.5 * np.array(rows) @ [*q[1:], q[0]]
    np.testing.assert_allclose((later - q)[[1, 2, 3, 0]] / STEP, slope, atol=1e-5)


def test_i6_the_printed_cost_depends_on_the_sign_of_a_quaternion():
    q = rotation(MOVED)
    np.testing.assert_allclose(matrix_of(q), matrix_of(-q))  # the same attitude
    assert np.sum((q - -q) ** 2) == pytest.approx(4.0)  # the most that the printed cost can be
    error = product(-q * [1, -1, -1, -1], q)
    assert 2 * np.arccos(min(abs(error[0]), 1.0)) == pytest.approx(0.0, abs=1e-7)


def half_angle_slopes():
    """Of the half-angle error of q, its slope by itself and by an error of w, numerically."""
    q, dt = rotation(np.array([0.3, -0.2, 0.5])), 1e-4
    forward = product(q, rotation(W * dt))

    def later(errors):
        half, dw = errors[:3], errors[3:]
        observed = product(q, np.array([np.sqrt(1 - half @ half), *half]))
        observed = product(observed, rotation((W + dw) * dt))
        return product(forward * [1, -1, -1, -1], observed)[1:]

    matrix = slopes(later, np.zeros(6))
    return (matrix[:, :3] - E) / dt, matrix[:, 3:] / dt


def test_i7_the_attitude_row_is_that_of_a_multiplicative_half_angle():
    by_error, by_rate = half_angle_slopes()
    np.testing.assert_allclose(by_error, -skew(W), atol=1e-3)
    np.testing.assert_allclose(by_rate, E / 2, atol=1e-3)
    v = np.array([0.2, -0.1, 0.3])  # vector part of a quaternion

    def additive(both):
        v, w = both[:3], both[3:]
        return 0.5 * (np.sqrt(1 - v @ v) * w + np.cross(v, w))

    matrix, scalar = slopes(additive, np.array([*v, *W])), np.sqrt(1 - v @ v)
    np.testing.assert_allclose(
        matrix[:, :3], -0.5 * skew(W) - np.outer(W, v) / (2 * scalar), atol=1e-8
    )
    np.testing.assert_allclose(matrix[:, 3:], 0.5 * (scalar * E + skew(v)), atol=1e-8)
    assert not np.allclose(matrix[:, :3], -skew(W), atol=0.1)  # printed, for an additive update


def acceleration(half, w, r):
    """J w' of Eq. 2.1, the attitude off by a half angle."""
    g = (turn(2 * half)).T @ np.array([0.4, -0.7, -9.8])
    return -np.cross(w, J @ w) + MASS * np.cross(r, g)


def test_i8_half_angles_need_a_factor_two():
    g, r = np.array([0.4, -0.7, -9.8]), PLACES[1]
    matrix = slopes(lambda half: acceleration(half, W, r), np.zeros(3))
    np.testing.assert_allclose(matrix, 2 * skew(r) @ skew(MASS * g), atol=1e-5)
    assert not np.allclose(matrix, skew(r) @ skew(MASS * g), atol=1.0)
    by_com = slopes(lambda r: acceleration(np.zeros(3), W, r), r)
    np.testing.assert_allclose(by_com, -skew(MASS * g), atol=1e-5)  # this block is right


def test_i9_the_gyroscopic_block():
    matrix = slopes(lambda w: acceleration(np.zeros(3), w, PLACES[1]), W)
    np.testing.assert_allclose(matrix, skew(J @ W) - skew(W) @ J, atol=1e-6)
    printed = 2 * (skew(J @ W) @ skew(W) - skew(W) @ J @ skew(W))
    assert not np.allclose(matrix, printed, atol=1.0)


def test_i11_a_quaternions_vector_part_errs_by_half_the_angle():
    angles = np.radians(0.2) * random.normal(size=(2000, 3))
    parts = np.array([rotation(angle)[1:] for angle in angles])
    np.testing.assert_allclose(parts.std(axis=0), np.radians(0.2) / 2, rtol=0.06)


def test_i14_and_i15_numbers_in_the_text():
    """Filter's and fit's com, um; the shift by one load on each axis that goes 10, 10 and 50 mm."""
    separation = np.array([-4.0, -0.1, -81.0]) - [-0.92, -0.1, -79.0]
    assert abs(separation[0]) == pytest.approx(3.1, abs=0.03)
    shift = 15.6e-3 / 14.24 * np.array([10, 10, 50]) * 1e-3
    np.testing.assert_allclose(shift, [1.10e-5, 1.10e-5, 5.48e-5], rtol=5e-3)
