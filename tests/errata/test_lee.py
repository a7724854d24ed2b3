"""Lee et al.: the corrected equation holds, the printed one fails (`docs/errata.md`)."""

import numpy as np

from tests.errata.point_masses import MASS, PITCH, PLACES, ROLL, UP, WDOT, E, G, J, W, euler_matrix


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
