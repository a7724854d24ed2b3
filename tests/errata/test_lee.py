"""Lee et al.: the corrected equation holds, the printed one fails (`docs/errata.md`)."""

import numpy as np
import pytest

from tests.errata.point_masses import MASS, PITCH, PLACES, ROLL, UP, WDOT, E, G, J, W, euler_matrix
from tests.oracle.mujoco_bench import product


def lee_matrices(w, wdot):
    a, b, c = w
    da, db, dc = wdot
    moments = [[da, -b * c, b * c], [a * c, db, -a * c], [-a * b, a * b, dc]]
    products = [
        [db - a * c, dc + a * b, -c * c + b * b],
        [da + b * c, c * c - a * a, dc - a * b],
        [-b * b + a * a, da - b * c, db + a * c],
    ]
    return np.array(moments), np.array(products)


def lee_weight(up):
    """Omega_3 as printed, its column of direction cosines taken for that of the vertical."""
    return np.array([[0, up[2], -up[1]], [-up[2], 0, up[0]], [up[1], -up[0], 0]])


def test_l1_and_l2_the_column_of_the_vertical_and_g():
    """On the left of the balance stands -r x m g_B = Omega_3 g (m r), c the axis that is up."""
    left = -np.cross(PLACES[0], -MASS * G * UP)
    np.testing.assert_allclose(lee_weight(UP) @ (G * MASS * PLACES[0]), left)
    assert not np.allclose(lee_weight(UP) @ (MASS * PLACES[0]), left)
    level = euler_matrix(ROLL, PITCH, 1.1).T @ E[0]  # the roll column where Z is up
    assert not np.allclose(lee_weight(level) @ (G * MASS * PLACES[0]), left)


def kinematic(q):
    """E(q) of their Eq. 1, q' = E(q) w / 2: 4 x 3, scalar first."""
    return np.array([product(q, np.array([0.0, *e])) for e in E]).T


def settled(integrand, gain, seconds=200.0, dt=2e-3):
    """Turn one axis (J = 1) from 0.3 rad under a torque of 0.05, by Eq. 2; where it ends, rad."""
    angle, rate, total = 0.3, 0.0, 0.0
    for _ in range(int(seconds / dt)):
        error = -np.sin(angle / 2)  # E^T(q) q_T about this axis
        total += dt * integrand(error, rate)
        rate += dt * (-1.4 * rate + 2 * error + gain * total + 0.05)
        angle += dt * rate
    return angle


def test_l4_the_integral_of_the_rate_is_no_vector_and_leaves_the_offset():
    """E^T(q) is 3 x 4. Read as the rate's own integral it is the angle turned: one more spring,
    that rests where -x + gain (x - 0.3) + 0.05 = 0. With E^T(q) q_T that is at zero.
    """
    q = np.array([0.9, 0.1, -0.3, 0.2]) / np.linalg.norm([0.9, 0.1, -0.3, 0.2])
    with pytest.raises(ValueError, match="mismatch"):
        kinematic(q).T @ W
    assert settled(lambda error, _: error, 0.2) == pytest.approx(0.0, abs=1e-4)
    for gain in (0.2, -0.2):  # the angle counts from the start, 0.3 rad
        offset = (0.05 - 0.3 * gain) / (1 - gain)
        assert settled(lambda _, rate: rate, gain) == pytest.approx(offset, rel=0.02)


def test_l4_the_error_needs_the_sign_of_its_scalar():
    """E^T(q) q_T is the vector part of q* q_T; of -q, the same attitude, it points away."""
    q = np.array([0.9, 0.1, -0.3, 0.2]) / np.linalg.norm([0.9, 0.1, -0.3, 0.2])
    target = np.array([1.0, 0.0, 0.0, 0.0])
    turn = product(q * [1, -1, -1, -1], target)
    np.testing.assert_allclose(kinematic(q).T @ target, turn[1:])
    np.testing.assert_allclose(kinematic(-q).T @ target, -turn[1:])
    for each in (q, -q):
        scalar = each @ target
        np.testing.assert_allclose(np.sign(scalar) * (kinematic(each).T @ target), turn[1:])


def test_l7_a_mean_of_the_rows_before_is_late():
    """By (n + 1) / 2 rows, on a ramp of one a row."""
    rows, n, k = np.arange(100.0), 10, 60
    mean = np.mean([rows[k - i] for i in range(1, n + 1)])
    assert rows[k] - mean == (n + 1) / 2
    centred_mean = np.mean(rows[k - n // 2 : k + n // 2 + 1])
    assert centred_mean == rows[k]


def test_l10_inertia_columns_are_right_with_tensor_elements():
    moments, products = lee_matrices(W, WDOT)
    left = moments @ np.diag(J) + products @ [J[0, 1], J[0, 2], J[1, 2]]
    np.testing.assert_allclose(left, J @ WDOT + np.cross(W, J @ W))
