"""Devices that turn a platform without moving its centre of mass, as the testbed states them.

Each is driven by one number and reports one number (``Recording.devices``). A pair of coils of a
Helmholtz cage stands in the laboratory around the platform; all others are on it:

    device               driven by                         reports
    reaction wheel       torque on the rotor, N m          speed against the platform, rad/s
    control moment gyro  gimbal rate, rad/s                gimbal angle, rad
    magnetorquer         dipole, A m^2                     dipole, A m^2
    coil pair of a cage  field along its axis, T           the same, T, by its current
    jet pair             impulse on the platform, N m s    torque on the platform, N m, mean since
                                                           the row before

What follows an input does so with a first-order lag: y' = (input - y) / lag.

A recording does not know the testbed, so its name of a device holds what the numbers are:
``wheel:x``, ``gimbal:a``, ``dipole:x``, ``cage:x`` or ``jet:x`` for a device of the name after the
colon.
"""

from dataclasses import dataclass
from typing import Literal

from equipoise.model.arrays import Vector3

Reported = Literal["wheel", "gimbal", "dipole", "cage", "jet"]


@dataclass(frozen=True, slots=True, eq=False)
class ReactionWheel:
    """A rotor with a fixed axis; its momentum is inertia times speed, along the axis.

    The platform's inertia counts the rotor as if it were locked, so the speed is that against the
    platform, and the drive holds the speed's slope: torque / inertia.
    """

    name: str
    axis: Vector3  # unit vector, body
    inertia: float  # kg m^2, about the axis
    max_speed: float  # rad/s
    max_torque: float  # N m
    speed: float = 0.0  # rad/s, at the start
    speed_noise: float = 0.0  # rad/s, one sd of a tachometer row
    lag: float = 0.0  # s
    gain_sd: float = 0.0  # -, of its inertia, relative, one sd; 0: exact
    mounting_sd: float = 0.0  # rad, of its axis about each direction across, one sd; 0: exact


@dataclass(frozen=True, slots=True, eq=False)
class ControlMomentGyro:
    """A rotor of constant momentum whose axis turns about a gimbal (single gimbal).

    h = momentum s(angle) + gimbal_inertia angle' g,  s = cos(angle) s0 + sin(angle) g x s0. The
    platform's inertia is that at angle zero; at an angle it has changed by
    asymmetry (s s^T - s0 s0^T).
    """

    name: str
    gimbal_axis: Vector3  # unit vector g, body
    spin_axis: Vector3  # unit vector s0, body, at angle zero; at right angles to g
    momentum: float  # N m s, of the rotor against the gimbal
    max_rate: float  # rad/s
    angle: float = 0.0  # rad, at the start
    angle_noise: float = 0.0  # rad, one sd of an encoder row
    lag: float = 0.0  # s
    gimbal_inertia: float = 0.0  # kg m^2, of all that turns with the gimbal, about g
    asymmetry: float = 0.0  # kg m^2, the same about the spin axis less about the third axis
    gain_sd: float = 0.0  # -, of its momentum, relative, one sd; 0: exact
    mounting_sd: float = 0.0  # rad, of both its axes about each direction across, one sd; 0: exact


@dataclass(frozen=True, slots=True, eq=False)
class Magnetorquer:
    """A coil; torque = dipole axis x B."""

    name: str
    axis: Vector3  # unit vector, body
    max_dipole: float  # A m^2
    lag: float = 0.0  # s
    gain_sd: float = 0.0  # -, of its dipole, relative, one sd; 0: exact
    mounting_sd: float = 0.0  # rad, of its axis about each direction across, one sd; 0: exact


@dataclass(frozen=True, slots=True, eq=False)
class CoilPair:
    """A pair of coils of a Helmholtz cage; field = input axis_N, beside the background."""

    name: str
    axis_N: Vector3  # unit vector, laboratory
    max_field: float  # T
    field: float = 0.0  # T, along its axis, at the start
    lag: float = 0.0  # s
    gain_sd: float = 0.0  # -, of its field, relative, one sd; 0: exact
    mounting_sd: float = 0.0  # rad, of its axis about each direction across, one sd; 0: exact
    nonuniformity: float = 0.0  # -, greatest deviation within the working volume, relative


