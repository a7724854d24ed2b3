"""The testbed: the nominal properties of a platform, its masses, its sensors and its bearing.

``Truth`` is read by the simulator alone.
"""

import math
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import Literal

import numpy as np

from equipoise.model.arrays import Floats, Matrix3, Square, Vector3
from equipoise.model.defects import (
    CameraErrors,
    ComStep,
    Contact,
    Gap,
    GyroErrors,
    TrueCoilPair,
    TrueLamp,
    nothing,
)
from equipoise.model.devices import (
    CoilPair,
    ControlMomentGyro,
    Device,
    JetPair,
    Lamp,
    MagneticField,
    Magnetorquer,
    ReactionWheel,
    Thermometer,
    recorded_name,
)
from equipoise.model.hardware import Hardware
from equipoise.model.mass_properties import MassProperties
from equipoise.model.modes import Mode
from equipoise.model.presentation import Shown
from equipoise.model.reasons.reason import Reason
from equipoise.model.table_top import PlanarTable, PositionSensor, TrueTable
from equipoise.model.torque_terms import GROUPS
from equipoise.model.vector_sensors import Accelerometer, Magnetometer, SunSensor
from equipoise.model.weights import Weight, WeightGrid

SAG_SD = 0.001  # m, chosen: g / w^2 of a servo of w = 100 rad/s
PLUMB_SD = math.radians(0.3)  # chosen: a camera levelled by eye, or a floor for the vertical
CLOCK_SD = 1e-4  # relative, chosen: a crystal
AT_STOP = 0.98  # of the tilt limit, chosen: 0.6 deg of 30, three times a camera's noise
LAG_SD = 0.03  # s, chosen: a soft servo's 25 ms, or a row of a log at 50 Hz
AIR_TIME = 30.0  # s, chosen: in which the air's torque forgets, currents in a room
# How a platform sits on its bearing (da Silva et al. 2021, table 1).
Layout = Literal["table-top", "umbrella", "dumbbell", "spherical-rotor"]


@dataclass(frozen=True, slots=True)
class DriveDoubt:
    """How far a drive may be off what is stated of it, one sd each: what a calibration seeks."""

    gain: float  # -, 0: trusted
    across: float  # rad, of the rail, about each of two directions
    backlash: float  # m


@dataclass(frozen=True, slots=True, eq=False)
class SlidingMass:
    """A mass on a rail. Its displacement is zero at home and counts along ``axis``, as commanded.

    Commanded to go d, it changes the first moment by ``mass * gain * d * axis``. A balance depends
    on that product alone: a gain stands for wrong steps and for a wrong weight alike.
    """

    name: str
    mass: float  # kg, with what moves with it; part of the platform's mass
    home: Vector3  # m, from P
    axis: Vector3  # unit vector
    travel: tuple[float, float]  # m, least and greatest displacement
    resolution: float  # m, the step it can be asked for; 0: any
    accuracy: float  # m, one sd of where it really stops
    backlash: float  # m, lost motion when the direction changes
    speed: float  # m/s
    lag_sd: float = LAG_SD  # s, one sd of how late it follows a recorded command; 0: at once
    sag_sd: float = SAG_SD  # m, one sd of how far it hangs below a command, rail upright; 0: stiff
    gain: float = 1.0  # -, first moment given over that stated, mass * command
    doubt: DriveDoubt | None = None  # not of a file: a calibration's own; None: as stated
    mass_sd: float = 0.0  # -, relative, one sd; 0: exact
    logged_late: bool = False  # not of a file: a survey's own; measurements are stamped late, too
    lag: float = 0.0  # s, not of a file: a survey's own; how late its rows are timed already


@dataclass(frozen=True, slots=True, eq=False)
class AttitudeSensor:
    """A camera or star tracker; a row at t is the mean over [t - delay - averaging, t - delay]."""

    rate: float  # Hz
    noise: float  # rad, one sd per axis and sample
    delay: float = 0.0  # s
    averaging: float = 0.0  # s
    quantum: float = 0.0  # rad, roll, pitch and yaw come in multiples of it; 0: as they are
    clock_sd: float = 0.0  # -, relative, of the rate of its clock, one sd; 0: exact
    plumb_sd: float = PLUMB_SD  # rad, how far its vertical may lean from gravity's; 0: it does not


