"""Foxglove's messages of attitude, as protobuf or as JSON.

Fields (public Foxglove schemas): FrameTransform 1 timestamp, 2 parent, 3 child, 4 translation,
5 rotation; PoseInFrame 1 timestamp, 2 frame, 3 pose (2 orientation); Quaternion x 1, y 2, z 3,
w 4; timestamp 1 seconds, 2 nanoseconds. In JSON the timestamp is {"sec", "nsec"}.
"""

import json
from collections.abc import Mapping
from typing import Any

from equipoise.io.formats.clock_units import PER_S
from equipoise.io.mcap.protobuf_fields import Value, double, fields, message, whole

Turned = tuple[int, tuple[float, float, float, float]]  # ns, quaternion with the scalar first


def frame_transform(data: bytes) -> Turned:
    """Return stamp and rotation of a foxglove.FrameTransform; ValueError if it is none."""
    found = fields(data)
    return _stamp(found), _quaternion(message(found, 5))


def pose_in_frame(data: bytes) -> Turned:
    """Return stamp and orientation of a foxglove.PoseInFrame; ValueError if it is none."""
    found = fields(data)
    return _stamp(found), _quaternion(message(message(found, 3), 2))


def frame_transform_json(data: bytes) -> Turned:
    """Return the same of a FrameTransform as JSON."""
    message = json.loads(data)
    return _json_stamp(message), _json_quaternion(message["rotation"])


def pose_in_frame_json(data: bytes) -> Turned:
    """Return the same of a PoseInFrame as JSON."""
    message = json.loads(data)
    return _json_stamp(message), _json_quaternion(message["pose"]["orientation"])


def _stamp(found: Mapping[int, Value]) -> int:
    stamp = message(found, 1)
    return whole(stamp, 1) * PER_S + whole(stamp, 2)


def _quaternion(turn: Mapping[int, Value]) -> tuple[float, float, float, float]:
    return double(turn, 4), double(turn, 1), double(turn, 2), double(turn, 3)


def _json_stamp(message: Any) -> int:
    stamp: Any = message.get("timestamp") or {}
    return int(stamp.get("sec", 0)) * PER_S + int(stamp.get("nsec", 0))


def _json_quaternion(turn: Any) -> tuple[float, float, float, float]:
    return float(turn["w"]), float(turn["x"]), float(turn["y"]), float(turn["z"])
