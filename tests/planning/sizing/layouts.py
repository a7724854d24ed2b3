"""Platforms of 10 kg with masses on rails in several layouts, for every test of a design."""

from dataclasses import replace

import numpy as np

from equipoise.model.mass_properties import MassProperties
from equipoise.model.testbed import SlidingMass, Testbed
from tests.support import builders

TOTAL = 10.0  # kg
X, Y, Z = np.eye(3)


def mass(axis, weight=0.1, travel=0.05, **details):
    """One mass (kg, m); a step of the usual one shifts the centre of mass by 10 um."""
    ends = (-travel, travel) if np.isscalar(travel) else travel
    unit = np.array(axis, float) / np.linalg.norm(axis)
    plain = SlidingMass("m", weight, 0.2 * X, unit, ends, 1e-3, 0.0, 0.0, 0.01, 0.0, 0.0)
    return replace(plain, **details)


def testbed(*masses) -> Testbed:
    """The platform with these masses, balanced within 0.1 mm by its prior."""
    named = tuple(replace(m, name=f"m{k}") for k, m in enumerate(masses))
    body = MassProperties(TOTAL, np.zeros(3), np.diag([0.3, 0.35, 0.5]))
    bed = replace(builders.platform(), body=body, masses=named, gravity=10.0)
    return replace(bed, com_sd=np.full(3, 1e-4))


testbed.__test__ = False  # pytest would take its name for a test's


def box(**details) -> Testbed:
    """One mass along each axis."""
    return testbed(*(mass(axis, **details) for axis in (X, Y, Z)))


def pyramid(slant: float) -> tuple[SlidingMass, ...]:
    """Four masses of 100 g on rails that rise by ``slant`` (rad) to the four sides."""
    c, s = np.cos(slant), np.sin(slant)
    return tuple(mass(axis) for axis in ((c, 0, s), (-c, 0, s), (0, c, s), (0, -c, s)))
