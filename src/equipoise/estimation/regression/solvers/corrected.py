"""Least squares without the bias of noisy regressors (errors in variables).

A = A* + dA with noise dA makes A^T A too large by the mean of dA^T dA, and A^T b by that of
dA^T db. Both follow from the sensors' stated noise (``Aid``), and are taken off:

    x = (A^T A - E[dA^T dA])^-1 (A^T b - E[dA^T db])             (Fuller 1987, section 2.2)

Trusts the stated noise of the sensors: twice the noise is four times the correction.
"""

import numpy as np

from equipoise.estimation.regression.formulations.rows import Rows, centred
from equipoise.estimation.regression.solvers.least_squares import Aid, normal_of, solved
from equipoise.model.arrays import Floats

LEAST = 0.05  # of A^T A, scaled: along directions that are mostly noise no more is taken off


def corrected(rows: Rows, aid: Aid) -> Floats:
    """Return the solution."""
    normal, right = normal_of(centred(rows))
    scale = 1 / np.sqrt(np.maximum(np.diag(normal), 1e-300))
    values, turn = np.linalg.eigh((normal - aid.gram) * np.outer(scale, scale))
    whole = np.einsum("ij,jk,ki->i", turn.T, normal * np.outer(scale, scale), turn)
    kept = (turn * np.maximum(values, LEAST * whole)) @ turn.T
    return solved(kept / np.outer(scale, scale), right - aid.cross)
