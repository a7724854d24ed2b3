"""Logs of PX4 (ULog): attitude, rate and acceleration of the vehicle.

Topics (public: PX4's message reference), of each channel the first that is logged:

    vehicle_attitude              q[0..3]: w x y z, turns FRD body axes into NED
    vehicle_attitude_groundtruth  q[0..3], of a simulator
    vehicle_visual_odometry       q[0..3], into NED or a frame that has turned from it about down
    vehicle_odometry              q[0..3], likewise
    vehicle_angular_velocity      xyz[0..2]: rad/s, FRD, filtered
    sensor_combined               gyro_rad[0..2]: rad/s, FRD
    sensor_gyro                   x, y, z: rad/s, FRD
    vehicle_acceleration          xyz[0..2]: m/s^2, FRD, with gravity: at rest g upwards
    sensor_combined               accelerometer_m_s2[0..2]: likewise
    sensor_accel                  x, y, z: likewise

A topic may have several instances, one for each sensor: the lowest that has rows, unless stated.

Times are timestamp_sample where there is one, else timestamp, both microseconds since the board
started. Axes as in ``flight_axes``.

Format (public: docs.px4.io/main/en/dev_log/ulog_file_format.html), all numbers least byte first: a
header of 16 bytes (magic, version, time); messages of a length (2 bytes, of the body), a type (1
byte) and a body:

    F   a topic's layout as text: "name:type field;type[n] field;..."; types may be layouts
    A   a subscription: instance (1 byte), number (2 bytes), name
    D   a row: number (2 bytes), the fields in order
    S   eight bytes that never stand elsewhere: a place to go on after broken ones

All other types are passed over. Fields named _padding at the end may be left out of a row.
Broken bytes are stepped over.
"""

import struct
from collections import Counter
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from equipoise.io.columns.column_map import ColumnMap
from equipoise.io.columns.read_options import ReadOptions
from equipoise.io.columns.table import Table
from equipoise.io.files.file_content import Content
from equipoise.io.files.reading_budget import Meter
from equipoise.io.logs.flight_axes import flight_map
from equipoise.io.logs.log_sources import Source, channel_of, chosen
from equipoise.io.logs.log_table import LogChannel, log_table
from equipoise.io.logs.ulog_layout import flat_layout

MAGIC = b"ULog\x01\x12\x35"
Q = tuple(f"q[{k}]" for k in range(4))
# Topics and their columns, the best first.
SOURCES = {
    "attitude": {
        "vehicle_attitude": Q,
        "vehicle_attitude_groundtruth": Q,
        "vehicle_visual_odometry": Q,
        "vehicle_odometry": Q,
    },
    "rate": {
        "vehicle_angular_velocity": tuple(f"xyz[{k}]" for k in range(3)),
        "sensor_combined": tuple(f"gyro_rad[{k}]" for k in range(3)),
        "sensor_gyro": ("x", "y", "z"),
    },
    "accelerometer": {
        "vehicle_acceleration": tuple(f"xyz[{k}]" for k in range(3)),
        "sensor_combined": tuple(f"accelerometer_m_s2[{k}]" for k in range(3)),
        "sensor_accel": ("x", "y", "z"),
    },
}
BEST = {channel: tuple(topics) for channel, topics in SOURCES.items()}
HEADER = 16  # bytes
SYNC = b"\x2f\x73\x13\x20\x25\x0c\xbb\x12"
KINDS = frozenset(b"BFIMPQADSOLCR")  # of messages
DECLARED = 1000  # bytes of a layout or a subscription, beside its text (chosen)
ROW = 150  # bytes of a row, here and in the tables made of it (chosen: measured are 110)
KNOWN = frozenset(topic for topics in SOURCES.values() for topic in topics)
Instance = tuple[str, int]  # of a topic


def read_ulog(content: Content, source: str, options: ReadOptions) -> tuple[Table, ColumnMap]:
    """Return a log's rows and what they mean; InputError if it holds none."""
    log = ulog_topics(content)
    damaged = ["The log is damaged: it was read as far as it is whole."] * (log.broken > 0)
    channels, notes = chosen(list(_sources(log)), source, options, BEST)
    table = log_table(content.meter, channels, None, (*damaged, *notes))
    return table, flight_map(channels)


