"""Inertia by six free numbers that always give a body which can exist.

    Sigma_C = L L^T,  L = [[e^a1, 0, 0], [b12, e^a2, 0], [b13, b23, e^a3]]
    J_C = tr(Sigma_C) E - Sigma_C

With the mass known, this is the whole of the log-Cholesky form of the pseudo-inertia (Rucker and
Wensing 2022): J > 0 and the triangle inequalities hold for every choice of them.

Symmetric matrices are tuples here, xx yy zz xy xz yz, and the six numbers come in the order
a1 a2 a3 b12 b13 b23.
"""

import numpy as np

from equipoise.maths.eigen import eigen
from equipoise.maths.kernels.compiled import kernel, part
from equipoise.model.arrays import Floats, Matrix3, Six, Vector6

FLOOR = 1e-6  # chosen: an impossible start is moved to this fraction of its trace


@part
def second_moments_of(J: Six) -> Six:
    """Return Sigma = 1/2 tr(J) E - J."""
    half = 0.5 * (J[0] + J[1] + J[2])
    return (half - J[0], half - J[1], half - J[2], -J[3], -J[4], -J[5])


@part
def exceeds(sigma: Six, floor: float) -> bool:
    """Say whether every eigenvalue of a symmetric matrix is greater than ``floor``.

    By its leading minors (Sylvester), which is all that the common case needs.
    """
    a, b, c, d, e, f = sigma
    a, b, c = a - floor, b - floor, c - floor
    second = a * b - d * d
    return a > 0 and second > 0 and c * second - a * f * f - b * e * e + 2 * d * e * f > 0


@part
def inertia_of(six: Six) -> Six:
    """Return J_C of the six numbers."""
    a, b, c = np.exp(six[0]), np.exp(six[1]), np.exp(six[2])
    d, e, f = six[3], six[4], six[5]
    xx, yy, zz = a * a, d * d + b * b, e * e + f * f + c * c
    return (yy + zz, xx + zz, xx + yy, -a * d, -a * e, -(d * e + b * f))


@part
def raised(sigma: Six, trace: float) -> Six:
    """Return Sigma with eigenvalues below the floor raised to it; ``trace`` is that of J."""
    values, (u, v, w) = eigen(sigma)
    size = max(trace, abs(values[0]) + abs(values[1]) + abs(values[2]), 1e-12)
    p, q, r = (max(values[0], FLOOR * size), max(values[1], FLOOR * size),
               max(values[2], FLOOR * size))  # fmt: skip
    return (
        p * u[0] * u[0] + q * v[0] * v[0] + r * w[0] * w[0],
        p * u[1] * u[1] + q * v[1] * v[1] + r * w[1] * w[1],
        p * u[2] * u[2] + q * v[2] * v[2] + r * w[2] * w[2],
        p * u[0] * u[1] + q * v[0] * v[1] + r * w[0] * w[1],
        p * u[0] * u[2] + q * v[0] * v[2] + r * w[0] * w[2],
        p * u[1] * u[2] + q * v[1] * v[2] + r * w[1] * w[2],
    )


@part
def six_of(J: Six) -> Six:
    """Return the six numbers of J_C; an impossible one is first moved to the nearest possible."""
    trace = J[0] + J[1] + J[2]
    sigma = second_moments_of(J)
    if not exceeds(sigma, FLOOR * trace):
        sigma = raised(sigma, trace)
    xx, yy, zz, xy, xz, yz = sigma
    a = xx**0.5
    d, e = xy / a, xz / a
    b = (yy - d * d) ** 0.5
    f = (yz - d * e) / b
    c = (zz - e * e - f * f) ** 0.5
    return (np.log(a), np.log(b), np.log(c), d, e, f)


@kernel
def to_inertia(six: Vector6) -> Matrix3:
    """Return J_C, kg m^2, as a matrix."""
    xx, yy, zz, xy, xz, yz = inertia_of((six[0], six[1], six[2], six[3], six[4], six[5]))
    return np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])


@kernel
def slope_of_inertia(six: Vector6) -> Floats:
    """Return dJ_C / d(six), (6, 6): rows xx yy zz xy xz yz, columns a1 a2 a3 b12 b13 b23."""
    a, b, c = np.exp(six[0]), np.exp(six[1]), np.exp(six[2])
    d, e, f = six[3], six[4], six[5]
    xx, yy, zz = 2 * a * a, 2 * b * b, 2 * c * c
    return np.array([
        [0.0, yy, zz, 2 * d, 2 * e, 2 * f],
        [xx, 0.0, zz, 0.0, 2 * e, 2 * f],
        [xx, yy, 0.0, 2 * d, 0.0, 0.0],
        [-a * d, 0.0, 0.0, -a, 0.0, 0.0],
        [-a * e, 0.0, 0.0, 0.0, -a, 0.0],
        [0.0, -b * f, 0.0, -e, -d, -b],
    ])  # fmt: skip


@kernel
def from_inertia(inertia_C: Matrix3) -> Vector6:
    """Return the six numbers of a matrix J_C, or of the nearest possible one."""
    J = inertia_C
    return np.array(six_of((J[0, 0], J[1, 1], J[2, 2], J[0, 1], J[0, 2], J[1, 2])))
