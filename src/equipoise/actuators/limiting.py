"""Inputs beyond a limit are scaled together, so that their torque keeps its direction.

Limiting each input by itself would turn the torque.
"""

from typing import NamedTuple

import numpy as np

from equipoise.model.arrays import Floats, Vector3


class Delivered(NamedTuple):
    """The inputs of devices, and their torque on the platform."""

    inputs: Floats  # (n,) as ``model.devices`` has them
    torque: Vector3  # N m on the platform, body axes


def scaled(inputs: Floats, most: Floats) -> Floats:
    """Return the inputs times the greatest share up to 1 with which none is beyond ``most``."""
    over = abs(inputs) > most
    if not over.any():
        return inputs
    share = float((most[over] / abs(inputs[over])).min())
    return np.clip(share * inputs, -most, most)  # rounding may not go beyond: a bench would refuse
