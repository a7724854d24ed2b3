"""Levenberg-Marquardt on normal equations, for parameters that need not form a vector space.

    (A + lam diag A) step = b,     A = J^T W J,  b = J^T W e,     x <- retract(x, step)

The caller supplies cost, A and b at a point, and walks; this module only gives the next damping
(Nielsen's rule for lam; Madsen, Nielsen and Tingleff 2004, section 3.2) and when to stop. For
residuals in units of their sd, a step that promises to lower twice the cost by c is one of sqrt(c)
standard deviations.
"""

import numpy as np

from equipoise.maths.kernels.compiled import part
from equipoise.model.arrays import Floats

FREE = 1e-2  # damping beyond which a small promise may only say that steps are kept small
NEAR = 100.0  # by how much the promise of a bolder step may exceed the tolerance: 0.1 sd
FIRST, REJECTED, LEAST = 1e-6, 1e-6, 1e-12  # damping: to begin with, after a rejection, ever
GROWTH = 2.0  # of the damping at a first rejection; doubled at each further one
TOLERANCE = 1e-4  # of twice the cost: a hundredth of a standard deviation


@part
def promise(normal: Floats, descent: Floats, step: Floats) -> float:
    """Return by how much a step should lower twice the cost, by the local model."""
    total = 0.0
    for i in range(step.shape[0]):
        row = 0.0
        for j in range(step.shape[0]):
            row += normal[i, j] * step[j]
        total += step[i] * (2.0 * descent[i] - row)
    return total


@part
def judge(
    gained: float, promised: float, damping: float, growth: float
) -> tuple[bool, float, float]:
    """Return whether a trial that lowered twice the cost so much is taken, damping and growth."""
    if not np.isfinite(gained) or gained < 0:
        return False, max(damping, REJECTED) * growth, 2.0 * growth
    trust = gained / promised
    return True, max(damping * max(0.1, 1.0 - (2.0 * trust - 1.0) ** 3), LEAST), GROWTH


@part
def tolerated(cost: float, rows: int) -> float:
    """Return the promise below which a search has arrived: TOLERANCE.

    It grows with a misfit beyond one sd a row, where digits run out and the sd mean less.
    """
    return TOLERANCE * max(1.0, 2.0 * cost / rows)
