"""Directions as a person writes them, made unit vectors."""

import math

import numpy as np

from equipoise.model.arrays import Vector3
from equipoise.model.errors import InputError

AXIS_FLOOR = 1e-6  # chosen: a shorter axis has no direction one could mean
RIGHT_ANGLE = 0.1  # deg, by which a right angle may be off (chosen: axes written to 3 digits)


def unit_vector(axis: list[float], where: str) -> Vector3:
    """Return a direction as a unit vector; zero length is an error."""
    length = math.hypot(*axis)
    if length < AXIS_FLOOR:
        raise InputError(where, f"an axis of length {length:g}", "a direction such as [1, 0, 0]")
    return np.array(axis, float) / length


def square_axis(axis: list[float], to: Vector3, where: str, named: str) -> Vector3:
    """Return an axis, made exactly square to one that is ``named``; it must be nearly so."""
    unit = unit_vector(axis, where)
    square = unit - (unit @ to) * to
    angle = math.degrees(math.atan2(float(np.linalg.norm(square)), float(unit @ to)))
    if abs(angle - 90) > RIGHT_ANGLE:
        wanted = f"a right angle, within {RIGHT_ANGLE:g} deg"
        raise InputError(where, f"an axis at {angle:.4g} deg to the {named}", wanted)
    return square / np.linalg.norm(square)
