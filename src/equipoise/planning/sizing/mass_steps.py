"""The resolution of each mass: a step of its motor, as shift and as torque.

    |shift| = m_i delta_i / M          (da Silva 2021 Eq. 7 with the least displacement)
    |torque| = m_i g delta_i           when gravity acts across the rail

A mass goes to the nearest step. So the rest is at most half of that along its rail, and its root
mean square is 1 / sqrt(12) of it (R27).
"""

from dataclasses import dataclass

import numpy as np

from equipoise.model.arrays import Matrix3
from equipoise.model.testbed import SlidingMass, Testbed
from equipoise.planning.sizing.expected_torque import expected_torque


@dataclass(frozen=True, slots=True, eq=False)
class MassStep:
    """One step of one mass."""

    mass: SlidingMass
    shift: float  # m, of the platform's centre of mass
    torque: float  # N m, gravity across the rail
    within_tilt: float  # N m, root mean square within the tilt
    stop_sd: float  # m, one sd of where a stop leaves the centre of mass


def mass_steps(testbed: Testbed, tilt: float) -> tuple[MassStep, ...]:
    """Return the least step of each mass, and its torque within a tilt (rad)."""
    return tuple(step_of(testbed, mass, tilt) for mass in testbed.masses)


def step_of(testbed: Testbed, mass: SlidingMass, tilt: float) -> MassStep:
    """Return the least step of one mass."""
    share = mass.mass / testbed.body.mass
    shift = share * mass.resolution
    moment: Matrix3 = shift**2 * np.outer(mass.axis, mass.axis)
    torque = mass.mass * testbed.gravity * mass.resolution
    left = expected_torque(testbed, moment, tilt)
    return MassStep(mass, shift, torque, left, share * mass.accuracy)
