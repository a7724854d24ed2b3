"""Two axes across a direction of the body, nearest to the axes of the body."""

import numpy as np

from equipoise.model.arrays import Series, Vector3


def axes_across(direction: Vector3) -> Series:
    """Return two unit vectors across a unit vector, as rows, right-handed with it; x, y for z."""
    nearest: Vector3 = np.eye(3)[int(np.argmin(np.abs(direction) + [0.0, 1e-9, 2e-9]))]
    first: Vector3 = nearest - direction * float(direction @ nearest)
    first = first / float(np.linalg.norm(first))
    second: Vector3 = np.cross(direction, first)
    return np.vstack([first, second])
