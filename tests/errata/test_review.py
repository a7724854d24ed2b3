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
    E,
    G,
    J,
    W,
    centred,
    skew,
    turn,
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


WEIGHT, CENTRAL, DOWN = 14.0 * G, np.diag([0.30, 0.28, 0.45]), np.array([0.0, 0.0, -1.0])


def test_r21_the_gain_of_the_adaptation_belongs_into_v():
    """V' = -k_p |w_p|^2 of w J w / 2 + |r - rh|^2 / (2 gamma); the printed V has it for gamma = 1.

    J w' = -w x J w + Phi (r - rh) - k_p w_p, rh' = gamma Phi^T w, Phi = -m [g_b x]; q^T q / 2 is
    one half at every attitude.
    """
    gamma, damping, off = 1.3e-5, 0.6, PLACES[0]  # r - rh
    phi = MASS * G * skew(UP)
    across = W - (W @ UP) * UP
    wdot = np.linalg.solve(J, np.cross(J @ W, W) + phi @ off - damping * across)
    learnt = gamma * phi.T @ W
    falls = -damping * across @ across
    np.testing.assert_allclose(W @ J @ wdot - off @ learnt / gamma, falls)
    assert not np.isclose(W @ J @ wdot - off @ learnt, falls, rtol=0.5)


def test_r22_masses_give_the_torque_by_the_square_of_gravity():
    """m_p r x g_b is what was asked for, if that is across gravity; as printed, 9.8 times that."""
    g, m = -G * UP, 0.7
    requested = np.cross(W, g)
    np.testing.assert_allclose(np.cross(m * np.cross(g, requested) / (G**2 * m), g), requested)
    np.testing.assert_allclose(np.cross(m * np.cross(g, requested) / (G * m), g), G * requested)


def followed(r, w_a, seconds=40.0, dt=2e-3):
    """A platform let go level at rest, with rh = 0 and masses at once: gravity, rate and r - P rh.

    gamma = J (w_a / (m g))^2, k_p = 2 w_a J, with the mean moment across the vertical.
    """
    level = np.trace(CENTRAL[:2, :2]) / 2
    gamma, damping = level * (w_a / WEIGHT) ** 2, 2 * w_a * level
    attitude, w, held = E, np.zeros(3), np.zeros(3)
    for _ in range(int(seconds / dt)):
        n = attitude.T @ DOWN
        across = E - np.outer(n, n)
        torque = WEIGHT * np.cross(r - across @ held, n) - damping * across @ w
        w = w + dt * np.linalg.solve(CENTRAL, torque - np.cross(w, CENTRAL @ w))
        held = held + dt * gamma * WEIGHT * np.cross(n, w)
        attitude = attitude @ turn(dt * w)
    n = attitude.T @ DOWN
    return n, w, r - (E - np.outer(n, n)) @ held, gamma, held


def test_r23_the_platform_rests_with_an_offset_aside():
    """rh is gamma m (g_b - g_b(0)), nothing else; what is aside falls by |r_z| / (|r_z| + X) only.

    X = w_a^2 J / (m g) is 2.1 mm here: a third is left of 100 um that hang 1 mm low, while w_p = 0.
    """
    r, w_a = np.array([60e-6, -80e-6, -1e-3]), 1.0
    n, w, total, gamma, held = followed(r, w_a)
    assert np.abs(w).max() < 1e-6
    np.testing.assert_allclose(held, gamma * WEIGHT * (n - DOWN), rtol=1e-3, atol=1e-9)
    spring = gamma * WEIGHT
    left = 100e-6 * 1e-3 / (1e-3 + spring)
    np.testing.assert_allclose(np.linalg.norm(total[:2]), left, rtol=0.01)
    assert left > 30e-6
    np.testing.assert_allclose(np.cross(total, n), 0.0, atol=1e-9)  # along g_b, not along z


def test_r24_gravity_drives_the_closed_loop_and_not_the_rate():
    """G' = -w x G + tau - m [g_b x] r with tau = (-K + [w x]) G; r' = Psi m [g_b x]^T G."""
    g, r, gains, rate = -G * UP, 1e-3 * PLACES[0], np.diag([0.7, 0.9, 1.1]), 1e-6
    momentum = J @ W
    torque = -gains @ momentum + np.cross(W, momentum)
    slope = -np.cross(W, momentum) + torque + np.cross(MASS * r, g)
    np.testing.assert_allclose(slope + gains @ momentum, -MASS * skew(g) @ r)
    assert not np.allclose(slope + gains @ momentum, -MASS * skew(W) @ r)
    # V = G^T G / 2 + r^T Psi^-1 r / 2 falls as -G^T K G.
    moved = rate * MASS * skew(g).T @ momentum
    falls = -momentum @ gains @ momentum
    np.testing.assert_allclose(momentum @ slope + r @ moved / rate, falls)
    printed = -gains @ momentum - MASS * skew(W) @ r
    assert not np.isclose(momentum @ printed + r @ moved / rate, falls)


def test_r28_a_trajectory_about_the_vertical_leaves_the_null_vector():
    """e' = -K e - m [g_b x] r, r' = Psi m [g_b x]^T e for ten minutes, whatever G_d is.

    A turn about the vertical leaves g_b where it is in the body, and r along it too; round a cone
    of 18 deg the same r fades.
    """
    gain, rate, dt = 0.15, (0.19 / WEIGHT) ** 2, 0.05

    def left(angle, speed):
        e, r = np.zeros(3), np.array([0.0, 0.0, -1e-4])
        for k in range(12000):
            turn = speed * k * dt
            tilted = [np.sin(angle) * np.cos(turn), np.sin(angle) * np.sin(turn), -np.cos(angle)]
            pull = MASS * G * skew(np.array(tilted))
            e = e + dt * (-gain * e - pull @ r)
            r = r + dt * rate * pull.T @ e
        return np.linalg.norm(r)

    np.testing.assert_allclose(left(0.0, 0.17), 1e-4)
    assert left(np.radians(18.0), 0.17) < 1e-6


def test_r25_the_period_grows_as_the_platform_gets_balanced():
    """Half a swing from 3 deg, integrated: 2 pi sqrt(J / (m g h)), four times as long at h / 16."""

    def period(height, dt=1e-3):
        angle, rate, t = np.radians(3.0), 0.0, 0.0
        while rate <= 0:
            rate -= dt * WEIGHT * height * np.sin(angle) / CENTRAL[0, 0]
            angle += dt * rate
            t += dt
        return 2 * t

    badly, well = period(800e-6), period(50e-6)
    np.testing.assert_allclose(badly, 2 * np.pi * np.sqrt(0.30 / (WEIGHT * 800e-6)), rtol=2e-3)
    np.testing.assert_allclose(well / badly, 4.0, rtol=2e-3)