def _sources(log: "UlogTopics") -> Iterator[Source]:
    """Yield every instance of every topic that is logged."""
    for (topic, instance), count in log.counts.items():
        data, channels = log.columns(topic, instance), dict[str, LogChannel]()
        for name, topics in SOURCES.items():
            if topic in topics and {"timestamp", *topics[topic]} <= data.keys():
                channels[name] = _channel(name, data, topics[topic])
        yield Source(topic, topic, count, channels, instance)


def _channel(
    name: str, data: Mapping[str, NDArray[np.generic]], columns: tuple[str, ...]
) -> LogChannel:
    sampled = data.get("timestamp_sample", data["timestamp"])
    if sampled.dtype.kind != "u":
        sampled = np.full(len(sampled), -1.0)
    with np.errstate(invalid="ignore"):  # broken bytes may be a NaN that signals
        values = np.stack([np.array(data[each], dtype=np.float64) for each in columns], axis=1)
    return channel_of(name, np.array(sampled, dtype=np.float64), values)


@dataclass(slots=True)
class UlogTopics:
    """What a file's topics hold: rows of those that are read, as bytes until asked for."""

    meter: Meter
    layouts: dict[str, str] = field(default_factory=dict[str, str])
    numbers: dict[int, Instance] = field(default_factory=dict[int, Instance])  # of subscriptions
    rows: dict[Instance, list[bytes]] = field(default_factory=dict[Instance, list[bytes]])
    counts: Counter[Instance] = field(default_factory=Counter[Instance])  # rows of all topics
    broken: int = 0  # places that made no sense

    def columns(self, topic: str, instance: int = 0) -> dict[str, NDArray[np.generic]]:
        """Return a topic's columns, 'q[0]' of an array; none if it is not there."""
        rows = self.rows.get((topic, instance), [])
        flat = flat_layout(self.layouts, topic) if rows else ()
        if not flat:
            return {}
        kind = np.dtype([(f"c{k}", type_) for k, (_, type_) in enumerate(flat)])
        whole = b"".join(row[: kind.itemsize] for row in rows if len(row) >= kind.itemsize)
        table = np.frombuffer(whole, dtype=kind)
        return {name: table[f"c{k}"] for k, (name, _) in enumerate(flat)}


def ulog_topics(content: Content) -> UlogTopics:
    """Return the topics of a file that begins as a ULog does."""
    found, at = UlogTopics(content.meter), HEADER
    while at + 3 <= len(content):
        content.meter.check(0)
        size, kind = struct.unpack("<HB", content[at : at + 3])
        if kind not in KINDS or at + 3 + size > len(content):
            found.broken += 1
            place = content.find(SYNC, at)
            if place < 0:
                break
            at = place + len(SYNC)
            continue
        _take(found, kind, content[at + 3 : at + 3 + size])
        at += 3 + size
    return found


def _take(found: UlogTopics, kind: int, body: bytes) -> None:
    if kind == ord("F"):
        name, _, layout = body.decode("ascii", errors="replace").partition(":")
        found.meter.take(DECLARED + len(body))
        found.layouts.setdefault(name, layout)
    elif kind == ord("A") and len(body) > 3:
        subscribed = body[3:].decode(errors="replace"), body[0]
        found.meter.take(DECLARED + len(body))
        found.numbers.setdefault(int.from_bytes(body[1:3], "little"), subscribed)
    elif kind == ord("D") and len(body) > 2:
        topic = found.numbers.get(int.from_bytes(body[:2], "little"))
        if topic is not None:
            _take_row(found, topic, body[2:])


def _take_row(found: UlogTopics, topic: Instance, row: bytes) -> None:
    found.counts[topic] += 1
    if topic[0] in KNOWN:
        found.meter.take(ROW + 2 * len(row))
        found.rows.setdefault(topic, []).append(row)
