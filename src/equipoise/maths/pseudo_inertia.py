"""Inertia by six free numbers that always give a body which can exist.

    Sigma_C = L L^T,  L = [[e^a1, 0, 0], [b12, e^a2, 0], [b13, b23, e^a3]]
    J_C = tr(Sigma_C) E - Sigma_C

With the mass known, this is the whole of the log-Cholesky form of the pseudo-inertia (Rucker and
Wensing 2022): J > 0 and the triangle inequalities hold for every choice of them.
"""

import numpy as np

from equipoise.model.arrays import Matrix3, Vector6
from equipoise.model.mass_properties import EYE, inertia_from_second_moments, second_moments

FLOOR = 1e-6  # chosen: an impossible start is moved to this fraction of its trace


def _factor(six: Vector6) -> Matrix3:
    a1, a2, a3, b12, b13, b23 = six
    return np.array([[np.exp(a1), 0, 0], [b12, np.exp(a2), 0], [b13, b23, np.exp(a3)]])


def exceeds(sigma: Matrix3, floor: float) -> bool:
    """Say whether every eigenvalue of a symmetric matrix is greater than ``floor``.

    By its leading minors (Sylvester), which is all that the common case needs.
    """
    (a, d, e), (_, b, f), (_, _, c) = (sigma - floor * EYE).tolist()
    second = a * b - d * d
    return a > 0 and second > 0 and c * second - a * f * f - b * e * e + 2 * d * e * f > 0


def to_inertia(six: Vector6) -> Matrix3:
    """Return J_C, kg m^2."""
    factor = _factor(six)
    return inertia_from_second_moments(factor @ factor.T)


def from_inertia(inertia_C: Matrix3) -> Vector6:
    """Return the six numbers of J_C; an impossible one is first moved to the nearest possible."""
    sigma = second_moments(inertia_C)
    if not exceeds(sigma, FLOOR * float(np.trace(inertia_C))):
        values, vectors = np.linalg.eigh(sigma)
        size = max(float(np.trace(inertia_C)), float(np.abs(values).sum()), 1e-12)
        sigma = (vectors * np.maximum(values, FLOOR * size)) @ vectors.T
    factor = np.linalg.cholesky(sigma)
    logs = np.log(np.diag(factor))
    return np.array([*logs, factor[1, 0], factor[2, 0], factor[2, 1]])
