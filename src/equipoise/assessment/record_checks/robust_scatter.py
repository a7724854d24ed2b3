"""The standard deviation of rows from the median of their magnitudes: bad rows hardly count."""

import numpy as np

from equipoise.model.arrays import Floats

ROBUST_SD = 1.4826  # median absolute deviation to sd, for normal scatter


def robust_sd(off: Floats, axis: int = 0) -> Floats:
    """Return the sd of deviations from their middle along an axis."""
    return np.asarray(ROBUST_SD * np.median(np.abs(off), axis=axis), np.float64)
