"""Ratios: what free motion shows of inertia and centre of mass when their scale is open.

    J_ij / J_top and r_k / J_top, with J_top the largest moment of inertia
    sd(a / b) = sd(a - (a / b) b) / b       to first order

Cannot see the scale itself: see ``observability.OPEN``.
"""

import numpy as np

from equipoise.model.arrays import Floats, Square
from equipoise.model.estimate import COM, INERTIA, Parameter

NAMES = (*INERTIA, *COM)
ORDER = (6, 7, 8, 0, 1, 2, 3, 4, 5)  # of report: centre of mass first


def ratios_of(values: Floats, covariance: Square) -> tuple[Parameter, ...]:
    """Return com and J over the largest moment of inertia, from J xx yy zz xy xz yz, com."""
    top = int(np.argmax(values[:3]))
    found: list[Parameter] = []
    for k in ORDER:
        if k == top:
            continue
        ratio, gradient = float(values[k] / values[top]), np.zeros(len(values))
        gradient[k], gradient[top] = 1.0, -ratio
        sd = float(np.sqrt(gradient @ covariance @ gradient)) / float(values[top])
        unit = "1/(kg m)" if k > 5 else "-"
        found.append(Parameter(f"{NAMES[k]}/{NAMES[top]}", unit, ratio, sd))
    return tuple(found)
