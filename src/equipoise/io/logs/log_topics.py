"""The topics of a log of ROS or Foxglove, filled message by message.

A camera's pose goes before an estimator's, that before odometry, and what an inertial unit makes up
of its attitude comes last; rates come from an inertial unit, else from odometry. A tree of frames
has a source for each child frame: ``/tf:child``. A transform with a single stamp is fixed.

A vector may be anything: it is taken for the rate if it is stated, or if its topic's name says so.
A twist or a vector in the axes of the laboratory is no rate in body axes: it too has to be stated.
"""

import re
from array import array
from collections import Counter
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np

from equipoise.io.files.reading_budget import Meter
from equipoise.io.logs.log_sources import Best, Source
from equipoise.io.logs.log_table import LogChannel
from equipoise.io.logs.unpacking_work import Work
from equipoise.io.logs.zstd_frames import unframed

Values = Mapping[str, tuple[float, ...]]  # by channel: attitude (scalar first), rate ...
POSE, TURN = "geometry_msgs/msg/PoseStamped", "geometry_msgs/msg/QuaternionStamped"
POSE_ESTIMATE = "geometry_msgs/msg/PoseWithCovarianceStamped"
TRANSFORM, TREE = "geometry_msgs/msg/TransformStamped", "tf2_msgs/msg/TFMessage"
OLD_TREE = "tf/msg/tfMessage"  # of ROS 1 before tf2
TWIST, VECTOR = "geometry_msgs/msg/TwistStamped", "geometry_msgs/msg/Vector3Stamped"
ODOMETRY, IMU = "nav_msgs/msg/Odometry", "sensor_msgs/msg/Imu"
FRAME_TRANSFORM, POSE_IN_FRAME = "foxglove.FrameTransform", "foxglove.PoseInFrame"
ROW = 80  # bytes of a row, here and in the tables made of it (chosen: measured are 60)
PART = 2000  # bytes of a source with its arrays (chosen)
DECODED = 100  # bytes in memory for one of a message that is decoded (chosen)
LATEST = 2**62  # ns since 1970, chosen: the year 2116; beyond, a count is no time
BEST: Best = {
    "attitude": (
        FRAME_TRANSFORM, POSE_IN_FRAME, TRANSFORM, POSE, TURN, POSE_ESTIMATE, ODOMETRY, TREE,
        OLD_TREE, IMU,
    ),
    "rate": (IMU, ODOMETRY, TWIST, VECTOR),
    "accelerometer": (IMU,),
}  # fmt: skip
TREES = (TREE, OLD_TREE)
IN_LABORATORY = (TRANSFORM, POSE, POSE_ESTIMATE, ODOMETRY)  # types whose frame is the laboratory
LABORATORIES = frozenset({"earth", "map", "odom", "world"})  # REP 105, and what many call it
SAYS_RATE = re.compile(r"(?i:gyro|angular|omega)|(?<![A-Za-z])rates?(?![a-z])|Rates?(?![a-z])")


class Sample(NamedTuple):
    """What a message holds for us, or one of several such."""

    ns: int  # its own stamp; 0: none
    values: Values
    frame: str = ""  # in which it is stated
    part: str = ""  # of its topic: the frame that is turned


Decoder = Callable[[bytes], Sequence[Sample]]  # ValueError where a message makes no sense


@dataclass(frozen=True, slots=True)
class TopicReader:
    """How the messages of one topic are read."""

    name: str
    kind: str
    decoder: Decoder


@dataclass(slots=True)
class _Rows:
    """The rows of one source."""

    count: int = 0
    frame: str = ""
    ns: "dict[str, array[int]]" = field(default_factory=dict[str, "array[int]"])
    values: "dict[str, array[float]]" = field(default_factory=dict[str, "array[float]"])

    def add(self, sample: Sample, ns: int) -> None:
        """Take a sample in."""
        self.count += 1
        self.frame = sample.frame
        for channel, row in sample.values.items():
            self.ns.setdefault(channel, array("q")).append(ns)
            self.values.setdefault(channel, array("d")).extend(row)

    def channels(self) -> dict[str, LogChannel]:
        """Return what there is, by channel."""
        return {
            channel: LogChannel(
                channel, np.array(ns), np.array(self.values[channel]).reshape(len(ns), -1)
            )
            for channel, ns in self.ns.items()
        }


@dataclass(slots=True)
class Topics:
    """All topics of a log: the rows of known types, of others how many messages there are."""

    meter: Meter
    counts: dict[tuple[str, str], int] = field(default_factory=dict[tuple[str, str], int])
    _rows: dict[tuple[str, str, str], _Rows] = field(
        default_factory=dict[tuple[str, str, str], _Rows]
    )
    broken: int = 0  # messages that were left out

    def declare(self, name: str, kind: str, count: int) -> None:
        """Note that a topic is there, and how many messages it has."""
        self.counts[name, kind] = self.counts.get((name, kind), 0) + count

    @property
    def notes(self) -> tuple[str, ...]:
        """Say what was left out."""
        return left_out(self.broken)

    def read(self, by: TopicReader, logged: int, raw: bytes, packed: Work | None = None) -> None:
        """Take a message in; ``packed``: it is, and what unpacking it may take."""
        try:
            data = unframed(raw, packed) if packed else raw
            self.meter.check(DECODED * len(data))
            samples = by.decoder(data)
        except ValueError:
            self.broken += 1
            return
        self.add(by.name, by.kind, logged, samples)

    def add(self, name: str, kind: str, logged: int, samples: Sequence[Sample]) -> None:
        """Take in what a message holds; ``logged``: ns, where it has no stamp itself."""
        for sample in samples:
            ns = sample.ns or logged
            if not 0 <= ns < LATEST:
                self.broken += 1
                continue
            key = name, kind, sample.part
            if key not in self._rows:
                self.meter.take(PART)
                self._rows[key] = _Rows()
            self.meter.take(ROW * len(sample.values))
            self._rows[key].add(sample, ns)

    def sources(self) -> list[Source]:
        """Return the sources, with what is the matter with those that cannot be used."""
        frames = {rows.frame for (_, kind, _), rows in self._rows.items() if kind in IN_LABORATORY}
        laboratories = LABORATORIES | (frames - {""})
        parts = Counter(key[:2] for key in self._rows)
        found = [
            _source(_name(*key, parts[key[:2]] > 1), key[1], rows, laboratories)
            for key, rows in self._rows.items()
        ]
        read = {(name, kind) for name, kind, _ in self._rows}
        return found + [Source(*key, n) for key, n in self.counts.items() if key not in read]


def left_out(count: int) -> tuple[str, ...]:
    """Say how many messages were left out."""
    return (f"{count} messages made no sense, or had an impossible time; left out.",) * (count > 0)


def _name(name: str, kind: str, part: str, several: bool) -> str:
    """Return a source's name: its child frame is in it where the topic has several."""
    return f"{name}:{part}" if kind in TREES or several else name


def _source(name: str, kind: str, rows: _Rows, laboratories: frozenset[str]) -> Source:
    if kind in TREES and all(len(set(ns)) < 2 for ns in rows.ns.values()):
        return Source(name, kind, rows.count, doubt="one stamp, so no motion")
    doubt = ""
    if kind in (TWIST, VECTOR) and rows.frame in laboratories:
        doubt = f"in the axes of '{rows.frame}'; --topic takes them for the body's"
    elif kind == VECTOR and SAYS_RATE.search(name) is None:
        doubt = "of what, it does not say; --topic takes it for the rate"
    return Source(name, kind, rows.count, rows.channels(), doubt=doubt)
