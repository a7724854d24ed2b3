"""Copies of arrays in kernels, element by element.

``out[:] = values`` would have the compiler prepare a message about shapes that do not fit, which
takes it seconds.
"""

from equipoise.maths.kernels.compiled import part
from equipoise.model.arrays import Floats


@part
def copy_values(source: Floats, out: Floats) -> None:
    """Write a vector into another."""
    for i in range(source.shape[0]):
        out[i] = source[i]


@part
def copy_rows(source: Floats, out: Floats) -> None:
    """Write a matrix into another, at its first rows and columns."""
    for i in range(source.shape[0]):
        for j in range(source.shape[1]):
            out[i, j] = source[i, j]
