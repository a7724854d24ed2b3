"""Attitudes as devices send them, to unit quaternions, scalar first."""

import math
from collections.abc import Sequence

Row = tuple[float, ...]


def from_angles(yaw: float, pitch: float, roll: float) -> Row:
    """Return the quaternion of angles (deg): first yaw about z, then pitch about y, then roll."""
    halves = (math.radians(angle) / 2 for angle in (yaw, pitch, roll))
    (cy, sy), (cp, sp), (cr, sr) = ((math.cos(half), math.sin(half)) for half in halves)
    return (
        cr * cp * cy + sr * sp * sy,
        sr * cp * cy - cr * sp * sy,
        cr * sp * cy + sr * cp * sy,
        cr * cp * sy - sr * sp * cy,
    )


def unit_row(row: Sequence[float], within: float) -> Row | None:
    """Return a quaternion made exactly of length one; None if it is not nearly so."""
    length = math.hypot(*row)
    if not abs(length - 1) <= within:  # also false for a length that is no number
        return None
    return tuple(value / length for value in row)
