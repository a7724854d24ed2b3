"""What is connected as the text of a testbed file: the way back from ``hardware_build``."""

import json
import math

from equipoise.io.toml.write_toml import Value, number, numbers, table
from equipoise.model.hardware import Axis, Hardware, MotorBoard, SensorUnit, Setting

PER_MM, MM, PER_DEG = 1e3, 1e-3, 180 / math.pi


def text_of_hardware(hardware: Hardware | None) -> str:
    """Return [hardware] and its lists; empty where nothing is connected."""
    if hardware is None:
        return ""
    limits = hardware.limits
    parts = [
        table("[hardware]", {
            "rate_limit_deg_s": number(limits.rate, PER_DEG),
            "stale_s": number(limits.stale),
            "mismatch_mm": number(limits.mismatch, PER_MM),
        }),
        *map(_board, hardware.boards),
        *map(_sensor, hardware.sensors),
    ]  # fmt: skip
    return "\n".join(parts)


def _board(board: MotorBoard) -> str:
    head: dict[str, Value] = {
        "name": board.name,
        "driver": board.driver,
        "port": board.port.address,
        "baud": board.port.baud,
        "homing": board.homing,
    }
    axes = (table("[[hardware.board.axis]]", _axis(axis)) for axis in board.axes)
    return "\n".join([table("[[hardware.board]]", head), *axes])


def _axis(axis: Axis) -> dict[str, Value]:
    return {
        "mass": axis.mass,
        "letter": axis.letter,
        "steps_per_mm": number(axis.steps_per_m, MM),
        "zero_mm": number(axis.zero, PER_MM),
        "reversed": axis.reversed,
    }


def _sensor(unit: SensorUnit) -> str:
    head: dict[str, Value] = {
        "name": unit.name,
        "driver": unit.driver,
        "port": unit.port.address,
        "baud": unit.port.baud,
        "gives": list(unit.gives),
        "alignment": [numbers(row) for row in unit.alignment],
        "laboratory": unit.laboratory,
    }
    settings = {json.dumps(key): _value(value) for key, value in unit.settings.items()}
    more = [table("[hardware.sensor.settings]", settings)] if settings else []
    return "\n".join([table("[[hardware.sensor]]", head), *more])


def _value(setting: Setting) -> Value:
    return list(setting) if isinstance(setting, tuple) else setting
