"""Inertia by six free numbers that always give a body which can exist.

    Sigma_C = L L^T,  L = [[e^a1, 0, 0], [b12, e^a2, 0], [b13, b23, e^a3]]
    J_C = tr(Sigma_C) E - Sigma_C

With the mass known, this is the whole of the log-Cholesky form of the pseudo-inertia (Rucker and
Wensing 2022): J > 0 and the triangle inequalities hold for every choice of them.
"""

import numpy as np

from equipoise.model.arrays import Matrix3, Vector6
from equipoise.model.mass_properties import inertia_from_second_moments, second_moments

FLOOR = 1e-6  # chosen: an impossible start is moved to this fraction of its trace


def _factor(six: Vector6) -> Matrix3:
    a1, a2, a3, b12, b13, b23 = six
    return np.array([[np.exp(a1), 0, 0], [b12, np.exp(a2), 0], [b13, b23, np.exp(a3)]])


def to_inertia(six: Vector6) -> Matrix3:
    """Return J_C, kg m^2."""
    factor = _factor(six)
    return inertia_from_second_moments(factor @ factor.T)


def from_inertia(inertia_C: Matrix3) -> Vector6:
    """Return the six numbers of J_C; an impossible one is first moved to the nearest possible."""
    values, vectors = np.linalg.eigh(second_moments(inertia_C))
    size = max(float(np.trace(inertia_C)), float(np.abs(values).sum()), 1e-12)
    values = np.maximum(values, FLOOR * size)
    factor = np.linalg.cholesky((vectors * values) @ vectors.T)
    logs = np.log(np.diag(factor))
    return np.array([*logs, factor[1, 0], factor[2, 0], factor[2, 1]])
