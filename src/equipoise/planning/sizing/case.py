"""The case of a design: a testbed, its use and its surroundings."""

from dataclasses import dataclass, field

from equipoise.model.arrays import Vector3
from equipoise.model.testbed import Testbed
from equipoise.planning.sizing.environment import Surroundings


@dataclass(frozen=True, slots=True, eq=False)
class Case:
    """A testbed and its use."""

    testbed: Testbed
    target: Vector3  # m, where the centre of mass is wanted
    tilt: float  # rad, torque counts over directions within it of level
    measurement_time: float  # s, of each record
    moves: int
    rail_lean: float = 0.0  # rad, one sd about both axes across a rail
    around: Surroundings = field(default_factory=Surroundings)
