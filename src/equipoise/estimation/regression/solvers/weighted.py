"""Weighted least squares: equations that err more count less, and those that err together as one.

    x = (A^T W A)^-1 A^T W b,        W = S^-1,   S = covariance of what least squares leave of a row

S (m, m) is that of one time: axes of a body with unequal moments, and laboratory axes of a body
that turns, err unequally. S is estimated; a floor keeps W finite.
"""

from dataclasses import replace

import numpy as np

from equipoise.estimation.regression.formulations.rows import Rows, centred
from equipoise.estimation.regression.solvers.least_squares import Aid, normal_of, solved
from equipoise.maths.linalg import symmetrise
from equipoise.model.arrays import Floats

FLOOR = 1e-6  # of the largest eigenvalue of S


def whitened(rows: Rows, left: Floats) -> Rows:
    """Return rows that err alike in every equation, from what is left of them."""
    S = symmetrise(left.T @ left / len(left))
    values, turn = np.linalg.eigh(S)
    values = np.maximum(values, FLOOR * max(float(values[-1]), 1e-300))
    root = (turn / np.sqrt(values / values.mean())) @ turn.T
    return replace(rows, A=root @ rows.A, b=rows.b @ root)


def weighted(rows: Rows, aid: Aid) -> Floats:
    """Return the solution."""
    rows = centred(rows)
    left = rows.b - rows.A @ solved(*normal_of(rows))
    return solved(*normal_of(whitened(rows, left)))
