"""What is connected, boards, sensors, actuators, and limits: tables, and their records in SI."""

from collections.abc import Sequence
from typing import Annotated, Literal, cast

import numpy as np
from pydantic import Field

from equipoise.io.toml.key_types import Holds, Name, Positive, Square
from equipoise.io.toml.table_records import RecordTable, record_of
from equipoise.model import hardware as model
from equipoise.model.arrays import Matrix3
from equipoise.model.errors import InputError, nearest
from equipoise.model.units import MM

Address = Annotated[
    str,
    Field(
        pattern=r"^(serial:.+|tcp:.+:\d+|udp:(.+:)?\d+|udpout:.+:\d+|ws://.+|wss://.+|https?://.+"
        r"|camera:\d{1,4}(@\d{1,5}x\d{1,5})?)$"
    ),
    Holds("port.address"),
]
ADDRESSES = (
    "serial:/dev/ttyUSB0, serial:COM3, tcp:HOST:PORT, udp:PORT, udpout:HOST:PORT, ws://..., "
    "http://..., camera:0"
)
Baud = Annotated[int, Field(gt=0), Holds("port.baud")]
IDENTITY = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]
ORTHOGONAL = 1e-3  # chosen: a rotation written to three digits


class Axis(RecordTable):
    """One axis of a motor board and the mass that it moves."""

    KIND = model.Axis

    mass: str
    letter: Annotated[str, Field(pattern=r"^([XYZABC]|[0-9])$")] = Field(
        description="the board's name of the axis; for a Trinamic module the motor number"
    )
    steps_per_mm: Annotated[Positive, Holds("steps_per_m", 1 / MM)] = Field(
        description="as set in the board, which is queried"
    )
    zero_mm: float = Field(0.0, description="the board's position when the mass is at home")
    reversed: bool = Field(
        False, description="the board counts in the direction opposite to the mass's axis"
    )


class Board(RecordTable):
    """A board that moves sliding masses."""

    name: Name
    driver: str = Field(description="grbl or tmcl")
    port: Address = Field(description=ADDRESSES)
    baud: Baud = 115200
    homing: bool = Field(
        True, description="true: it has limit switches; false: a person moves masses home"
    )
    axis: Annotated[list[Axis], Field(min_length=1), Holds("axes")]

    def record(self, where: str) -> model.MotorBoard:
        """Return the board."""
        port = record_of(model.Port, self, where, within="port")
        return record_of(model.MotorBoard, self, where, port=port)


class SensorUnit(RecordTable):
    """A device that measures attitude, rate or both."""

    name: Name
    driver: str = Field(description="vectornav, lines, mavlink, natnet, rosbridge or camera")
    port: Address = Field(description=ADDRESSES)
    baud: Baud = 115200
    gives: Annotated[list[Literal["attitude", "rate"]], Field(min_length=1)]
    alignment: Square = Field(IDENTITY, description="rotation from the sensor's axes to the body's")
    laboratory: Literal["z_up", "ned", "y_up"] = Field(
        "z_up", description="reference frame of its attitude"
    )
    settings: dict[str, str | float | bool | list[str] | list[dict[str, float]]] = Field(
        {}, description="driver settings, such as the columns of a line or the tags of a board"
    )

    def record(self, where: str) -> model.SensorUnit:
        """Return the sensor, its alignment exactly a rotation."""
        return record_of(
            model.SensorUnit,
            self,
            where,
            port=record_of(model.Port, self, where, within="port"),
            alignment=_rotation(self.alignment, f"{where}.alignment"),
            settings={key: _setting(value) for key, value in self.settings.items()},
        )


class ActuatorUnit(RecordTable):
    """Electronics that drive wheels, gyros, coils or jets."""

    name: Name
    driver: str = Field(description="device_lines")
    port: Address = Field(description=ADDRESSES)
    baud: Baud = 115200
    drives: Annotated[list[str], Field(min_length=1)] = Field(
        description="names of the devices of this file, in the order of its outputs"
    )

    def record(self, where: str) -> model.ActuatorUnit:
        """Return the unit."""
        port = record_of(model.Port, self, where, within="port")
        return record_of(model.ActuatorUnit, self, where, port=port, drives=tuple(self.drives))


