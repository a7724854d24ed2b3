"""The uncertainty of the requested parameters as one number, the less the better.

    A    1/2 ln mean_i (sd_i / size_i)^2        the average
    D    1/2n ln det(D C D), D = 1 / size       the volume

Sizes are errors of equal weight: 1 % of a moment (of the geometric mean of two for a product), and
1 um of the centre of mass.

A reduces the worst parameter first; D does not depend on the sizes, and may leave one parameter
uncertain for the sake of the rest.
"""

from typing import Literal

import numpy as np

from equipoise.maths.linalg import element_sizes
from equipoise.model.arrays import Floats, Square
from equipoise.model.estimate import BODY, COM, INERTIA
from equipoise.model.mass_properties import MassProperties

Criterion = Literal["A", "D"]
Quantity = Literal["J", "r", "both"]
NAMES: dict[Quantity, tuple[str, ...]] = {"J": INERTIA, "r": COM, "both": BODY}
OF_MOMENT, OF_COM = 0.01, 1e-6  # -, m, chosen: as laboratories require


def size_of(body: MassProperties, names: tuple[str, ...]) -> Floats:
    """Return the sizes of elements of inertia and centre of mass, SI."""
    sizes = np.append(OF_MOMENT * element_sizes(body.inertia_P), np.full(3, OF_COM))
    known = dict(zip(BODY, sizes, strict=True))
    return np.array([known[name] for name in names])


def score(covariance: Square, size: Floats, criterion: Criterion) -> float:
    """Return the criterion of a covariance (SI)."""
    scaled = covariance / np.outer(size, size)
    if criterion == "A":
        return 0.5 * float(np.log(np.mean(np.diag(scaled))))
    return 0.5 * float(np.linalg.slogdet(scaled)[1]) / len(size)
