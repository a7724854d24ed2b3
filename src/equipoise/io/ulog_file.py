"""Logs of PX4 (ULog): attitude and rate of the vehicle.

Format (public: docs.px4.io/main/en/dev_log/ulog_file_format.html), read by pyulog. Topics:

    vehicle_attitude           q[0..3]: w x y z, turns FRD body axes into NED
    vehicle_angular_velocity   xyz[0..2]: rad/s, FRD, filtered; or, where that is not logged,
    sensor_combined            gyro_rad[0..2]: rad/s, FRD

Times are timestamp_sample where there is one, else timestamp, both microseconds since the board
started. FRD (x ahead, y right, z down) becomes our ahead, left, up; NED becomes north, west, up:
half a turn about x on either side. So a platform that is level in the log is level here, and a
testbed's body axes are ahead, left, up of the board.
"""

import contextlib
from io import BytesIO, StringIO
from typing import Any

import numpy as np

from equipoise.io.column_map import ColumnMap
from equipoise.io.log_libraries import log_library
from equipoise.io.log_table import LogChannel, LogTable, log_map, log_table
from equipoise.model.errors import InputError

MAGIC = b"ULog\x01\x12\x35"
PER_US = 1000  # ns
LATEST_US = 2**62 // PER_US  # beyond, a count is no time (chosen)
# Topic: its columns; the first that is there is taken.
SOURCES = {
    "attitude": (("vehicle_attitude", tuple(f"q[{k}]" for k in range(4))),),
    "rate": (
        ("vehicle_angular_velocity", tuple(f"xyz[{k}]" for k in range(3))),
        ("sensor_combined", tuple(f"gyro_rad[{k}]" for k in range(3))),
    ),
}
FLU = ("x", "-y", "-z")  # ahead, left, up in terms of ahead, right, down


def read_ulog(content: bytes, source: str) -> tuple[LogTable, ColumnMap]:
    """Return a log's rows and what they mean; InputError if it is broken or holds none."""
    core: Any = log_library("pyulog.core", source)
    wanted = [name for topics in SOURCES.values() for name, _ in topics]
    try:
        with contextlib.redirect_stdout(StringIO()):  # it prints its doubts
            log = core.ULog(BytesIO(content), wanted)
    except Exception as error:  # a parser of broken bytes raises anything
        raise InputError(source, f"a broken log ({error})", "a log of PX4 (ULog)") from error
    channels: list[LogChannel] = []
    notes = ["The log is damaged: it was read as far as it is whole."] * log.file_corruption
    for name, topics in SOURCES.items():
        for topic, columns in topics:
            data = _data(log, topic, columns)
            if data is not None:
                channels.append(_channel(name, data, columns))
                notes.append(f"{name}: taken from topic '{topic}'.")
                break
    table = log_table(source, channels, None, tuple(notes))
    return table, log_map("ulog", channels, lab_up="-z", body=FLU)


def _data(log: Any, topic: str, columns: tuple[str, ...]) -> Any:
    """Return the columns of a topic's first instance; None if they are not all there."""
    for each in log.data_list:
        if (
            each.name == topic
            and each.multi_id == 0
            and {"timestamp", *columns} <= each.data.keys()
        ):
            return each.data
    return None


def _channel(name: str, data: Any, columns: tuple[str, ...]) -> LogChannel:
    sampled = data.get("timestamp_sample", data["timestamp"])
    us = sampled if sampled.dtype.kind == "u" else data["timestamp"]
    timed = us < LATEST_US
    values = np.stack([np.asarray(data[column], dtype=np.float64) for column in columns], axis=1)
    return LogChannel(name, us[timed].astype(np.int64) * PER_US, values[timed])
