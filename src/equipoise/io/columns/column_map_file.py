"""A column map as a person writes it: TOML, each declaration with its unit.

separator = ";"                     # left out: detected
decimal = ","
skip_rows = 2                       # lines before the header
no_header = true                    # the columns are then named "1", "2", ...
units_row = true                    # a line of units follows the header
lab_up = "y"                        # the laboratory axis that points up
body = ["x", "-z", "y"]             # our body axes in terms of the table's
mean_of_frames = true               # quaternions may be short
[time]
column = "t"
unit = "ms"                         # or "100 ns"; for text: format = "ISO", or "clock of the day"
[attitude]
columns = ["qx", "qy", "qz", "qw"]
order = "xyzw"
turns = "body to laboratory"
# or three angles:                  unit = "deg", sequence = "ZYX", signs = [1, -1, 1],
#                                   compass = true where yaw is clockwise from north
# or a rotation vector:             unit = "rad", kind = "rotation vector"
# or nine, a matrix row by row:     no further key
[rate]
columns = ["gx", "gy", "gz"]
unit = "deg/s"
axes = ["x", "y", "-z"]             # left out: as body
factor = 0.0175                     # what a count is, in the unit; left out: 1
offset = [3, -8, 1]                 # counts of no turn, or one for all; left out: 0
[[mass]]
name = "x1"
column = "stage 1"
unit = "mm"
[[device]]
name = "x"
reports = "wheel"                   # wheel: speed, gimbal: angle, dipole, jet: torque
column = "rw1 speed"
unit = "rpm"
[field]
columns = ["bx", "by", "bz"]        # a magnetometer's, body axes
unit = "nT"
[accelerometer]
columns = ["ax", "ay", "az"]        # at rest +1 g along what points up
unit = "g0"                         # standard gravity
[sun]
columns = ["sx", "sy", "sz"]        # to the lamp, body axes
unit = "1"
[position]
columns = ["px", "py", "pz"]        # of the centre of rotation on a planar table, laboratory axes
unit = "mm"
"""

from pathlib import Path
from typing import Annotated, Any, Literal

from pydantic import BeforeValidator, Field

from equipoise.io.columns.attitude_table import AttitudeTable, attitude_columns
from equipoise.io.columns.axis_permutation import checked_axes
from equipoise.io.columns.column_map import (
    ColumnMap,
    Columns,
    Layout,
    NamedColumn,
)
from equipoise.io.toml.key_types import Positive, Table, Triple
from equipoise.io.toml.read_toml import read_toml
from equipoise.io.toml.units import factor
from equipoise.model.devices import Reported
from equipoise.model.errors import InputError

WANTED = "a column map (TOML)"
Axis = Literal["x", "y", "z", "-x", "-y", "-z"]
Axes = Annotated[list[Axis], Field(min_length=3, max_length=3)]
Three = Annotated[list[str], Field(min_length=3, max_length=3)]
# What a device reports: the kind of unit.
QUANTITY = {"wheel": "rate", "gimbal": "angle", "dipole": "dipole", "cage": "magnetic",
            "jet": "torque"}  # fmt: skip


def _thrice(value: Any) -> Any:
    """Return a number as three that are equal, anything else as it is."""
    return [value] * 3 if isinstance(value, (int, float)) else value


class TimeTable(Table):
    """The clock: a number with its unit, or a text with its format."""

    column: str
    unit: str | None = None
    format: Literal["ISO", "clock of the day"] | None = None


class TriadTable(Table):
    """A vector in body axes."""

    columns: Three
    unit: str
    axes: Axes | None = None
    factor: Positive = 1.0
    offset: Annotated[Triple, BeforeValidator(_thrice)] = Field([0.0, 0.0, 0.0])


class PositionTable(Table):
    """Where the centre of rotation is, in the laboratory axes of the attitude."""

    columns: Three
    unit: str


class MassTable(Table):
    """A sliding mass's displacement from home."""

    name: str
    column: str
    unit: str


class DeviceTable(Table):
    """What a device of the testbed reported."""

    name: str
    reports: Reported
    column: str
    unit: str


class TemperatureTable(Table):
    """The air at the bench, or the platform."""

    column: str
    unit: Literal["degC"]


