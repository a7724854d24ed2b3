"""Whether a recording, or a reading of a table, is a motion that is known.

    R_read = L R_true S^T        S: axes of the body by other names, L: the same of the laboratory

Of S only what nobody can know may differ: which level axis of the body is called x. L may turn the
heading. Rates are compared in the axes that S names.
"""

from itertools import permutations, product

import numpy as np

from equipoise.maths.attitude import to_matrix
from equipoise.model.arrays import Floats, Matrix3, Series3, Series4

UP = np.array([0.0, 0.0, 1.0])
EYE = np.eye(3)


def proper_axes() -> list[Matrix3]:
    """Return the 24 rotations that call axes of a frame by other names."""
    signed = [
        EYE[list(order)] * np.array(signs)[:, None]
        for order in permutations(range(3))
        for signs in product((1.0, -1.0), repeat=3)
    ]
    return [axes for axes in signed if np.linalg.det(axes) > 0]


RENAMED = proper_axes()
LEVEL = [axes for axes in RENAMED if np.array_equal(axes @ UP, UP)]  # z stays


def turn_between(read: Series4, true: Series4, axes: Matrix3) -> Series3:
    """Return L of each row, (n, 3, 3)."""
    return to_matrix(read) @ axes @ np.swapaxes(to_matrix(true), 1, 2)


def departure(turns: Series3) -> float:
    """Return by how much L changes, rad: its largest angle from the one in the middle."""
    middle = turns[len(turns) // 2]
    chord = np.linalg.norm(turns - middle, axis=(1, 2)).max()
    return float(2 * np.arcsin(min(1.0, chord / np.sqrt(8.0))))


def axes_of(
    read: Series4, true: Series4, within: float, allowed: list[Matrix3], up: Floats = UP
) -> list[tuple[Matrix3, Matrix3]]:
    """Return S and L of the names under which attitudes are the same, within an angle (rad).

    ``up`` is the vertical of the laboratory as it was read.
    """
    found: list[tuple[Matrix3, Matrix3]] = []
    for axes in allowed:
        turns = turn_between(read, true, axes)
        middle = turns[len(turns) // 2]
        upright = float(np.arccos(np.clip(up @ middle @ UP, -1.0, 1.0)))
        if departure(turns) <= 2 * within and upright <= 2 * within + 1e-7:
            found.append((axes, middle))
    return found
