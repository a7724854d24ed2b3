"""Solution of small symmetric systems in any units, compiled: L D L^T of the scaled matrix.

    (A + damping diag A) x = b,     S A S + damping E = L D L^T,     S = (diag A)^-1/2

Written out because kernels that search or smooth row by row make no arrays, which LAPACK's would.
"""

import numpy as np

from equipoise.maths.kernels.compiled import kernel, part
from equipoise.model.arrays import Floats, Square


@part
def factorise(normal: Floats, damping: float, scale: Floats, factors: Floats) -> None:
    """Write S with S A S of unit diagonal, and L D L^T = S A S + damping E, D on the diagonal.

    Scaled so, units do not matter. A zero in D is kept: ``solve`` takes no step along it.
    """
    n = normal.shape[0]
    for i in range(n):
        scale[i] = normal[i, i] ** -0.5 if normal[i, i] > 0.0 else 1.0
    for i in range(n):
        for j in range(i):
            total = scale[i] * normal[i, j] * scale[j]
            for k in range(j):
                total -= factors[i, k] * factors[j, k] * factors[k, k]
            factors[i, j] = total / factors[j, j] if factors[j, j] != 0.0 else 0.0
        total = scale[i] * normal[i, i] * scale[i] + damping
        for k in range(i):
            total -= factors[i, k] * factors[i, k] * factors[k, k]
        factors[i, i] = total


@part
def solve(scale: Floats, factors: Floats, right: Floats, out: Floats) -> None:
    """Write the solution of (A + damping diag A) out = right."""
    n = right.shape[0]
    for i in range(n):
        total = scale[i] * right[i]
        for k in range(i):
            total -= factors[i, k] * out[k]
        out[i] = total
    for i in range(n - 1, -1, -1):
        total = out[i] / factors[i, i] if factors[i, i] != 0.0 else 0.0
        for k in range(i + 1, n):
            total -= factors[k, i] * out[k]
        out[i] = total
    for i in range(n):
        out[i] *= scale[i]


@kernel
def scaled_solve(normal: Square, descent: Floats, damping: float) -> Floats:
    """Return the damped step; solved with unit diagonal, so units do not matter."""
    step, scale, factors = np.empty_like(descent), np.empty_like(descent), np.empty_like(normal)
    factorise(normal, damping, scale, factors)
    solve(scale, factors, descent, step)
    return step
