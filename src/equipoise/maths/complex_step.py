"""Jacobians of analytic functions by a complex step.

    df/dx_k = Im f(x + i h e_k) / h,        h = 1e-30

No difference of two values is taken, so no digit is lost (Squire and Trapp 1998). ``f`` consists of
analytic operations alone: a length is the root of a product, never an absolute value.
"""

from collections.abc import Callable

import numpy as np

from equipoise.model.arrays import Complexes, Floats

STEP = 1e-30  # chosen: its square vanishes beside any number of a bench


def jacobian(function: Callable[[Complexes], Complexes], at: Floats) -> Floats:
    """Return df/dx (m, n) of a function from n numbers to m."""
    steps = at + 1j * STEP * np.eye(len(at))
    return np.column_stack([np.imag(function(each)) / STEP for each in steps])
