"""Logs of PX4 (ULog): attitude and rate of the vehicle.

Topics (public: PX4's message reference), read by ``ulog_messages``:

    vehicle_attitude           q[0..3]: w x y z, turns FRD body axes into NED
    vehicle_angular_velocity   xyz[0..2]: rad/s, FRD, filtered; or, where that is not logged,
    sensor_combined            gyro_rad[0..2]: rad/s, FRD

Times are timestamp_sample where there is one, else timestamp, both microseconds since the board
started. FRD (x ahead, y right, z down) becomes ahead, left, up; NED becomes north, west, up: half
a turn about x on either side. So a platform that is level in the log is level here, and a
testbed's body axes are ahead, left, up of the board.
"""

from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from equipoise.io.columns.column_map import ColumnMap
from equipoise.io.formats.log_table import LogChannel, LogTable, log_map, log_table
from equipoise.io.formats.ulog_messages import ulog_topics

MAGIC = b"ULog\x01\x12\x35"
PER_US = 1000  # ns
LATEST_US = 2**62 // PER_US  # beyond, a count is no time (chosen)
# Topics and their columns; the first that is there is taken.
SOURCES = {
    "attitude": (("vehicle_attitude", tuple(f"q[{k}]" for k in range(4))),),
    "rate": (
        ("vehicle_angular_velocity", tuple(f"xyz[{k}]" for k in range(3))),
        ("sensor_combined", tuple(f"gyro_rad[{k}]" for k in range(3))),
    ),
}
FLU = ("x", "-y", "-z")  # ahead, left, up in terms of ahead, right, down


def read_ulog(content: bytes, source: str) -> tuple[LogTable, ColumnMap]:
    """Return a log's rows and what they mean; InputError if it holds none."""
    log = ulog_topics(content)
    channels: list[LogChannel] = []
    notes = ["The log is damaged: it was read as far as it is whole."] * (log.broken > 0)
    for name, topics in SOURCES.items():
        for topic, columns in topics:
            data = log.columns(topic)
            if {"timestamp", *columns} <= data.keys():
                channels.append(_channel(name, data, columns))
                notes.append(f"{name}: taken from topic '{topic}'.")
                break
    table = log_table(source, channels, None, tuple(notes))
    return table, log_map("ulog", channels, lab_up="-z", body=FLU)


def _channel(
    name: str, data: Mapping[str, NDArray[np.generic]], columns: tuple[str, ...]
) -> LogChannel:
    sampled = data.get("timestamp_sample", data["timestamp"])
    us = np.array(sampled if sampled.dtype.kind == "u" else [], dtype=np.uint64)
    timed = us < LATEST_US
    with np.errstate(invalid="ignore"):  # broken bytes may be a NaN that signals
        values = np.stack([np.array(data[each], dtype=np.float64) for each in columns], axis=1)
    return LogChannel(name, us[timed].astype(np.int64) * PER_US, values[: len(us)][timed])
