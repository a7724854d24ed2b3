"""A flat table under a platform whose bearing floats on air pads, and the sensor of its place."""

from dataclasses import dataclass

from equipoise.model.arrays import Floats

SLOPE_SD = 1e-3  # rad, chosen: a table levelled by a spirit level of 0.02 mm/m lies far within it


@dataclass(frozen=True, slots=True, eq=False)
class PositionSensor:
    """Motion capture that measures where P is on the table; noise per axis and sample."""

    rate: float  # Hz
    noise: float  # m, one sd per axis and sample
    delay: float = 0.0  # s


@dataclass(frozen=True, slots=True, eq=False)
class PlanarTable:
    """A table, and the sled with air pads that carries the spherical bearing over it."""

    sled_mass: float  # kg, of all that floats beside the platform
    low: Floats  # (2,) m, corner of the table with the least x and y, laboratory axes
    high: Floats  # (2,) m, the opposite corner
    sled_mass_sd: float = 0.0  # -, relative, one sd; 0: exact
    slope_sd: float = SLOPE_SD  # rad, of the slope along x and along y, one sd


@dataclass(frozen=True, slots=True, eq=False)
class TrueTable:
    """What a simulated table really is, and where its platform starts."""

    slope: Floats  # (2,) rad, downhill, laboratory axes
    friction: Floats  # (4,) N s/m, at the corners: low low, low high, high low, high high
    position: Floats  # (2,) m, of P at the start
    velocity: Floats  # (2,) m/s
