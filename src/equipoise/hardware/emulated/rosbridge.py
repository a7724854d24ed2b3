"""An emulated rosbridge server: publishes what was subscribed to, as Imu or PoseStamped.

Written from the protocol's specification, independently of the driver.
"""

import json
from collections.abc import Mapping, Sequence
from typing import Any

from equipoise.hardware.emulated.device import sensed_rows
from equipoise.model.arrays import Floats
from equipoise.model.hardware import Gives, SensorUnit
from equipoise.model.recording import Recording
from equipoise.model.units import NS

EPOCH = 1_700_000_000  # s, chosen: ROS time when the bench began
KNOWN = [1e-4, 0.0, 0.0, 0.0, 1e-4, 0.0, 0.0, 0.0, 1e-4]  # rad^2, chosen
NONE = [-1.0] + [0.0] * 8

Rows = Mapping[Gives, Floats]  # of each channel at one time


class EmulatedRosBridge:
    """Has the topics of the unit's settings."""

    def __init__(self, unit: SensorUnit) -> None:
        self._unit = unit
        self._types: dict[str, str] = {}  # of the topics that were subscribed to

    def take(self, data: bytes, t: float) -> bytes:
        """Return a status for a subscription to what is not there."""
        there = self._unit.settings.values()
        said = b""
        for line in data.splitlines():
            requested = json.loads(line)
            if requested["op"] == "subscribe" and requested["topic"] in there:
                self._types[requested["topic"]] = requested["type"]
            else:
                said = json.dumps({"op": "status", "level": "error", "msg": "unknown"}).encode()
        return said

    def messages(self, rows: Recording) -> Sequence[bytes]:
        """Return the messages, in order of time."""
        found = sensed_rows(self._unit, rows)
        return [message for t, parts in found for message in self._at(t, parts)]

    def _at(self, t: float, row: Rows) -> list[bytes]:
        """Return a message for each topic that has something to say now."""
        said: list[bytes] = []
        for topic, kind in self._types.items():
            settings = self._unit.settings
            parts: dict[Gives, Floats] = {
                name: row[name] for name in row if settings.get(f"topic_{name}") == topic
            }
            if parts:
                message = _header(t) | (_imu(parts) if kind.endswith("Imu") else _pose(parts))
                published = {"op": "publish", "topic": topic, "msg": message}
                said.append(json.dumps(published).encode())
        return said


def _header(t: float) -> dict[str, Any]:
    nanoseconds = round(t / NS)
    stamp = {"sec": EPOCH + nanoseconds // 10**9, "nanosec": nanoseconds % 10**9}
    return {"header": {"stamp": stamp, "frame_id": "imu"}}


def _imu(parts: Rows) -> dict[str, Any]:
    turn, rate = parts.get("attitude", [1.0, 0.0, 0.0, 0.0]), parts.get("rate", [0.0] * 3)
    return {
        "orientation": _quaternion(turn),
        "orientation_covariance": KNOWN if "attitude" in parts else NONE,
        "angular_velocity": _vector(rate),
        "angular_velocity_covariance": KNOWN if "rate" in parts else NONE,
        "linear_acceleration": _vector([0.0, 0.0, 9.807]),
        "linear_acceleration_covariance": [0.0] * 9,
    }


def _pose(parts: Rows) -> dict[str, Any]:
    return {"pose": {"position": _vector([0.0] * 3), "orientation": _quaternion(parts["attitude"])}}


def _vector(v: Sequence[float] | Floats) -> dict[str, float]:
    return {axis: float(value) for axis, value in zip("xyz", v, strict=True)}


def _quaternion(q: Sequence[float] | Floats) -> dict[str, float]:
    return _vector(q[1:]) | {"w": float(q[0])}