class Hardware(RecordTable):
    """What is connected, and beyond which limits every motor is stopped."""

    rate_limit_deg_s: Annotated[Positive, Holds("limits.rate")] = Field(
        60.0, description="default: well above any free swing"
    )
    stale_s: Annotated[Positive, Holds("limits.stale")] = Field(
        0.5, description="default: time without a row or an answer"
    )
    mismatch_mm: Annotated[Positive, Holds("limits.mismatch")] = Field(
        1.0, description="default: between commanded and reported position"
    )
    board: Annotated[list[Board], Holds("boards")] = Field([])
    sensor: Annotated[list[SensorUnit], Holds("sensors")] = Field([])
    actuator: Annotated[list[ActuatorUnit], Holds("actuators")] = Field([])

    def record(self, where: str) -> model.Hardware:
        """Return what is connected; each name and each port must be there once."""
        units = (*self.board, *self.sensor, *self.actuator)
        names, ports = [each.name for each in units], [each.port for each in units]
        _check_once(names, where, "'{}'", "a name for each board, sensor and actuator")
        _check_once(ports, where, "at {}", "a port for each")
        limits = record_of(model.SafetyLimits, self, where, within="limits")
        return record_of(model.Hardware, self, where, limits=limits)


def check_moved_masses(boards: Sequence[Board], masses: Sequence[str], source: str) -> None:
    """Raise InputError unless each axis moves a mass of the file that no other axis moves."""
    moved: list[str] = []
    for i, board in enumerate(boards, 1):
        where = f"{source}: hardware.board[{i}].axis"
        letters = [axis.letter for axis in board.axis]
        if len(set(letters)) < len(letters):
            raise InputError(where, f"letters {' '.join(letters)}", "each letter once")
        for axis in board.axis:
            if axis.mass not in masses:
                known = nearest(axis.mass, list(masses)) if masses else "a [[sliding_mass]] first"
                raise InputError(where, f"mass '{axis.mass}'", known)
            if axis.mass in moved:
                raise InputError(where, f"mass '{axis.mass}' twice", "one axis for each mass")
            moved.append(axis.mass)


def check_driven_devices(
    units: Sequence[ActuatorUnit], devices: Sequence[str], source: str
) -> None:
    """Raise InputError unless each output drives a device of the file that no other drives."""
    driven: list[str] = []
    for i, unit in enumerate(units, 1):
        where = f"{source}: hardware.actuator[{i}].drives"
        for name in unit.drives:
            if name not in devices:
                known = nearest(name, list(devices)) if devices else "a device of the file first"
                raise InputError(where, f"device '{name}'", known)
            if name in driven:
                raise InputError(where, f"device '{name}' twice", "one output for each device")
            driven.append(name)


def _check_once(words: list[str], where: str, shown: str, wanted: str) -> None:
    for i, word in enumerate(words):
        if word in words[:i]:
            raise InputError(where, f"two devices {shown.format(word)}", wanted)


def _setting(value: str | float | bool | list[str] | list[dict[str, float]]) -> model.Setting:
    return cast("model.Setting", tuple(value)) if isinstance(value, list) else value


def _rotation(rows: list[list[float]], where: str) -> Matrix3:
    """Return a matrix made exactly a rotation; it must be nearly one."""
    matrix = np.array(rows, float)
    u, _, vt = np.linalg.svd(matrix)
    nearest_turn = u @ vt
    if np.abs(nearest_turn - matrix).max() > ORTHOGONAL or np.linalg.det(nearest_turn) < 0:
        wanted = "a rotation: rows of unit length at right angles, right-handed"
        raise InputError(where, f"{rows}", wanted)
    return nearest_turn
