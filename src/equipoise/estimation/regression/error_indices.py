"""Error indices of a linear least-squares problem y = H x (Lee Eqs. 9-10).

    x = (H^T H)^-1 H^T y,    SSE = y^T y - y^T H (H^T H)^-1 H^T y = |y - H x|^2
    EI       = sqrt(SSE / y^T y)                                                            (Eq. 9)
    PEI_i    = sqrt(SSE [(H^T H)^-1]_ii)                                                   (Eq. 10)
    relative = sqrt(SSE / (N - p) [(H^T H)^-1]_ii) / |x_i|

H is (N, p). Corrected: Eq. 10 prints (H^T H)^-1 (i) for the element (i, i). PEI is in units of x_i,
so that "much lower than one" says nothing of it, and it grows with the number of rows: it is no
standard error. The last line is that error, over the value.

Raises InputError for rows that are too few, or that do not determine all unknowns.

Cannot see what biases x: noise in H itself, such as that of rates in a regressor. Rows are taken to
err alike and independently; those of running integrals do not.
"""

from dataclasses import dataclass

import numpy as np
import scipy

from equipoise.model.arrays import Floats, Series, Series1
from equipoise.model.errors import InputError


@dataclass(frozen=True, slots=True, eq=False)
class ErrorIndices:
    """How much of the right-hand side is left, and how well each unknown is known."""

    index: float  # EI, of 0 to 1
    parameter: Floats  # (p,) PEI as printed, in units of x
    relative: Floats  # (p,) standard error over the value; infinite for a value of zero


def error_indices(H: Series, y: Series1) -> ErrorIndices:
    """Return EI, PEI and relative standard errors of y = H x."""
    rows, unknowns = H.shape
    if rows <= unknowns:
        raise InputError("H", f"{rows} rows", f"more than its {unknowns} columns")
    if np.linalg.matrix_rank(H) < unknowns or not np.any(y):
        raise InputError("H and y", "dependent columns, or y of zeros", "a problem with one answer")
    Q, upper = np.linalg.qr(H)
    x: Floats = scipy.linalg.solve_triangular(upper, Q.T @ y)
    inverse: Floats = scipy.linalg.solve_triangular(upper, np.eye(unknowns))
    spread: Floats = np.linalg.norm(inverse, axis=1)  # sqrt([(H^T H)^-1]_ii), as H^T H = U^T U
    left = float(np.linalg.norm(y - H @ x))
    with np.errstate(divide="ignore", invalid="ignore"):
        relative = left * spread / np.sqrt(rows - unknowns) / np.abs(x)
    return ErrorIndices(left / float(np.linalg.norm(y)), left * spread, relative)
