"""Turning a table's axes into ours: relabelled body axes, a laboratory whose up is not Z."""

import math

import numpy as np

from equipoise.model.arrays import Matrix3

HALF = math.sqrt(0.5)
# The shortest turn of the laboratory that brings the named axis up to Z; for -z, about x.
TO_Z_UP: dict[str, tuple[float, float, float, float]] = {
    "z": (1.0, 0.0, 0.0, 0.0),
    "y": (HALF, HALF, 0.0, 0.0),
    "-y": (HALF, -HALF, 0.0, 0.0),
    "x": (HALF, 0.0, -HALF, 0.0),
    "-x": (HALF, 0.0, HALF, 0.0),
    "-z": (0.0, 1.0, 0.0, 0.0),
}


def axes_matrix(axes: tuple[str, str, str]) -> Matrix3:
    """Return S with ``v_ours = S v_table``, for our axes named in terms of the table's."""
    rows = np.zeros((3, 3))
    for row, axis in enumerate(axes):
        rows[row, "xyz".index(axis[-1])] = -1.0 if axis.startswith("-") else 1.0
    return rows
