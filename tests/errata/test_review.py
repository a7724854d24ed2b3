"""The review, da Silva et al. 2021: the corrected equation holds, the printed one fails."""

import numpy as np

from tests.errata.point_masses import (
    MASS,
    MASSES,
    MOVED,
    PITCH,
    PLACES,
    ROLL,
    UP,
    WDOT,
    G,
    J,
    W,
    centred,
    skew,
)


def test_r2_one_of_two_readings_counts_a_term_twice():
    """With all rates seen from the laboratory, w x (r x m r') is already in r x m r''."""
    (r, central), m = centred(), MASSES.sum()
    v = np.cross(W, r)
    in_laboratory = np.cross(WDOT, r) + np.cross(W, v)
    in_body = np.cross(WDOT, r)  # slope of the components of v
    rotation = central @ WDOT + np.cross(W, central @ W)
    truth = J @ WDOT + np.cross(W, J @ W)
    extra = np.cross(W, np.cross(r, m * v))
    np.testing.assert_allclose(np.cross(r, m * in_laboratory) + rotation, truth)
    np.testing.assert_allclose(np.cross(r, m * in_body) + extra + rotation, truth)
    assert not np.allclose(np.cross(r, m * in_laboratory) + extra + rotation, truth)


def test_r3_the_simplified_model_has_z_up():
    (x, y, z), up = PLACES[0], np.cos(ROLL) * np.cos(PITCH)
    side, front = np.sin(ROLL) * np.cos(PITCH), np.sin(PITCH)
    printed = MASS * G * np.array([-y * up + z * side, x * up + z * front, -x * side - y * front])
    np.testing.assert_allclose(printed, np.cross(PLACES[0], -MASS * G * UP))


def test_r5_the_printed_cross_matrix_has_z_down():
    up, side, front = np.cos(ROLL) * np.cos(PITCH), np.sin(ROLL) * np.cos(PITCH), np.sin(PITCH)
    printed = G * np.array([[0, -up, side], [up, 0, front], [-side, -front, 0]])
    np.testing.assert_allclose(printed, skew(G * UP))  # of g along +Z
    torque = np.cross(PLACES[0], -MASS * G * UP)
    np.testing.assert_allclose(printed @ (MASS * PLACES[0]), torque)
    assert not np.allclose(-printed @ (MASS * PLACES[0]), torque)  # as Eq. 11 has it


def test_r7_products_are_integrals_with_a_plus_sign():
    """J w = Omega J~ with the printed minus signs holds for J_xy = +sum m x y."""
    a, b, c = W
    omega = np.array([[a, 0, 0, -b, -c, 0], [0, b, 0, -a, 0, -c], [0, 0, c, 0, -a, -b]])
    x, y, z = PLACES.T
    products = [MASSES @ (x * y), MASSES @ (x * z), MASSES @ (y * z)]
    np.testing.assert_allclose(omega @ [*np.diag(J), *products], J @ W)
    np.testing.assert_allclose([J[0, 1], J[0, 2], J[1, 2]], np.negative(products))


def test_r8_an_integral_has_a_lower_end():
    """J w - J w_0 + int w x J w = int torque, with w a parabola and the torque it needs."""
    t = np.linspace(0.0, 1.0, 2001)
    w = W + np.outer(t, WDOT) + np.outer(t**2, MOVED)
    slope = WDOT + 2 * np.outer(t, MOVED)
    gyroscopic = np.cross(w, w @ J)
    torque = np.trapezoid(slope @ J + gyroscopic, t, axis=0)
    printed = J @ w[-1] + np.trapezoid(gyroscopic, t, axis=0)
    np.testing.assert_allclose(printed - J @ W, torque, atol=1e-5)
    assert not np.allclose(printed, torque, atol=0.1)


def test_r12_com_does_not_grow_by_the_rate():
    """Phi as in Eq. 8, of a step of 10 ms. The printed lower rows add w, in rad/s, to r, in m."""
    phi = 0.01 * np.linalg.inv(J) @ skew(MASS * G * UP)
    right = np.block([[np.eye(3), phi], [np.zeros((3, 3)), np.eye(3)]])
    printed = np.block([[np.eye(3), phi], [np.eye(3), np.eye(3)]])
    state = np.array([*W, *PLACES[0]])
    np.testing.assert_allclose((right @ state)[3:], PLACES[0])
    np.testing.assert_allclose((printed @ state)[3:], PLACES[0] + W)
    torque = J @ ((right @ state)[:3] - W) / 0.01
    np.testing.assert_allclose(torque, np.cross(PLACES[0], -MASS * G * UP))
