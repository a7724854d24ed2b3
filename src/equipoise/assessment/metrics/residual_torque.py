"""What a centre of mass off the pivot does to a platform: torque when level, and swing.

    |tau| = m g |r_h|                 r_h: the horizontal part of r when level
    T                                 of the slow swing of ``swing_modes``, m g h with h = -r.up > 0

The torque is what attitude actuators have to hold against; at a small tilt it grows by m g h sin.
The period is that of the slowest small swing; without h > 0 it topples instead.
"""

from typing import NamedTuple

import numpy as np

from equipoise.assessment.metrics.swing_modes import swing_rates
from equipoise.model.arrays import Matrix3, Vector3


class Uncertain(NamedTuple):
    """A number and its sd, to first order."""

    value: float
    sd: float


def level_torque(weight: float, com: Vector3, sd: Vector3, up: Vector3) -> Uncertain:
    """Return the gravity torque (N m) on the level platform; ``weight`` is m g in N."""
    across = com - (com @ up) * up
    size = float(np.linalg.norm(across))
    if size == 0:
        return Uncertain(0.0, weight * float(np.linalg.norm(sd)))
    counts = across != 0  # along up an sd may be infinite, and adds nothing
    return Uncertain(
        weight * size, weight * float(np.linalg.norm(across[counts] / size * sd[counts]))
    )


def swing_period(
    weight: float, com: Vector3, sd: Vector3, inertia_P: Matrix3, up: Vector3
) -> Uncertain:
    """Return the longest period (s) of a small swing; infinite when P is not above the centre."""
    height = -float(com @ up)
    if height <= 0:
        return Uncertain(np.inf, np.inf)
    period = 2 * np.pi / float(swing_rates(weight * height, inertia_P, -up)[0])
    counts = up != 0  # across up an sd may be infinite, and adds nothing
    return Uncertain(period, period / 2 * float(np.linalg.norm(sd[counts] * up[counts])) / height)


def with_doubtful_inertia(period: Uncertain, inertia_sd: float) -> Uncertain:
    """Return a period of swing whose inertia has a relative sd.

    T goes with sqrt(J / r), so half of it adds to the sd. J and r count as independent, which is
    too wide where one fit estimated both.
    """
    return Uncertain(period.value, float(np.hypot(period.sd, period.value / 2 * inertia_sd)))
