"""Ratios: what free motion shows of inertia and centre of mass when their scale is open.

    J_ij / J_top and r_k / J_top, with J_top the largest moment of inertia seen
    sd(a / b) = sd(a - (a / b) b) / b       to first order

Cannot see the scale itself: see ``observability.OPEN``.
"""

import numpy as np

from equipoise.model.arrays import Bools, Floats, Square
from equipoise.model.estimate import COM, INERTIA, Parameter

NAMES = (*INERTIA, *COM)
ORDER = (6, 7, 8, 0, 1, 2, 3, 4, 5)  # of report: centre of mass first


def ratios_of(values: Floats, covariance: Square, hidden: Bools) -> tuple[Parameter, ...]:
    """Return com and J over the largest moment of inertia that is seen, from J xx yy zz xy xz yz, com.

    ``hidden`` are those that the data do not see even when one moment is held; their ratios are
    not seen either.
    """
    top = int(np.argmax(np.where(hidden[:3], 0.0, values[:3]) if not hidden[:3].all() else values[:3]))
    found: list[Parameter] = []
    for k in ORDER:
        if k == top:
            continue
        ratio, gradient = float(values[k] / values[top]), np.zeros(len(values))
        gradient[k], gradient[top] = 1.0, -ratio
        seen = not (hidden[k] or hidden[top])
        square = float(gradient @ covariance @ gradient) if seen else np.inf
        sd, unit = float(np.sqrt(square)) / float(values[top]), "1/(kg m)" if k > 5 else "-"
        found.append(Parameter(f"{NAMES[k]}/{NAMES[top]}", unit, ratio, sd, seen))
    return tuple(found)
