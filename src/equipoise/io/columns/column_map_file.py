"""A column map as a person writes it: TOML, each declaration with its unit.

separator = ";"                     # left out: detected
decimal = ","
skip_rows = 2                       # lines before the header
lab_up = "y"                        # the laboratory axis that points up
body = ["x", "-z", "y"]             # our body axes in terms of the table's
mean_of_frames = true               # quaternions may be short
[time]
column = "t"
unit = "ms"
[attitude]
columns = ["qx", "qy", "qz", "qw"]
order = "xyzw"                      # or, for angles: unit = "deg", sequence = "ZYX"
turns = "body to laboratory"
[rate]
columns = ["gx", "gy", "gz"]
unit = "deg/s"
axes = ["x", "y", "-z"]             # left out: as body
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
"""

from pathlib import Path
from typing import Annotated, Literal

import numpy as np
from pydantic import Field

from equipoise.io.columns.axis_permutation import axes_matrix
from equipoise.io.columns.column_map import (
    ColumnMap,
    Columns,
    Euler,
    Layout,
    NamedColumn,
)
from equipoise.io.toml.key_types import Table
from equipoise.io.toml.read_toml import read_toml
from equipoise.io.toml.units import factor
from equipoise.model.devices import Reported
from equipoise.model.errors import InputError

WANTED = "a column map (TOML)"
Axis = Literal["x", "y", "z", "-x", "-y", "-z"]
Axes = Annotated[list[Axis], Field(min_length=3, max_length=3)]
Three = Annotated[list[str], Field(min_length=3, max_length=3)]
# What a device reports: the kind of unit.
QUANTITY = {"wheel": "rate", "gimbal": "angle", "dipole": "dipole", "jet": "torque"}


class TimeTable(Table):
    """The clock."""

    column: str
    unit: str


class AttitudeTable(Table):
    """A quaternion in four columns, or angles in three."""

    columns: Annotated[list[str], Field(min_length=3, max_length=4)]
    order: Literal["wxyz", "xyzw"] | None = None
    unit: str | None = None
    sequence: Annotated[str, Field(pattern=r"^([XYZ]{3}|[xyz]{3})$")] | None = Field(
        None, description="three letters of X, Y, Z, or of x, y, z about fixed axes"
    )
    turns: Literal["body to laboratory", "laboratory to body"] = "body to laboratory"


class TriadTable(Table):
    """A vector in body axes."""

    columns: Three
    unit: str
    axes: Axes | None = None


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


def read_column_map(path: str | Path) -> ColumnMap:
    """Return the map a file declares; InputError names file, key, found and wanted."""
    table = read_toml(path, MapFile, WANTED)
    source = str(path)
    if table.attitude is None and table.rate is None:
        raise InputError(source, "neither [attitude] nor [rate]", "at least one of them")
    separator = "\t" if table.separator == "tab" else table.separator
    quaternion, euler = _attitude(table.attitude, f"{source}: attitude")
    body = _axes(table.body, f"{source}: body") or ("x", "y", "z")
    return ColumnMap(
        time=(Columns((table.time.column,), factor(table.time.unit, "time", f"{source}: time")),),
        quaternion=quaternion,
        euler=euler,
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
        lab_up=table.lab_up,
        body=body,
        inverse=table.attitude is not None and table.attitude.turns == "laboratory to body",
        mean_of_frames=table.mean_of_frames,
        layout=Layout(separator, table.decimal, table.skip_rows),
    )


def _attitude(table: AttitudeTable | None, where: str) -> tuple[Columns | None, Euler | None]:
    if table is None:
        return None, None
    if len(table.columns) == 4:
        if table.order is None:
            raise InputError(where, "four columns but no 'order'", "order = 'wxyz' or 'xyzw'")
        place = [table.order.index(letter) for letter in "wxyz"]
        return Columns(tuple(table.columns[i] for i in place)), None
    if table.unit is None or table.sequence is None:
        found = "three columns but no 'unit' or no 'sequence'"
        raise InputError(where, found, "unit = 'deg' or 'rad', sequence such as 'ZYX'")
    columns = Columns(tuple(table.columns), factor(table.unit, "angle", where))
    return None, Euler(columns, table.sequence)


def _triad(table: TriadTable | None, kind: str, where: str) -> Columns | None:
    if table is None:
        return None
    axes = None if table.axes is None else _axes(table.axes, f"{where}.axes")
    return Columns(tuple(table.columns), factor(table.unit, kind, where), axes)


def _device(table: DeviceTable, where: str) -> NamedColumn:
    unit = factor(table.unit, QUANTITY[table.reports], where)
    return NamedColumn(f"{table.reports}:{table.name}", table.column, unit)


def _axes(axes: list[Axis], where: str) -> tuple[str, str, str]:
    """Return three axes that make a right-handed frame."""
    x, y, z = axes
    if not np.isclose(np.linalg.det(axes_matrix((x, y, z))), 1.0):
        raise InputError(where, f"{axes}", "three different axes that make a right-handed frame")
    return x, y, z
