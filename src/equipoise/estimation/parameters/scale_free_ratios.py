"""Ratios: what free motion shows of inertia and centre of mass when their scale is open.

    J_ij / J_top and r_k / J_top, with J_top the largest observable moment of inertia
    sd(a / b) = sd(a - (a / b) b) / b       to first order

Cannot see the scale itself: see ``observability.OPEN``. A ratio that changes along an
unobservable direction other than the scale is unobservable, too.
"""

import numpy as np

from equipoise.estimation.parameters.observability import PART
from equipoise.model.arrays import Floats, Square
from equipoise.model.estimate import BODY, Parameter

ORDER = (6, 7, 8, 0, 1, 2, 3, 4, 5)  # of report: centre of mass first


def largest_observable(values: Floats, unseen: Floats) -> int:
    """Return the largest moment of inertia without part in unseen directions, if there is one."""
    moments = values[:3] * ~np.any(np.abs(unseen[:3]) > PART * values[:3, None], axis=1)
    return int(np.argmax(moments if moments.any() else values[:3]))


def ratios_of(values: Floats, covariance: Square, unseen: Floats) -> tuple[Parameter, ...]:
    """Return com and J over the largest moment of inertia, from J xx yy zz xy xz yz, com.

    ``unseen`` are the directions (9, u) that the data do not see, but for the scale, of natural
    size.
    """
    top = largest_observable(values, unseen)
    size = np.append(np.full(6, values[top]), np.full(3, np.linalg.norm(values[6:])))
    found: list[Parameter] = []
    for k in ORDER:
        if k == top:
            continue
        ratio, gradient = float(values[k] / values[top]), np.zeros(len(values))
        gradient[k], gradient[top] = 1.0, -ratio
        sd = float(np.sqrt(gradient @ covariance @ gradient)) / float(values[top])
        observed = not np.any(np.abs(gradient @ unseen) > PART * size[k])
        unit = "1/(kg m)" if k > 5 else "-"
        name = f"{BODY[k]}/{BODY[top]}"
        found.append(Parameter(name, unit, ratio, sd if observed else np.inf, bool(observed)))
    return tuple(found)