@dataclass(frozen=True, slots=True, eq=False)
class Gyro:
    """A rate gyro triad, aligned with the body axes; delay and averaging as for the camera."""

    rate: float  # Hz
    noise: float  # rad/s, one sd per axis and sample
    bias_sd: float  # rad/s, how far its zero may be off
    delay: float = 0.0  # s
    averaging: float = 0.0  # s
    quantum: float = 0.0  # rad/s, rates come in multiples of it; 0: as they are
    clock_sd: float = 0.0  # -, relative, of the rate of its clock, one sd; 0: exact
    clock: float = 0.0  # -, not of a file: how fast beside a camera's a survey found it


@dataclass(frozen=True, slots=True)
class Fault:
    """A mass that does not follow its commands: it goes ``gain`` times the distance from home."""

    mass: str
    gain: float  # -, 0: stuck at home, 1: sound
    from_move: int = 1  # the first commanded move at which the fault shows


@dataclass(frozen=True, slots=True, eq=False)
class TrueDrive:
    """What a mass's drive really is, all its life; None: as the testbed states it.

    Not stated as a difference, so that it stays true when a calibration corrects the testbed.
    """

    mass: str
    gain: float | None = None  # -, of the stated mass and the command
    axis: Vector3 | None = None  # unit vector
    backlash: float | None = None  # m
    accuracy: float | None = None  # m, one sd of where it really stops


