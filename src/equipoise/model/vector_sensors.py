"""Sensors that see a vector of the laboratory in body axes: gravity, a lamp, the magnetic field.

All are aligned with the body axes, as the gyro is, but for a small turn that nobody measured: a
column map turns what is mounted otherwise.
"""

from dataclasses import dataclass, field

from equipoise.model.arrays import Vector3
from equipoise.model.defects import nothing


@dataclass(frozen=True, slots=True, eq=False)
class Accelerometer:
    """It feels what holds it: at rest g upwards, and its own acceleration when it is moved."""

    rate: float  # Hz
    noise: float  # m/s^2, one sd per axis and sample
    bias_sd: float  # m/s^2, how far its zero may be off
    place: Vector3 = field(default_factory=nothing)  # m, from P
    delay: float = 0.0  # s
    mounting_sd: float = 0.0  # rad, of its axes about each body axis, one sd; 0: exact


@dataclass(frozen=True, slots=True, eq=False)
class SunSensor:
    """It gives the unit vector to a lamp that stands far away."""

    rate: float  # Hz
    noise: float  # -, one sd per axis and sample, of a unit vector
    direction_N: Vector3 | None  # unit vector to the lamp, laboratory axes; None: the testbed's
    delay: float = 0.0  # s
    mounting_sd: float = 0.0  # rad, as of an accelerometer


@dataclass(frozen=True, slots=True, eq=False)
class Magnetometer:
    """It gives the magnetic field of the laboratory, which the testbed states."""

    rate: float  # Hz
    noise: float  # T, one sd per axis and sample
    bias_sd: float  # T, how far its zero may be off
    delay: float = 0.0  # s
    mounting_sd: float = 0.0  # rad, as of an accelerometer