class LampTable(Table):
    """A lamp that warms the platform, as a share of its full power: 0 off, 1 on."""

    column: str


class MapFile(Table):
    """A column map file as a whole."""

    separator: Literal[",", ";", "tab"] | None = None
    decimal: Literal[".", ","] | None = None
    skip_rows: Annotated[int, Field(ge=0)] | None = None
    no_header: bool = False
    units_row: bool | None = None
    lab_up: Axis = "z"
    body: Axes = Field(["x", "y", "z"])
    mean_of_frames: bool = False
    time: TimeTable
    attitude: AttitudeTable | None = None
    rate: TriadTable | None = None
    mass: list[MassTable] = Field([])
    momentum: TriadTable | None = None
    torque: TriadTable | None = None
    device: list[DeviceTable] = Field([])
    field: TriadTable | None = None
    temperature: TemperatureTable | None = None
    lamp: LampTable | None = None
    accelerometer: TriadTable | None = None
    sun: TriadTable | None = None
    position: PositionTable | None = None


def read_column_map(path: str | Path) -> ColumnMap:
    """Return the map a file declares; InputError names file, key, found and wanted."""
    return column_map_of(read_toml(path, MapFile, WANTED), str(path))


def column_map_of(table: MapFile, source: str) -> ColumnMap:
    """Return the map that the tables of a file declare; ``source`` is the file."""
    if table.attitude is None and table.rate is None:
        raise InputError(source, "neither [attitude] nor [rate]", "at least one of them")
    separator = "\t" if table.separator == "tab" else table.separator
    body = checked_axes(table.body, f"{source}: body")
    return ColumnMap(
        time=(_time(table.time, f"{source}: time"),),
        time_format=table.time.format,
        **attitude_columns(table.attitude, f"{source}: attitude"),
        rate=_triad(table.rate, "rate", f"{source}: rate"),
        masses=tuple(
            NamedColumn(m.name, m.column, factor(m.unit, "length", f"{source}: mass[{i}]"))
            for i, m in enumerate(table.mass, 1)
        ),
        momentum=_triad(table.momentum, "momentum", f"{source}: momentum"),
        torque=_triad(table.torque, "torque", f"{source}: torque"),
        devices=tuple(_device(d, f"{source}: device[{i + 1}]") for i, d in enumerate(table.device)),
        field=_triad(table.field, "magnetic", f"{source}: field"),
        temperature=None if table.temperature is None else Columns((table.temperature.column,)),
        lamp=None if table.lamp is None else Columns((table.lamp.column,)),
        accelerometer=_triad(table.accelerometer, "acceleration", f"{source}: accelerometer"),
        sun=_triad(table.sun, "share", f"{source}: sun"),
        position=_position(table.position, f"{source}: position"),
        lab_up=table.lab_up,
        body=body,
        inverse=table.attitude is not None and table.attitude.turns == "laboratory to body",
        mean_of_frames=table.mean_of_frames,
        layout=Layout(
            separator, table.decimal, table.skip_rows, not table.no_header, table.units_row
        ),
    )


def _time(table: TimeTable, where: str) -> Columns:
    if (table.unit is None) == (table.format is None):
        found = "neither 'unit' nor 'format'" if table.unit is None else "'unit' and 'format'"
        raise InputError(where, found, "a unit such as 'ms', or a format of text such as 'ISO'")
    return Columns((table.column,), factor(table.unit or "s", "time", where))


def _triad(table: TriadTable | None, kind: str, where: str) -> Columns | None:
    if table is None:
        return None
    # A gyro's axes may be left-handed: one that is mounted or wired the other way round.
    axes = None if table.axes is None else checked_axes(table.axes, f"{where}.axes", kind != "rate")
    unit = factor(table.unit, kind, where) * table.factor
    return Columns(tuple(table.columns), unit, axes, tuple(table.offset))


def _position(table: PositionTable | None, where: str) -> Columns | None:
    if table is None:
        return None
    return Columns(tuple(table.columns), factor(table.unit, "length", where))


def _device(table: DeviceTable, where: str) -> NamedColumn:
    unit = factor(table.unit, QUANTITY[table.reports], where)
    return NamedColumn(f"{table.reports}:{table.name}", table.column, unit)