@dataclass(frozen=True, slots=True, eq=False)
class Truth:
    """What the simulated bench is made of. What is not given is drawn with the run's seed."""

    com: Vector3 | None  # m, masses at home; None: uniform in the box below
    com_low: Vector3  # m
    com_high: Vector3  # m
    inertia_P: Matrix3 | None  # kg m^2, masses at home; None: the testbed's, wrong by up to ...
    inertia_error: float  # -, greatest relative error of each moment
    attitude: Vector3 | None  # rad, roll, pitch, yaw (3-2-1); None: tilt up to ..., any heading
    tilt: float  # rad
    rate: Vector3 | None  # rad/s, body axes; None: each component up to ...
    rate_limit: float  # rad/s
    torque: Mapping[str, float]  # coefficients by term, SI
    noise_torque: float  # N m, one sd per axis
    noise_correlation: float  # s
    gyro_bias: Vector3  # rad/s
    faults: tuple[Fault, ...] = ()
    mass_lag: float = 0.0  # s, by which masses are behind what is reported of them
    contacts: tuple[Contact, ...] = ()
    com_steps: tuple[ComStep, ...] = ()
    gaps: tuple[Gap, ...] = ()
    camera: CameraErrors = field(default_factory=CameraErrors)
    gyro: GyroErrors = field(default_factory=GyroErrors)
    field_N: Vector3 | None = None  # T, without the cage, laboratory axes; None: as stated
    cage: tuple[TrueCoilPair, ...] = ()
    drives: tuple[TrueDrive, ...] = ()
    accelerometer_bias: Vector3 = field(default_factory=nothing)  # m/s^2
    magnetometer_bias: Vector3 = field(default_factory=nothing)  # T
    accelerometer_mounting: Vector3 = field(default_factory=nothing)  # rad, rotation vector
    sun_mounting: Vector3 = field(default_factory=nothing)  # rad
    magnetometer_mounting: Vector3 = field(default_factory=nothing)  # rad
    lamp: TrueLamp | None = None  # None: there is none, or it is always off
    modes: tuple[Mode, ...] = ()  # what is not rigid
    table: TrueTable | None = None  # None: level, without friction; P starts at rest in the middle


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class Testbed(Shown):
    """A platform on its bearing, as known before anything is measured."""

    __test__ = False  # not a test case, whatever its name suggests

    name: str
    body: MassProperties  # first guess, masses at home, everything that floats
    inertia_sd: float  # -, relative, one sd
    com_sd: Vector3  # m, one sd
    up: Vector3  # unit vector, the body axis that points up when level
    tilt_limit: float  # rad, where it meets its stop; pi or more: it may turn over
    gravity: float  # m/s^2
    masses: tuple[SlidingMass, ...] = ()
    attitude: AttitudeSensor | None = None
    gyro: Gyro | None = None
    disturbances: tuple[str, ...] = ()  # torque terms to consider
    air_torque: float = 2e-6  # N m, one sd per axis, chosen: measured 4e-7 to 3e-6 at 2.7 kg
    com_walk: float = 0.05e-6  # m, one sd after a minute, chosen: of warmth, 0.05 to 0.5 um
    truth: Truth | None = None
    assumed: Mapping[str, str] = field(default_factory=dict[str, str])  # key: why it is assumed
    source: str = ""  # where it was read
    mended: tuple[Reason, ...] = ()  # what reading it had to set right
    wheels: tuple[ReactionWheel, ...] = ()
    cmgs: tuple[ControlMomentGyro, ...] = ()
    magnetorquers: tuple[Magnetorquer, ...] = ()
    jets: tuple[JetPair, ...] = ()
    magnetic_field: MagneticField | None = None
    weights: tuple[Weight, ...] = ()  # to be placed by hand
    grids: tuple[WeightGrid, ...] = ()  # where they can be placed
    coil_pairs: tuple[CoilPair, ...] = ()  # of a cage around the bench
    lamp: Lamp | None = None  # whose switch a recording may hold
    hardware: Hardware | None = None  # what is connected; None: nothing, it can be simulated
    mass_sd: float = 0.0  # -, of all that floats, relative, one sd; 0: exact
    gravity_sd: float = 0.0  # -, relative, one sd; 0: exact
    momentum_sd: float = 0.0  # -, of momentum recorded as such, relative, one sd; 0: exact
    torque_sd: float = 0.0  # -, of torque recorded as such, relative, one sd; 0: exact
    accelerometer: Accelerometer | None = None
    sun: SunSensor | None = None
    magnetometer: Magnetometer | None = None  # of ``field_N``
    thermometer: Thermometer | None = None
    position: PositionSensor | None = None
    table: PlanarTable | None = None  # that P moves over; None: P stands still
    # of J_P (xx yy zz xy xz yz, kg m^2) and com (m), masses at home; not of a file: as a balancing
    # by hand has found them; None: independent, as the sds above say
    body_covariance: Square | None = None
    layout: Layout = "table-top"  # how it sits on its bearing: what a picture shows

    @property
    def weight(self) -> float:
        """Return m g, N."""
        return self.body.mass * self.gravity

    @property
    def tilt_at_stop(self) -> float:
        """Return the tilt (rad) beyond which a measured tilt counts as being at the stop."""
        return AT_STOP * self.tilt_limit

    @property
    def devices(self) -> tuple[Device, ...]:
        """Return wheels, gyros, magnetorquers, coils of the cage and jets; their names differ."""
        return (*self.wheels, *self.cmgs, *self.magnetorquers, *self.coil_pairs, *self.jets)

    def columns(self, kind: type[Device]) -> slice:
        """Return where the devices of a kind stand among all, side by side; empty: there are none.

        ``devices`` of a recording has its columns in this order.
        """
        found = [k for k, device in enumerate(self.devices) if isinstance(device, kind)]
        return slice(found[0], found[-1] + 1) if found else slice(0, 0)

    def field_N(self, cage: Floats | None = None) -> Floats | None:
        """Return the nominal magnetic field (..., 3) T in laboratory axes; None: not known.

        B_N = background + sum field_i axis_i, with fields (..., k) T of the coil pairs of the cage,
        None: those at the start. Without [magnetic_field] the background is taken as zero.
        """
        if self.magnetic_field is None and not self.coil_pairs:
            return None
        found = np.zeros(3) if self.magnetic_field is None else self.magnetic_field.field_N
        if not self.coil_pairs:
            return found
        given = np.array([pair.field for pair in self.coil_pairs]) if cage is None else cage
        return found + given @ np.array([pair.axis_N for pair in self.coil_pairs])

    @property
    def device_names(self) -> tuple[str, ...]:
        """Return the names that a recording gives the devices, such as 'wheel:x', in order."""
        return tuple(recorded_name(device) for device in self.devices)

    @property
    def mass_names(self) -> tuple[str, ...]:
        """Return the names of the sliding masses, in order."""
        return tuple(mass.name for mass in self.masses)

    def in_group(self, group: str) -> tuple[str, ...]:
        """Return the torques of a group (``model.torque_terms``) that are considered."""
        return tuple(term for term in self.disturbances if term in GROUPS[group])

    def without(self, group: str) -> "Testbed":
        """Return the testbed without a group of torques among what is estimated."""
        terms = tuple(term for term in self.disturbances if term not in GROUPS[group])
        return replace(self, disturbances=terms)

    def mass_named(self, name: str) -> SlidingMass:
        """Return the sliding mass of that name; KeyError if there is none."""
        return {mass.name: mass for mass in self.masses}[name]
