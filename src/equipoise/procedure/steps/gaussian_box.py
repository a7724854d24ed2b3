"""How much of its tolerances an uncertain vector uses up: all of it within them, or not.

    x ~ N(m, P),      use(x) = max_k |x_k| / t_k;      x lies in the box of the t_k where use <= 1

    value    use(m)
    high     97.5 % of x use less: P(x in the box) >= 97.5 % where high <= 1, all axes together
    low      the most that the 95 % interval of one axis uses: max_k (|m_k| - 1.96 sd_k) / t_k
    floor    what ``high`` would be of m = 0: the least that such errors can prove

``low`` is of one axis: of vectors in a corner of the box, up to 2.5 % an axis are found outside.
"""

import numpy as np

from equipoise.maths.gaussian_length import SURE, Bounded, normal_points, root_of
from equipoise.model.arrays import Floats, Matrix3, Vector3
from equipoise.model.estimate import NORMAL_95


def use_of(x: Floats, tolerance: Vector3) -> Floats:
    """Return the largest share of its tolerance that each row of x (n, 3) uses."""
    return np.max(np.abs(x) / tolerance, axis=1)


def drawn(mean: Vector3, covariance: Matrix3) -> Floats:
    """Return what x may be, (n, 3), each row as likely."""
    return mean + normal_points(len(mean)) @ root_of(covariance).T


def probability_inside(mean: Vector3, covariance: Matrix3, tolerance: Vector3) -> float:
    """Return the probability that every axis is within its tolerance."""
    return float(np.mean(use_of(drawn(mean, covariance), tolerance) <= 1))


def bounded_use(mean: Vector3, covariance: Matrix3, tolerance: Vector3) -> Bounded:
    """Return the share of its tolerances that x uses, with its bounds."""
    sd = np.sqrt(np.diag(covariance))
    high, floor = (
        float(np.quantile(use_of(drawn(at, covariance), tolerance), SURE))
        for at in (mean, 0 * mean)
    )
    low = float(np.max((np.abs(mean) - NORMAL_95 * sd) / tolerance))
    return Bounded(float(use_of(mean[None], tolerance)[0]), max(low, 0.0), high, floor)
