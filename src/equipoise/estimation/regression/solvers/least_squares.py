"""Ordinary least squares (da Silva 2021 Eq. 17): x = (A^T A)^-1 A^T b, each equation alike.

Noise in A biases x towards zero: see ``corrected`` and ``instrumental``.
"""

from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from equipoise.estimation.regression.formulations.rows import Rows, centred
from equipoise.maths.scaled_solve import scaled_solve
from equipoise.model.arrays import Floats, Square
from equipoise.model.testbed import Testbed

RIDGE = 1e-14  # of a scaled normal matrix: rounding


class Aid(NamedTuple):
    """What a solver may use beside the rows: the testbed, and the noise of the rows."""

    testbed: Testbed
    gram: Square  # (c, c) mean of dA^T dA, dA being what the sensors' noise adds to centred rows
    cross: Floats  # (c,) mean of dA^T db


Solver = Callable[[Rows, Aid], Floats]


def flat(rows: Rows) -> tuple[Floats, Floats]:
    """Return A (n m, c) and b (n m)."""
    return rows.A.reshape(-1, rows.A.shape[2]), rows.b.reshape(-1)


def normal_of(rows: Rows) -> tuple[Square, Floats]:
    """Return A^T A and A^T b."""
    A, b = flat(rows)
    return A.T @ A, A.T @ b


def solved(normal: Square, right: Floats) -> Floats:
    """Return the solution of normal equations in any units."""
    return scaled_solve(np.ascontiguousarray(normal), np.ascontiguousarray(right), RIDGE)


def least_squares(rows: Rows, aid: Aid) -> Floats:
    """Return the solution."""
    return solved(*normal_of(centred(rows)))
