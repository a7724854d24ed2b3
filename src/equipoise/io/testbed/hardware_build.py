"""A testbed file's [hardware], checked against its masses and in SI."""

import math
from collections.abc import Sequence

import numpy as np

from equipoise.io.testbed import hardware as schema
from equipoise.model.arrays import Matrix3
from equipoise.model.errors import InputError, nearest
from equipoise.model.hardware import (
    Axis,
    Hardware,
    MotorBoard,
    Port,
    SafetyLimits,
    SensorUnit,
    Setting,
)

MM, PER_MM, DEG = 1e-3, 1e3, math.pi / 180
ORTHOGONAL = 1e-3  # chosen: a rotation written to three digits


def hardware_of(
    table: schema.Hardware | None, masses: Sequence[str], source: str
) -> Hardware | None:
    """Return what is connected; None where the file has no such table."""
    if table is None:
        return None
    _check_names([b.name for b in table.board] + [s.name for s in table.sensor], source)
    _check_ports([b.port for b in table.board] + [s.port for s in table.sensor], source)
    _check_masses(table.board, masses, source)
    limits = SafetyLimits(table.rate_limit_deg_s * DEG, table.stale_s, table.mismatch_mm * MM)
    sensors = tuple(
        _sensor(each, f"{source}: hardware.sensor[{i}]") for i, each in enumerate(table.sensor, 1)
    )
    return Hardware(tuple(map(_board, table.board)), sensors, limits)


def _board(table: schema.Board) -> MotorBoard:
    axes = tuple(
        Axis(a.mass, a.letter, a.steps_per_mm * PER_MM, a.zero_mm * MM, a.reversed)
        for a in table.axis
    )
    return MotorBoard(table.name, table.driver, Port(table.port, table.baud), axes, table.homing)


def _sensor(table: schema.SensorUnit, where: str) -> SensorUnit:
    return SensorUnit(
        name=table.name,
        driver=table.driver,
        port=Port(table.port, table.baud),
        gives=tuple(table.gives),
        alignment=_rotation(table.alignment, f"{where}.alignment"),
        laboratory=table.laboratory,
        settings={key: _setting(value) for key, value in table.settings.items()},
    )


def _setting(value: str | float | bool | list[str]) -> Setting:
    return tuple(value) if isinstance(value, list) else value


def _rotation(rows: list[list[float]], where: str) -> Matrix3:
    """Return a matrix made exactly a rotation; it must be nearly one."""
    matrix = np.array(rows, float)
    u, _, vt = np.linalg.svd(matrix)
    nearest_turn = u @ vt
    if np.abs(nearest_turn - matrix).max() > ORTHOGONAL or np.linalg.det(nearest_turn) < 0:
        wanted = "a rotation: rows of unit length at right angles, right-handed"
        raise InputError(where, f"{rows}", wanted)
    return nearest_turn


def _check_names(names: list[str], source: str) -> None:
    for i, name in enumerate(names):
        if name in names[:i]:
            wanted = "a name for each board and sensor"
            raise InputError(f"{source}: hardware", f"two devices '{name}'", wanted)


def _check_ports(ports: list[str], source: str) -> None:
    for i, port in enumerate(ports):
        if port in ports[:i]:
            raise InputError(f"{source}: hardware", f"two devices at {port}", "a port for each")


def _check_masses(boards: list[schema.Board], masses: Sequence[str], source: str) -> None:
    """Each mass is moved by one axis at most, each axis moves a mass of the file."""
    observed: list[str] = []
    for i, board in enumerate(boards, 1):
        where = f"{source}: hardware.board[{i}].axis"
        letters = [axis.letter for axis in board.axis]
        if len(set(letters)) < len(letters):
            raise InputError(where, f"letters {' '.join(letters)}", "each letter once")
        for axis in board.axis:
            if axis.mass not in masses:
                known = nearest(axis.mass, list(masses)) if masses else "a [[sliding_mass]] first"
                raise InputError(where, f"mass '{axis.mass}'", known)
            if axis.mass in observed:
                raise InputError(where, f"mass '{axis.mass}' twice", "one axis for each mass")
            observed.append(axis.mass)
