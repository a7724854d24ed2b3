"""Bounds from a testbed's nominal values, for loops that level it: offsets, moments, steps.

With P = E - up up^T and J about P, masses at home, LIKELY sd to be safe:

    offset   |P com| + LIKELY |P com_sd|        height   up.com + LIKELY |up_i com_sd_i|
    moment   tr(P J) / 2                        step     max of m_i resolution_i / m
"""

import numpy as np

from equipoise.control.plant.actuator_limits import greatest_shift, greatest_slew
from equipoise.maths.linalg import skew
from equipoise.model.arrays import Floats, Matrix3, Vector3
from equipoise.model.errors import InputError
from equipoise.model.testbed import Testbed
from equipoise.model.units import UM

LIKELY = 2.0  # sd, chosen: few offsets exceed it
MOST = 1.0  # rad/s, chosen: above it a gyro's noise moves the masses more than the tilt does
SAMPLED = 0.2  # rad, chosen: frequency times period, of at most 1


def across(up: Vector3) -> Matrix3:
    """Return the projection across ``up``: E - up up^T."""
    return np.eye(3) - np.outer(up, up)


def around(up: Vector3) -> Floats:
    """Return two unit vectors (2, 3) across ``up``; the three are right-handed."""
    first = skew(up) @ np.eye(3)[int(np.argmin(np.abs(up)))]
    first = first / float(np.linalg.norm(first))
    return np.array([first, skew(up) @ first])


def likely_offset(testbed: Testbed) -> float:
    """Return the likely sideways offset (m) of the centre of mass, masses at home."""
    P = across(testbed.up)
    return float(np.linalg.norm(P @ testbed.body.com) + LIKELY * np.linalg.norm(P @ testbed.com_sd))


def height_sd(testbed: Testbed) -> float:
    """Return one sd (m) of the height of the centre of mass."""
    return float(np.linalg.norm(testbed.up * testbed.com_sd))


def likely_height(testbed: Testbed) -> float:
    """Return the likely height (m) of the centre of mass above P, masses at home."""
    return float(testbed.up @ testbed.body.com) + LIKELY * height_sd(testbed)


def level_inertia(testbed: Testbed) -> float:
    """Return the mean moment (kg m^2) about the axes across up."""
    return float(np.trace(across(testbed.up) @ testbed.body.inertia_P)) / 2


def coarsest_step(testbed: Testbed) -> float:
    """Return the longest step (m) of the centre of mass that a motor step makes."""
    return max((m.mass * m.resolution for m in testbed.masses), default=0.0) / testbed.body.mass


def within_reach(testbed: Testbed) -> None:
    """Raise InputError if masses may not reach over the likely offset."""
    offset, reach = likely_offset(testbed), greatest_shift(testbed)
    if offset > reach:
        raise InputError(
            testbed.name,
            f"{about_masses(testbed)}: they may not reach so far",
            "a coarse balance first, more mass or travel, or a smaller com_sd",
        )


def greatest_frequency(testbed: Testbed, least: float, share: float, period: float) -> float:
    """Return the greatest frequency (rad/s) of a loop with w |r| / v up to ``share``.

    InputError where the masses may not reach over the offset, or where that is below ``least``.
    """
    within_reach(testbed)
    offset = max(likely_offset(testbed), 1e-12)
    most = min(MOST, SAMPLED / period, share * greatest_slew(testbed) / offset)
    if least > most:
        raise InputError(
            testbed.name,
            about_masses(testbed),
            (
                f"a loop faster than {least:.2g} rad/s, for the tilt limit, and slower "
                f"than {most:.2g} rad/s, for masses and samples: a coarse balance first, "
                "faster or heavier masses, or a smaller com_sd"
            ),
        )
    return most


def about_masses(testbed: Testbed) -> str:
    """Return the likely offset and the reach of the masses, in words."""
    return (
        f"a centre of mass that may be {likely_offset(testbed) / UM:.3g} um off sideways, and "
        f"masses that shift it by {greatest_slew(testbed) / UM:.3g} um/s and "
        f"{greatest_shift(testbed) / UM:.3g} um"
    )
