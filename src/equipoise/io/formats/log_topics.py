"""Which topics of another program's log are taken: the best type that there is, one topic of it.

A camera's pose goes before odometry, odometry before what an inertial unit makes up of its
attitude; rates come from an inertial unit, else from odometry. Two topics of the chosen type are
refused: nobody but the person who recorded them knows which is the platform's.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np

from equipoise.io.formats.log_table import LogChannel
from equipoise.model.errors import InputError

Values = Mapping[str, tuple[float, ...]]  # attitude (scalar first) or rate, or both
POSE, TURN = "geometry_msgs/msg/PoseStamped", "geometry_msgs/msg/QuaternionStamped"
ODOMETRY, IMU = "nav_msgs/msg/Odometry", "sensor_msgs/msg/Imu"
FRAME_TRANSFORM, POSE_IN_FRAME = "foxglove.FrameTransform", "foxglove.PoseInFrame"
LATEST = 2**62  # ns since 1970, chosen: the year 2116; beyond, a count is no time
BEST = {
    "attitude": (FRAME_TRANSFORM, POSE_IN_FRAME, POSE, TURN, ODOMETRY, IMU),
    "rate": (IMU, ODOMETRY),
}


@dataclass(slots=True)
class Topic:
    """The rows of one topic."""

    name: str
    type: str
    ns: dict[str, list[int]] = field(default_factory=dict[str, list[int]])
    rows: dict[str, list[tuple[float, ...]]] = field(
        default_factory=dict[str, list[tuple[float, ...]]]
    )

    def add(self, ns: int, values: Values) -> None:
        """Take a message in; one of an impossible time is left out."""
        if not 0 <= ns < LATEST:
            return
        for channel, row in values.items():
            self.ns.setdefault(channel, []).append(ns)
            self.rows.setdefault(channel, []).append(row)


def chosen(topics: Sequence[Topic], source: str) -> tuple[list[LogChannel], tuple[str, ...]]:
    """Return the channels of the topics that are taken, and what was taken and left aside."""
    found = {channel: _best(channel, topics, source) for channel in BEST}
    taken = {channel: topic for channel, topic in found.items() if topic is not None}
    channels = [
        LogChannel(channel, np.array(topic.ns[channel]), np.array(topic.rows[channel], float))
        for channel, topic in taken.items()
    ]
    notes = [f"{c}: taken from topic '{topic.name}' ({topic.type})." for c, topic in taken.items()]
    used = [topic.name for topic in taken.values()]
    left = ", ".join(f"'{topic.name}'" for topic in topics if topic.name not in used and topic.rows)
    return channels, (*notes, *([f"Topics left aside: {left}."] if left else []))


def _best(channel: str, topics: Sequence[Topic], source: str) -> Topic | None:
    for kind in BEST[channel]:
        found = [topic for topic in topics if topic.type == kind and channel in topic.rows]
        if len(found) > 1:
            named = ", ".join(sorted(topic.name for topic in found))
            wanted = "one, the platform's; leave the others out of the log"
            raise InputError(source, f"{len(found)} topics of {kind}: {named}", wanted)
        if found:
            return found[0]
    return None
