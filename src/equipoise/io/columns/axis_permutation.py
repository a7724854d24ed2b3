"""Turning a table's axes into ours: relabelled body axes, a laboratory whose up is not Z."""

import math
from collections.abc import Sequence

import numpy as np

from equipoise.model.arrays import Matrix3
from equipoise.model.errors import InputError

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


def checked_axes(
    axes: Sequence[str], where: str, right_handed: bool = True
) -> tuple[str, str, str]:
    """Return three axes that make a frame; InputError for others."""
    x, y, z = axes
    handed = float(np.linalg.det(axes_matrix((x, y, z))))
    if not np.isclose(handed if right_handed else abs(handed), 1.0):
        frame = " that make a right-handed frame" if right_handed else ""
        raise InputError(where, f"{[*axes]}", f"three different axes{frame}")
    return x, y, z


def axes_matrix(axes: tuple[str, str, str]) -> Matrix3:
    """Return S with ``v_ours = S v_table``, for our axes named in terms of the table's."""
    rows = np.zeros((3, 3))
    for row, axis in enumerate(axes):
        rows[row, "xyz".index(axis[-1])] = -1.0 if axis.startswith("-") else 1.0
    return rows
