"""Classical Levenberg-Marquardt (da Silva 2021 section 3.1.4), between Gauss-Newton and gradient.

    (A^T A + lam diag A^T A) dx = A^T (b - A x)

from the testbed's guess; lam falls by ten after a step that lowers the cost and grows by ten after
one that does not. For rows that are linear in x this ends where least squares are, and takes longer
to get there: it matters only with constraints, or where the motion itself is fitted.
"""

import numpy as np

from equipoise.estimation.regression.formulations.rows import Rows, centred, guess_of
from equipoise.estimation.regression.solvers.least_squares import Aid, normal_of
from equipoise.maths.scaled_solve import scaled_solve
from equipoise.model.arrays import Floats

FIRST, FASTER, ROUNDS = 1e-2, 10.0, 60
SETTLED = 1e-13  # of the cost at x = 0


def damped(rows: Rows, aid: Aid) -> Floats:
    """Return the solution."""
    rows = centred(rows)
    normal, right = normal_of(rows)
    square = float(np.sum(rows.b**2))
    x = guess_of(rows, aid.testbed)

    def cost(at: Floats) -> float:
        return float(at @ (normal @ at - 2 * right)) + square

    damping = FIRST
    for _ in range(ROUNDS):
        step = scaled_solve(normal, right - normal @ x, damping)
        gained = cost(x) - cost(x + step)
        x, damping = (x + step, damping / FASTER) if gained > 0 else (x, damping * FASTER)
        if abs(gained) <= SETTLED * square:
            break
    return x
