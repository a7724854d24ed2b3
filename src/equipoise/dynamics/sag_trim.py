"""Where the centre of mass should be on a platform that sags, so that its weight turns it least.

Elastic sag moves the centre of mass with the direction of gravity, n = g_B / g:

    tau(n) = m g (r + C n) x n,      C symmetric; its isotropic part gives no torque

No r cancels that at every attitude. The r that leaves the least mean square over directions within
a tilt of level, each direction counting alike, solves

    mean(E - n n^T) r = -mean( (E - n n^T) C n )

For sag along the vertical alone, C = c u u^T, a plate that hangs by c when level, this is
r = u c mean(sin^2 cos) / mean(sin^2): the platform is trimmed as if it sagged alike at every tilt.
(The trimming of platform deformation; as published the maximum is made least.)

The means are exact: four Gauss points in the cosine of the tilt, eight headings.
"""

from collections.abc import Mapping

import numpy as np

from equipoise.maths.attitude import level, to_matrix
from equipoise.model.arrays import Floats, Matrix3, Series3, Vector3

SAG_TERMS = ("sag_xx", "sag_yy", "sag_xy", "sag_xz", "sag_yz")
NODES, HEADINGS = 4, 8  # exact for what is of degree 6 in n


def sag_matrix(terms: Mapping[str, float]) -> Matrix3:
    """Return C (m) of the five coefficients by name; traceless, absent ones zero."""
    xx, yy, xy, xz, yz = (terms.get(name, 0.0) for name in SAG_TERMS)
    return np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, -xx - yy]])


def downs(up: Vector3, tilt: float) -> tuple[Series3, Floats]:
    """Return directions of gravity within a tilt (rad) of level, and their weights, (n, 1)."""
    points, weights = np.polynomial.legendre.leggauss(NODES)
    low = np.cos(tilt)
    cosine = np.repeat(0.5 * (1 + low) + 0.5 * (1 - low) * points, HEADINGS)
    heading = np.tile(2 * np.pi * np.arange(HEADINGS) / HEADINGS, NODES)
    sine = np.sqrt(1 - cosine**2)
    n = -np.column_stack([sine * np.cos(heading), sine * np.sin(heading), cosine])
    # R(level(up)) brings ``up`` to z; its transpose brings directions about z to those about up.
    weight: Floats = np.repeat(0.5 * weights / HEADINGS, HEADINGS)
    turned: Series3 = n @ to_matrix(level(up))
    return turned, weight.reshape(-1, 1)


def acting_com(com: Vector3, sag: Matrix3, up: Vector3) -> Vector3:
    """Return the centre of mass (m) of a stiff platform that behaves alike at small tilts.

    Level, C adds -C u to r. A little tilted it adds to the weight's lever as a height of
    (tr C - 3 u^T C u) / 2 would, the mean over both horizontal axes.
    """
    level_height = up @ sag @ up
    return com - sag @ up + 0.5 * (np.trace(sag) - level_height) * up


def trimmed_com(sag: Matrix3, up: Vector3, tilt: float) -> Vector3:
    """Return the centre of mass (m) that leaves the least torque within a tilt (rad)."""
    n, weight = downs(up, tilt)
    across: Matrix3 = np.eye(3) - (weight * n).T @ n
    bent: Series3 = n @ sag
    along: Floats = np.sum(n * bent, axis=1, keepdims=True)
    pull: Vector3 = np.sum(weight * (bent - along * n), axis=0)
    return -np.linalg.inv(across) @ pull


def trimming_shift(sag: Matrix3, trim: Vector3, down: Vector3) -> Vector3:
    """Return what masses must add (m) at one attitude, -(E - n n^T)(trim + C n).

    With it nothing is left across gravity's direction ``down`` (unit) of a platform that has been
    trimmed; it is the least shift that does so, and nothing where C and trim cancel.
    """
    bent: Vector3 = trim + sag @ down
    return (bent @ down) * down - bent


def residual_torque(com: Vector3, sag: Matrix3, up: Vector3, tilt: float) -> float:
    """Return the root mean square of |(r + C n) x n| within a tilt (rad), m: times m g, N m."""
    n, weight = downs(up, tilt)
    return float(np.sqrt(np.sum(weight * np.cross(com + n @ sag, n) ** 2)))
