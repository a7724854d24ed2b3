"""From a sensor's axes and laboratory frame to ours, and back.

    w_B = S w_S        R(q_BN) = L R(q) S^T

S: sensor to body (``SensorUnit.alignment``). L: the sensor's laboratory to ours, Z up:

    z_up   none
    ned    north-east-down to north-west-up: half a turn about north
    y_up   Y up, as motion capture has it, to Z up: a quarter turn about X
"""

import math
from functools import lru_cache

import numpy as np

from equipoise.maths.attitude import conjugate, from_matrix, multiply
from equipoise.model.arrays import Floats, Quaternion
from equipoise.model.hardware import Gives, Laboratory, SensorUnit

HALF = math.sqrt(0.5)
TO_OURS: dict[Laboratory, tuple[float, float, float, float]] = {
    "z_up": (1.0, 0.0, 0.0, 0.0),
    "ned": (0.0, 1.0, 0.0, 0.0),
    "y_up": (HALF, HALF, 0.0, 0.0),
}


def placed(unit: SensorUnit, channel: Gives, values: Floats) -> Floats:
    """Return a row (or rows) of a sensor in our frames."""
    if channel == "rate":
        return values @ unit.alignment.T
    return multiply(multiply(_laboratory(unit), values), conjugate(_aligned(unit)))


def as_sensed(unit: SensorUnit, channel: Gives, values: Floats) -> Floats:
    """Return what a sensor says for a row (or rows) in our frames: the way back."""
    if channel == "rate":
        return values @ unit.alignment
    return multiply(multiply(conjugate(_laboratory(unit)), values), _aligned(unit))


@lru_cache(maxsize=64)  # by the unit itself: asked for each row
def _laboratory(unit: SensorUnit) -> Quaternion:
    return np.array(TO_OURS[unit.laboratory])


@lru_cache(maxsize=64)
def _aligned(unit: SensorUnit) -> Quaternion:
    return from_matrix(unit.alignment)
