"""Gravity's torque along a motion, as far as the centre of mass is known.

    tau_B = m r x g_B,    g_B = R(q)^T (0, 0, -g)          (``dynamics.rigid_body``)
    Cov tau = m^2 [g_B]x Cov r [g_B]x^T

It is what is left to hold against of a platform that is nearly balanced. Cannot see torques that do
not come from gravity; the attitude counts as known.
"""

import numpy as np

from equipoise.maths.attitude import to_matrix
from equipoise.model.arrays import Matrix3, Series3, Series4
from equipoise.model.testbed import Testbed

EYE = np.eye(3)


def down(q: Series4) -> Series3:
    """Return the unit vector of gravity in body axes, (n, 3)."""
    return -to_matrix(q)[:, 2, :]


def gravity_torque(
    testbed: Testbed, q: Series4, com: Series3, covariance: Matrix3
) -> tuple[Series3, Series3]:
    """Return torque and its sd (N m, body axes), (n, 3) each, of a com (m) with its covariance."""
    weight = testbed.weight
    n = down(q)
    lever = np.cross(n[:, None, :], EYE)  # (n, 3, 3): the rows of [n]x, up to sign
    variance = np.einsum("nij,jk,nik->ni", lever, covariance, lever)
    return weight * np.cross(com, n), weight * np.sqrt(np.maximum(variance, 0.0))