@dataclass(frozen=True, slots=True, eq=False)
class JetPair:
    """On-off jets that give a pure torque about an axis, either way; on for impulse / torque."""

    name: str
    axis: Vector3  # unit vector, body
    torque: float  # N m, while on
    min_pulse: float = 0.0  # s, least time on
    lag: float = 0.0  # s
    gain_sd: float = 0.0  # -, of its torque, relative, one sd; 0: exact
    mounting_sd: float = 0.0  # rad, of its axis about each direction across, one sd; 0: exact


@dataclass(frozen=True, slots=True, eq=False)
class MagneticField:
    """The nominal field in the laboratory, uniform; beside a cage, what there is without it."""

    field_N: Vector3  # T, laboratory axes
    noise: float | None = None  # T, one sd per axis of a magnetometer's row; None: there is none


@dataclass(frozen=True, slots=True, eq=False)
class Lamp:
    """What warms the platform while it is on, towards an end, as 1 - exp(-t / time_constant).

    With a direction it is what a sun sensor sees, while it is on.
    """

    warms: float  # K, in the end
    time_constant: float  # s
    direction_N: Vector3 | None = None  # unit vector to it, laboratory axes; None: a heater


@dataclass(frozen=True, slots=True)
class Thermometer:
    """A sensor of the temperature of the platform, or of the air."""

    rate: float  # Hz
    noise: float = 0.0  # K, one sd of a row


Device = ReactionWheel | ControlMomentGyro | Magnetorquer | CoilPair | JetPair


REPORTED: dict[type[Device], Reported] = {
    ReactionWheel: "wheel",
    ControlMomentGyro: "gimbal",
    Magnetorquer: "dipole",
    CoilPair: "cage",
    JetPair: "jet",
}


@dataclass(frozen=True, slots=True)
class Traits:
    """What a kind of device is driven by, and what its electronics count of it."""

    input_unit: str
    counted_unit: str
    limit: str = ""  # field with the greatest input; empty: there is none
    total: bool = False  # what is counted is the input's integral over time, or the sum of pulses
    pulsed: bool = False  # an input is given once, and is over by itself; a recording has its mean


TRAITS: dict[type[Device], Traits] = {
    ReactionWheel: Traits("N m", "rad/s", "max_torque", total=True),
    ControlMomentGyro: Traits("rad/s", "rad", "max_rate", total=True),
    Magnetorquer: Traits("A m^2", "A m^2", "max_dipole"),
    CoilPair: Traits("T", "T", "max_field"),
    JetPair: Traits("N m s", "N m s", total=True, pulsed=True),
}


def recorded_name(device: Device) -> str:
    """Return what a recording calls a device, such as 'wheel:x'."""
    return f"{REPORTED[type(device)]}:{device.name}"


def at_start(device: Device) -> float:
    """Return what a device reports before it is driven: rad/s, rad, A m^2, T or N m."""
    if isinstance(device, ReactionWheel):
        return device.speed
    if isinstance(device, CoilPair):
        return device.field
    return device.angle if isinstance(device, ControlMomentGyro) else 0.0


def greatest_input(device: Device) -> float:
    """Return the most that a device takes, in the unit of its input; infinite where all is."""
    limit = TRAITS[type(device)].limit
    return float(getattr(device, limit)) if limit else float("inf")


def least_input(device: Device) -> float:
    """Return the least that a device takes beside nothing, in the unit of its input."""
    return device.torque * device.min_pulse if isinstance(device, JetPair) else 0.0


def greatest_count(device: Device) -> float:
    """Return the most that can be counted of it: a speed, or what it is driven to at most."""
    if isinstance(device, ReactionWheel):
        return device.max_speed
    return float("inf") if TRAITS[type(device)].total else greatest_input(device)


def counted_gain(device: Device) -> float:
    """Return what is counted for each unit of input: of a wheel rad/s for N m s, else one."""
    return 1.0 / device.inertia if isinstance(device, ReactionWheel) else 1.0


def counted_noise(device: Device) -> float:
    """Return one sd of what is counted."""
    if isinstance(device, ReactionWheel):
        return device.speed_noise
    return device.angle_noise if isinstance(device, ControlMomentGyro) else 0.0
