"""Foxglove's messages of attitude, as protobuf or as JSON.

Fields (public Foxglove schemas): FrameTransform 1 timestamp, 2 parent, 3 child, 4 translation,
5 rotation; PoseInFrame 1 timestamp, 2 frame, 3 pose (2 orientation); Quaternion x 1, y 2, z 3,
w 4; timestamp 1 seconds, 2 nanoseconds. In JSON the timestamp is {"sec", "nsec"}.
"""

import json
from functools import reduce
from typing import Any

from equipoise.io.formats.clock_units import PER_S
from equipoise.io.logs.log_topics import FRAME_TRANSFORM, POSE_IN_FRAME
from equipoise.io.mcap.protobuf_fields import double, fields, message, whole

Turned = tuple[int, tuple[float, float, float, float]]  # ns, quaternion with the scalar first


# Where the quaternion stands: numbers of fields, and keys of JSON.
ROTATION: dict[str, tuple[tuple[int, ...], tuple[str, ...]]] = {
    FRAME_TRANSFORM: ((5,), ("rotation",)),
    POSE_IN_FRAME: ((3, 2), ("pose", "orientation")),
}


def turned(kind: str, data: bytes) -> Turned:
    """Return stamp and quaternion of a message in protobuf; ValueError if it is none."""
    found = fields(data)
    stamp, turn = message(found, 1), reduce(message, ROTATION[kind][0], found)
    quaternion = double(turn, 4), double(turn, 1), double(turn, 2), double(turn, 3)
    return whole(stamp, 1) * PER_S + whole(stamp, 2), quaternion


def turned_json(kind: str, data: bytes) -> Turned:
    """Return the same of a message in JSON."""
    try:
        found: Any = json.loads(data)
        stamp: Any = found.get("timestamp") or {}
        turn: Any = reduce(lambda part, key: part[key], ROTATION[kind][1], found)
        quaternion = float(turn["w"]), float(turn["x"]), float(turn["y"]), float(turn["z"])
        return int(stamp.get("sec", 0)) * PER_S + int(stamp.get("nsec", 0)), quaternion
    except (AttributeError, LookupError, OverflowError, RecursionError, TypeError) as error:
        raise ValueError(f"no {kind}") from error
