"""ROS 2 topics by rosbridge: JSON messages of a WebSocket.

    {"op": "subscribe", "id": "/imu", "topic": "/imu", "type": "sensor_msgs/msg/Imu"}    we say
    {"op": "publish", "topic": "/imu", "msg": {"header": {"stamp": ...}, ...}}           it says

Source: rosbridge v2.0 protocol specification; sensor_msgs/Imu, geometry_msgs/PoseStamped and REP
145 for what they hold. Quaternions x, y, z, w turn the frame of the message into its world, whose
Z is up; rates are rad/s about the axes of the message. -1 as the first number of a covariance says
that a quantity is not there.

An attitude may come as Imu or as PoseStamped, a rate as Imu, from one topic or from two.
"""

import json
import math
from collections.abc import Mapping, Sequence
from typing import Any, cast

from equipoise.hardware.sensors.attitudes import unit_row
from equipoise.hardware.sensors.settings import Settings, check_gives
from equipoise.hardware.transport.conversation import SensorDriver
from equipoise.model.hardware import Gives, SensorUnit
from equipoise.model.reading import Reading
from equipoise.model.units import NS

IMU, POSE = "sensor_msgs/msg/Imu", "geometry_msgs/msg/PoseStamped"
KEYS = ("topic_attitude", "topic_rate", "type_attitude")
UNIT = 1e-3  # chosen: a quaternion in double precision is of length one well within this
NONE = -1.0  # REP 145

Message = Mapping[str, Any]


class NotThere(Exception):
    """A message in which a quantity is declared not to be."""


class RosBridge(SensorDriver):
    """The conversation; settings: ``topic_attitude``, ``topic_rate`` and ``type_attitude``."""

    def __init__(self, unit: SensorUnit) -> None:
        settings = Settings(unit, KEYS)
        message: dict[Gives, str] = {
            "attitude": settings.text("topic_attitude"),
            "rate": settings.text("topic_rate"),
        }
        can = [channel for channel, topic in message.items() if topic]
        check_gives(unit, can, "a setting topic_... for it")
        self._topics = {channel: message[channel] for channel in unit.gives}
        self._types = {"attitude": settings.text("type_attitude", IMU, (IMU, POSE)), "rate": IMU}
        if len(set(self._topics.values())) < len(self._topics) and self._types["attitude"] == POSE:
            raise settings.wrong(f"one topic of {POSE} for both", f"{IMU}, or two topics")
        types = {topic: self._types[channel] for channel, topic in self._topics.items()}
        super().__init__({topic: _subscription(topic, kind) for topic, kind in types.items()})

    def feed(self, data: bytes) -> Sequence[Reading]:
        """Return the rows of a message."""
        try:
            message = json.loads(data)
            self._confirm(message)
            readings = self._published(cast("Message", message)) if _is_published(message) else []
        except (ValueError, TypeError, LookupError, OverflowError, RecursionError):
            return self.counted([])
        return self.counted(readings or None)

    def _confirm(self, message: Any) -> None:
        """Note what a message says of the subscriptions: a topic's message, or an error."""
        if not isinstance(message, dict):
            return
        said = cast("dict[str, Any]", message)
        if _is_published(said):
            self.requests.confirmed(str(said.get("topic")))
        elif said.get("op") == "status" and said.get("level") == "error":
            topic = said.get("id")
            known = isinstance(topic, str) and topic in self._spoken
            self.requests.refused(str(said.get("msg")), topic if known else None)

    def _published(self, message: Message) -> list[Reading]:
        """Return the rows of a topic; raises for one that is not what it should be."""
        found: list[Reading] = []
        for channel in (c for c, topic in self._topics.items() if topic == message["topic"]):
            take = _rate if channel == "rate" else TAKEN[self._types[channel]]
            try:
                found.append(take(message["msg"]))
            except NotThere:
                continue
        return found


def _subscription(topic: str, kind: str) -> bytes:
    """Return a subscription; by its id it is one however often it is sent, and has its errors."""
    wanted = {"op": "subscribe", "id": topic, "topic": topic, "type": kind}
    return json.dumps(wanted).encode() + b"\n"


def _is_published(message: Any) -> bool:
    return isinstance(message, dict) and cast("Message", message).get("op") == "publish"


def _of_imu(message: Message) -> Reading:
    _check_there(message["orientation_covariance"])
    return Reading("attitude", _turn(message["orientation"]), _stamp(message))


def _of_pose(message: Message) -> Reading:
    return Reading("attitude", _turn(message["pose"]["orientation"]), _stamp(message))


def _rate(message: Message) -> Reading:
    _check_there(message["angular_velocity_covariance"])
    return Reading("rate", _numbers(message["angular_velocity"], "xyz"), _stamp(message))


TAKEN = {IMU: _of_imu, POSE: _of_pose}


def _turn(message: Message) -> tuple[float, ...]:
    row = unit_row(_numbers(message, "wxyz"), UNIT)
    if row is None:
        raise ValueError
    return row


def _numbers(message: Message, keys: str) -> tuple[float, ...]:
    """Return finite numbers by their keys."""
    found = tuple(_number(message[key]) for key in keys)
    if not all(map(math.isfinite, found)):
        raise ValueError
    return found


def _number(message: Any) -> float:
    if type(message) not in (int, float):
        raise TypeError
    return float(message)


def _stamp(message: Message) -> float | None:
    """Return the time of a message; None if it was never filled in."""
    stamp = message["header"]["stamp"]
    seconds, nanoseconds = _numbers({"s": stamp["sec"], "n": stamp["nanosec"]}, "sn")
    return seconds + nanoseconds * NS or None


def _check_there(covariance: Sequence[Any]) -> None:
    """Raise NotThere for a covariance by which there is no such quantity."""
    first, _, _ = (_number(covariance[k]) for k in (0, 4, 8))
    if first == NONE:
        raise NotThere
