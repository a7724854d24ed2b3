"""How a gyro's axes stand to the body axes of the camera, from the fit's 3 x 3 matrix.

    w_said = A w + b,     A = E + M = S Q          S symmetric, Q a rotation (polar decomposition)

``turn`` is the rotation vector from body axes to the gyro's, Q = R(turn)^T, and S - E holds its
scale errors on the diagonal and beside it how much its axes are out of square. To first
order turn = ( M_yz - M_zy, M_zx - M_xz, M_xy - M_yx ) / 2.

Body axes are those of the camera's markers: how these stand to the structure no motion shows. The
rails, which are found in the same axes, do.
"""

import numpy as np
import scipy

from equipoise.model import sensor_terms
from equipoise.model.arrays import Floats

GYRO = (*sensor_terms.GROUPS["gyro_scale"], *sensor_terms.GROUPS["gyro_cross"])
ALIGNMENT = tuple(f"gyro_turn_{axis}" for axis in "xyz")
SCALES = tuple(f"gyro_scale_{axis}" for axis in "xyz")
AT = ([0, 1, 2, 0, 0, 1, 1, 2, 2], [0, 1, 2, 1, 2, 0, 2, 0, 1])  # of xx yy zz xy xz yx yz zx zy


def matrix_of(coefficients: Floats) -> Floats:
    """Return A of the nine coefficients in the order of GYRO."""
    A = np.eye(3)
    A[AT] += coefficients
    return A


def alignment_of(coefficients: Floats) -> Floats:
    """Return turn (3) rad and scale errors (3) of the nine coefficients; det A must be positive."""
    Q, S = scipy.linalg.polar(matrix_of(coefficients), side="left")
    return np.append(-scipy.spatial.transform.Rotation.from_matrix(Q).as_rotvec(), np.diag(S) - 1.0)
