"""Energy of a platform on its bearing along a motion, and how well it is known.

    kinetic    1/2 w . J w                 potential    m g (R r)_z,  0 at the centre of rotation

The sd is that of first order in r, J (with their covariance) and w. Free motion without friction
keeps the sum. Cannot see what spins inside: the energy of wheels is not counted.
"""

import numpy as np

from equipoise.assessment.metrics.gravity_torque import down
from equipoise.model.arrays import Floats, Matrix3, Series3, Series4
from equipoise.model.testbed import Testbed

ROOT = np.array([0.5, 0.5, 0.5, 1.0, 1.0, 1.0])  # of 1/2 w.Jw by xx yy zz xy xz yz


def motion_energy(
    testbed: Testbed,
    motion: tuple[Series4, Series3, Series3],
    inertia_P: Matrix3,
    covariance: Floats,
    rate_sd: Series3,
) -> tuple[Series3, Series3]:
    """Return kinetic, potential and total energy and their sd (J), (n, 3) each.

    ``motion`` is attitude, rate (rad/s) and centre of mass (m) row by row; ``covariance`` (9, 9) of
    com and of J as xx yy zz xy xz yz.
    """
    q, w, com = motion
    weight, up = testbed.weight, -down(q)
    momentum = w @ inertia_P
    kinetic, potential = 0.5 * np.sum(w * momentum, axis=1), weight * np.sum(com * up, axis=1)
    by_com = np.hstack([weight * up, np.zeros((len(q), 6))])
    by_inertia = np.hstack([np.zeros((len(q), 3)), ROOT * products(w)])
    by_rate = np.sum((momentum * rate_sd) ** 2, axis=1)
    slopes = (by_inertia, by_com, by_inertia + by_com)
    variance = np.stack([_variance(slope, covariance) for slope in slopes], axis=1)
    variance[:, [0, 2]] += by_rate[:, None]
    return np.stack([kinetic, potential, kinetic + potential], axis=1), np.sqrt(variance)


def products(w: Series3) -> Floats:
    """Return wx^2, wy^2, wz^2, wx wy, wx wz, wy wz, (n, 6)."""
    x, y, z = w.T
    return np.stack([x * x, y * y, z * z, x * y, x * z, y * z], axis=1)


def _variance(slope: Floats, covariance: Floats) -> Floats:
    return np.maximum(np.einsum("ni,ij,nj->n", slope, covariance, slope), 0.0)
