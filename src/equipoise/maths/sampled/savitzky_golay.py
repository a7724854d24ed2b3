"""The slope of a polynomial through neighbouring rows, in their middle (Savitzky and Golay 1964).

    w = e_1^T (P^T P)^-1 P^T / (h T),     P_jk = s_j^k,     s_j = (j - (n - 1) / 2) / h

with n rows a period T apart and h = n / 2, so that |s| < 1. The slope is w @ rows.

SciPy has the same weights, in a package that takes nearly half a second to import (decision 0034).
"""

import numpy as np

from equipoise.model.arrays import Series1


def slope_weights(rows: int, degree: int, period: float) -> Series1:
    """Return the weights (rows,) of the slope, 1/s; ``rows`` exceeds ``degree``, ``period`` in s.

    An even number of rows has its middle between two of them.
    """
    half = 0.5 * rows
    s = (np.arange(rows) - 0.5 * (rows - 1)) / half
    weights: Series1 = np.linalg.pinv(np.vander(s, degree + 1, increasing=True))[1]
    return weights / (half * period)
