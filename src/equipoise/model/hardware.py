"""What is connected to a bench: motor boards, sensors, actuators, and when they must stop.

A port's address says how a device is reached:

    serial:/dev/ttyUSB0   serial:COM3     a serial line, at ``baud``
    tcp:192.168.4.1:23                    a serial line behind a network bridge
    udp:14550   udp:239.255.42.99:1511    datagrams to a port of this computer, or to a group
    udpout:192.168.1.5:1510               datagrams to another computer, and its answers
    ws://localhost:9090                   messages of a WebSocket
    http://192.168.4.2:81/stream          a camera that sends pictures one after the other (MJPEG)
    camera:0   camera:0@1280x960          a camera of this computer, asked for a size of picture
"""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Literal

from equipoise.model.arrays import Matrix3

Gives = Literal["attitude", "rate"]
Laboratory = Literal["z_up", "ned", "y_up"]
SettingTable = Mapping[str, int | float]  # a row of numbers, such as one tag of a board
Setting = str | int | float | bool | tuple[str, ...] | tuple[SettingTable, ...]


@dataclass(frozen=True, slots=True)
class Port:
    """Where a device is reached; see above."""

    address: str
    baud: int = 115200


@dataclass(frozen=True, slots=True)
class Axis:
    """One axis of a motor board: displacement = position - zero, or the negative if reversed."""

    mass: str  # name of the sliding mass that it moves
    letter: str  # the board's name of the axis: X, Y, Z, A, B, C, or a motor's number
    steps_per_m: float
    zero: float  # m, the board's position where the displacement is zero
    reversed: bool = False

    def displacement(self, position: float) -> float:
        """Return the mass's displacement (m) at a position of the board (m)."""
        return (-1.0 if self.reversed else 1.0) * (position - self.zero)

    def position(self, displacement: float) -> float:
        """Return the board's position (m) of a displacement (m)."""
        return self.zero + (-1.0 if self.reversed else 1.0) * displacement


@dataclass(frozen=True, slots=True)
class MotorBoard:
    """A board that moves sliding masses."""

    name: str
    driver: str  # of ``hardware.boards.registry``
    port: Port
    axes: tuple[Axis, ...]
    homing: bool = True  # it finds its position by switches; else a person puts masses at home


@dataclass(frozen=True, slots=True, eq=False)
class SensorUnit:
    """A device that measures attitude, rate or both.

    With S = ``alignment`` (sensor to body), q the sensor's own attitude and L the turn of its
    laboratory frame to ours (Z up):  w_B = S w_S,  R(q_BN) = L R(q) S^T.
    """

    name: str
    driver: str  # of ``hardware.sensors.registry``
    port: Port
    gives: tuple[Gives, ...]
    alignment: Matrix3  # rotation, sensor axes to body axes
    laboratory: Laboratory = "z_up"  # of its attitude
    settings: Mapping[str, Setting] = field(default_factory=dict[str, Setting])  # the driver's own


@dataclass(frozen=True, slots=True)
class ActuatorUnit:
    """Electronics that drive wheels, gyros, coils or jets."""

    name: str
    driver: str  # of ``hardware.actuators.registry``
    port: Port
    drives: tuple[str, ...]  # names of the testbed's devices, in the order of its outputs


@dataclass(frozen=True, slots=True)
class SafetyLimits:
    """Beyond any of these every motor is stopped; tilt and travel are the testbed's own."""

    rate: float  # rad/s
    stale: float = 0.5  # s without a row of a sensor, or an answer of a board
    mismatch: float = 1e-3  # m, between where a mass should be and where its board says it is


@dataclass(frozen=True, slots=True, eq=False)
class Hardware:
    """All that is connected."""

    boards: tuple[MotorBoard, ...]
    sensors: tuple[SensorUnit, ...]
    limits: SafetyLimits
    actuators: tuple[ActuatorUnit, ...] = ()

    @property
    def units(self) -> tuple[MotorBoard | SensorUnit | ActuatorUnit, ...]:
        """Return whatever has a port."""
        return (*self.boards, *self.sensors, *self.actuators)
