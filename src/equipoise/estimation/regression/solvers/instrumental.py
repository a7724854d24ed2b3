"""Instrumental variables: columns Z that see the same motion with other noise.

    x = (Z^T A)^-1 Z^T b,        E[Z^T dA] = 0,  E[Z^T db] = 0        (Reiersol 1945; Young 2011)

Noise in A then does not bias x, however large it is, nor need it be known; the price is variance.
"""

import numpy as np

from equipoise.estimation.regression.formulations.rows import Rows, centred
from equipoise.estimation.regression.solvers.least_squares import Aid
from equipoise.model.arrays import Floats, Square


def instrumental(rows: Rows, aid: Aid) -> Floats:
    """Return the solution."""
    rows = centred(rows)
    assert rows.instruments is not None
    c = len(rows.names)
    Z, A = rows.instruments.reshape(-1, c), rows.A.reshape(-1, c)
    scale = 1 / np.sqrt(np.maximum(np.sum(Z * Z, axis=0), 1e-300))
    matrix: Square = (Z * scale).T @ (A * scale) + 1e-14 * np.eye(c)
    right: Floats = (Z * scale).T @ rows.b.reshape(-1)
    return scale * np.asarray(np.linalg.solve(matrix, right), dtype=np.float64)
