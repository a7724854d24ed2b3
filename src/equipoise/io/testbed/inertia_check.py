"""Whether some body can have a given inertia, and if not, which law it breaks.

A body's inertia is symmetric, its principal moments are positive, and about the centre of mass
each is less than the sum of the other two (equal for a flat plate without thickness).
"""

import numpy as np

from equipoise.model.arrays import Matrix3
from equipoise.model.errors import InputError
from equipoise.model.mass_properties import smallest_second_moment

SYMMETRY = 1e-9  # relative; chosen: far above rounding, far below any digit a person writes


def check_inertia(inertia: Matrix3, where: str) -> None:
    """Raise InputError naming the broken law with its numbers (kg m^2)."""
    _check_symmetry(inertia, where)
    low, middle, high = np.linalg.eigvalsh(inertia)
    if low <= 0:
        found = f"an impossible inertia with the principal moment {low:.4g} kg m2"
        raise InputError(where, found, "positive principal moments")
    if smallest_second_moment(inertia) <= 0:
        found = (
            f"an impossible inertia: its principal moments break {high:.4g} < "
            f"{low:.4g} + {middle:.4g} = {low + middle:.4g} kg m2"
        )
        raise InputError(where, found, "each principal moment below the sum of the other two")


def _check_symmetry(inertia: Matrix3, where: str) -> None:
    gap = np.abs(inertia - inertia.T)
    if gap.max() > SYMMETRY * np.abs(inertia).max():
        i, j = np.unravel_index(int(gap.argmax()), gap.shape)
        found = (
            f"row {i + 1}, column {j + 1} = {inertia[i, j]:g} but "
            f"row {j + 1}, column {i + 1} = {inertia[j, i]:g}"
        )
        raise InputError(where, found, "a symmetric matrix")
