"""Four gyros on the sides of a pyramid of skew b.

h_1 lies along +y at angle zero, each further gyro a quarter turn about +z on:

    g_1 = (sin b, 0, cos b),  s0_1 = (0, 1, 0)
"""

from dataclasses import replace

import numpy as np

from equipoise.model.devices import ControlMomentGyro
from equipoise.model.testbed import Testbed


def pyramid(skew: float, momentum: float, max_rate: float) -> tuple[ControlMomentGyro, ...]:
    """Return four gyros on the sides of a pyramid of that skew (rad), at angle zero."""
    c, s = float(np.cos(skew)), float(np.sin(skew))
    turned = np.array([[1.0, 0.0], [0.0, 1.0], [-1.0, 0.0], [0.0, -1.0]])  # quarters about +z
    return tuple(
        ControlMomentGyro(
            f"cmg_{i + 1}", np.array([s * x, s * y, c]), np.array([-y, x, 0.0]), momentum, max_rate
        )
        for i, (x, y) in enumerate(turned)
    )


def with_light_gimbals(testbed: Testbed) -> Testbed:
    """Return a testbed whose gimbals store no momentum of their own."""
    light = tuple(replace(cmg, gimbal_inertia=0.0) for cmg in testbed.cmgs)
    return replace(testbed, cmgs=light)
