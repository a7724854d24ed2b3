"""An emulated sketch on a microcontroller: a line for each row, in the columns that were declared.

Written from the format's description, independently of the driver. Rows in which a column has no
value, because attitude and gyro have different rates, are not printed: a sketch prints what is
fresh.
"""

import json
import math
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from equipoise.hardware.emulated.device import sensed_rows
from equipoise.maths.attitude import to_euler321
from equipoise.model.arrays import Floats
from equipoise.model.hardware import Gives, SensorUnit
from equipoise.model.recording import Recording
from equipoise.model.units import MS, US

BOOTED = 3.0  # s, chosen: the sketch's clock is ahead by so much
CLOCKS = {"t_s": 1.0, "t_ms": MS, "t_us": US}


class EmulatedLineProtocol:
    """Prints CSV or JSON; ignores what is sent to it."""

    def __init__(self, unit: SensorUnit) -> None:
        self._unit, self._n = unit, 0
        columns = unit.settings.get("columns", ())
        named = columns if isinstance(columns, tuple) else ()
        self._columns = [column for column in named if isinstance(column, str)]

    def take(self, data: bytes, t: float) -> bytes:
        """Return nothing: a sketch does not answer."""
        return b""

    def messages(self, rows: Recording) -> Sequence[bytes]:
        """Return the lines, in order of time."""
        printed = [(t, _printed(parts)) for t, parts in sensed_rows(self._unit, rows)]
        return [self._line(t, values) for t, values in printed if self._full(values)]

    def _full(self, values: Mapping[str, float]) -> bool:
        names = {_name_and_path(column)[0] for column in self._columns}
        return names <= {*values, *CLOCKS, "n", "-"}

    def _line(self, t: float, values: dict[str, float]) -> bytes:
        self._n += 1
        values |= {name: round((t + BOOTED) / unit, 3) for name, unit in CLOCKS.items()}
        values |= {"n": self._n, "-": 0.0}
        named = [(_name_and_path(column)[1], values[_name_and_path(column)[0]])
                 for column in self._columns]  # fmt: skip
        if self._unit.settings.get("format", "csv") == "json":
            return json.dumps(_nested(named)).encode() + b"\r\n"
        return b",".join(b"%.12g" % value for _, value in named) + b"\r\n"


def _printed(parts: Mapping[Gives, Floats]) -> dict[str, float]:
    """Return all that can be printed of attitude, rate or both."""
    turn = _angular(parts["attitude"]) if "attitude" in parts else {}
    return turn | (_turning(parts["rate"]) if "rate" in parts else {})


def _angular(q: Floats) -> dict[str, float]:
    roll, pitch, yaw = (math.degrees(float(angle)) for angle in to_euler321(q))
    quaternion = dict(zip(("qw", "qx", "qy", "qz"), map(float, q), strict=True))
    return quaternion | {"yaw_deg": yaw, "pitch_deg": pitch, "roll_deg": roll}


def _turning(w: Floats) -> dict[str, float]:
    found: dict[str, float] = {}
    for unit, values in (("rad_s", w), ("deg_s", np.degrees(w))):
        for axis, value in zip("xyz", values, strict=True):
            found[f"g{axis}_{unit}"] = float(value)
    return found


def _name_and_path(column: str) -> tuple[str, str]:
    name, _, path = column.partition("=")
    return (name, path) if path else (column.split(".")[-1], column)


def _nested(named: Sequence[tuple[str, float]]) -> dict[str, Any]:
    """Return values as an object; a dot in a path opens one within."""
    found: dict[str, Any] = {}
    for path, value in named:
        *around, key = path.split(".")
        inner = found
        for outer in around:
            inner = inner.setdefault(outer, {})
        inner[key] = value
    return found
