"""Attitude and rate in telemetry logs of MAVLink (.tlog).

    ATTITUDE_QUATERNION  q1..q4 = w x y z, turns FRD body axes into NED; body rates rad/s
    ATTITUDE             roll, pitch, yaw: rad, 3-2-1; body rates rad/s
    HIGHRES_IMU          gyro rad/s; id is the sensor's number
    SCALED_IMU           gyro mrad/s; SCALED_IMU2 and 3 are the sensors number 1 and 2
    RAW_IMU              gyro without a unit; of ArduPilot, which sends mrad/s, id the number

Source: MAVLink common message set (mavlink.io); ArduPilot's GCS_MAVLink for the unit of RAW_IMU.
Rates beside an attitude have been through the vehicle's filters, so a gyro's go before them.

Rows have the times of the vehicle's clock, put where the ground station's clock has them: by the
message that came soonest. Some messages count from boot, others from 1970; clocks that agree within
a second are one. Where the vehicle restarted, the times of arrival count for all.
"""

from collections import Counter
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from equipoise.io.columns.column_map import ColumnMap
from equipoise.io.columns.read_options import ReadOptions
from equipoise.io.columns.table import Table
from equipoise.io.files.file_content import Content
from equipoise.io.formats.clock_units import PER_MS, PER_S, PER_US, nanoseconds
from equipoise.io.logs.counted_file import CountedFile
from equipoise.io.logs.flight_axes import flight_map
from equipoise.io.logs.log_sources import Source, chosen
from equipoise.io.logs.log_table import LogChannel, log_table
from equipoise.io.logs.log_topics import LATEST
from equipoise.io.logs.tlog_capture import tlog_pieces
from equipoise.maths.attitude import from_euler321
from equipoise.model.arrays import Ints
from equipoise.model.optional_libraries import extra_library
from equipoise.model.units import MILLI

Row = tuple[float, ...]
Sender = tuple[int, int]  # system and component
QUATERNION, ANGLES = "ATTITUDE_QUATERNION", "ATTITUDE"
HIGHRES, SCALED, RAW = "HIGHRES_IMU", "SCALED_IMU", "RAW_IMU"
BEST = {"attitude": (QUATERNION, ANGLES), "rate": (HIGHRES, SCALED, RAW, QUATERNION, ANGLES)}
KNOWN = frozenset((*BEST["attitude"], *BEST["rate"], "SCALED_IMU2", "SCALED_IMU3"))
GYRO = 0x38  # bits of HIGHRES_IMU.fields_updated: gyro x, y, z
SAME = PER_S  # ns, chosen: clocks that differ by less are one; a step back by more is a new start
MESSAGE = 850  # bytes of a row, here and in the tables made of it (chosen: measured are 770)
KIND = 500  # bytes of a kind of message and how many there are (chosen)
NO_AUTOPILOT, ARDUPILOT = 8, 3  # MAV_AUTOPILOT


@dataclass(frozen=True, slots=True)
class Message:
    """A message that may hold a row."""

    kind: str
    instance: int
    arrival: int  # ns since 1970
    stamp: int  # ns, by the vehicle's clock
    rows: Mapping[str, Row]  # attitude or rate, or both


@dataclass(slots=True)
class Telemetry:
    """What a log holds, by who sent it."""

    messages: dict[Sender, list[Message]]
    counts: dict[Sender, Counter[str]]
    autopilots: dict[Sender, int]  # kinds, of those that beat
    broken: int = 0  # places and messages that made no sense

    @property
    def vehicle(self) -> Sender | None:
        """Return the sender whose rows are taken: the first autopilot that has any, else any."""
        beating = [each for each in self.autopilots if each in self.messages]
        return next(iter((*beating, *self.messages, *self.counts)), None)


def read_tlog(content: Content, source: str, options: ReadOptions) -> tuple[Table, ColumnMap]:
    """Return a log's rows and what they mean; InputError if it holds none."""
    log = telemetry_of(content, source)
    vehicle = log.vehicle
    sources: list[Source] = []
    began_anew = False
    if vehicle is not None:
        sources, began_anew = _sources(log, vehicle)
    others = sum(len(rows) for sender, rows in log.messages.items() if sender != vehicle)
    notices = (
        (log.broken, f"The log is broken in {log.broken} places; left out."),
        (others, f"{others} rows of other systems or components were ignored."),
        (began_anew, "The vehicle's clock restarted; times are those at which rows arrived."),
    )
    channels, notes = chosen(sources, source, options, BEST)
    notes = (*(text for count, text in notices if count), *notes)
    return log_table(content.meter, channels, None, notes), flight_map(channels)


def telemetry_of(content: Content, source: str) -> Telemetry:
    """Return the messages of a log, broken ones left out."""
    dialect = extra_library("pymavlink.dialects.v20.common", source, "a log", "mavlink")
    parser, found = dialect.MAVLink(None), Telemetry({}, {}, {})
    for piece in tlog_pieces(CountedFile(content)):
        if piece.broken or piece.t is None:
            found.broken += 1
            continue
        name = _name(piece.data, dialect.mavlink_map)
        if name in KNOWN or name == "HEARTBEAT":
            try:
                message = parser.decode(bytearray(piece.data))
            except Exception:  # a parser of broken bytes raises anything
                found.broken += 1
                continue
            content.meter.take(MESSAGE)
            _take(found, message, nanoseconds(piece.t))
        else:
            counted = found.counts.setdefault(_sender(piece.data), Counter())
            content.meter.take(0 if name in counted else KIND)
            counted[name] += 1
    return found


def _name(frame: bytes, known: Mapping[int, Any]) -> str:
    number = frame[5] if frame[0] == 0xFE else int.from_bytes(frame[7:10], "little")
    return known[number].msgname if number in known else f"message {number}"


def _sender(frame: bytes) -> Sender:
    return (frame[3], frame[4]) if frame[0] == 0xFE else (frame[5], frame[6])


def _take(found: Telemetry, message: Any, arrival: int) -> None:
    kind: str = message.get_type()
    sender = message.get_srcSystem(), message.get_srcComponent()
    if kind == "HEARTBEAT":
        if message.autopilot != NO_AUTOPILOT:
            found.autopilots.setdefault(sender, message.autopilot)
        return
    base, number = (SCALED, int(kind[-1]) - 1) if kind[:-1] == SCALED else (kind, 0)
    counted = found.counts.setdefault(sender, Counter())
    counted[base] += 1
    rows, stamp = READ[base](message), _stamp(message)
    if stamp >= LATEST:
        found.broken += 1
    elif rows:
        instance = int(message.id) if base in (HIGHRES, RAW) else number
        of_sender = found.messages.setdefault(sender, [])
        of_sender.append(Message(base, instance, arrival, stamp, rows))


def _stamp(message: Any) -> int:
    """Return the time of the vehicle's clock, ns."""
    if hasattr(message, "time_boot_ms"):
        return int(message.time_boot_ms) * PER_MS
    return int(message.time_usec) * PER_US


def _turned(message: Any) -> Mapping[str, Row]:
    turn = (message.q1, message.q2, message.q3, message.q4)
    return _speeds(message) | ({"attitude": turn} if any(turn) else {})


def _angles(message: Any) -> Mapping[str, Row]:
    angles = (np.array([each]) for each in (message.roll, message.pitch, message.yaw))
    return _speeds(message) | {"attitude": tuple(from_euler321(*angles)[0].tolist())}


def _speeds(message: Any) -> dict[str, Row]:
    return {"rate": (message.rollspeed, message.pitchspeed, message.yawspeed)}


def _highres(message: Any) -> Mapping[str, Row]:
    fresh = message.fields_updated & GYRO == GYRO
    return {"rate": (message.xgyro, message.ygyro, message.zgyro)} if fresh else {}


def _milli(message: Any) -> Mapping[str, Row]:
    return {"rate": (message.xgyro * MILLI, message.ygyro * MILLI, message.zgyro * MILLI)}


READ: Mapping[str, Callable[[Any], Mapping[str, Row]]] = {
    QUATERNION: _turned,
    ANGLES: _angles,
    HIGHRES: _highres,
    SCALED: _milli,
    RAW: _milli,
}


def _sources(log: Telemetry, vehicle: Sender) -> tuple[list[Source], bool]:
    """Return the vehicle's sources, and whether its clock restarted."""
    groups: dict[tuple[str, int], list[Message]] = {}
    for message in log.messages.get(vehicle, []):
        groups.setdefault((message.kind, message.instance), []).append(message)
    times, began_anew = _times(groups)
    raw = "" if log.autopilots.get(vehicle) == ARDUPILOT else "in no known unit"
    found = [
        Source(kind, kind, len(messages), _channels(messages, times[kind, instance]), instance,
               raw if kind == RAW else "")
        for (kind, instance), messages in groups.items()
    ]  # fmt: skip
    with_rows = {kind for kind, _ in groups}
    counts = log.counts.get(vehicle, Counter[str]()).items()
    return found + [Source(k, k, n) for k, n in counts if k not in with_rows], began_anew


def _channels(messages: Sequence[Message], ns: Ints) -> dict[str, LogChannel]:
    found: dict[str, LogChannel] = {}
    for name in BEST:
        at = [k for k, message in enumerate(messages) if name in message.rows]
        if at:
            values = np.array([messages[k].rows[name] for k in at], dtype=np.float64)
            found[name] = LogChannel(name, ns[at], values)
    return found


def _times(
    groups: Mapping[tuple[str, int], Sequence[Message]],
) -> tuple[dict[tuple[str, int], Ints], bool]:
    """Return the times of each group, ns since 1970, and whether the vehicle restarted."""
    arrivals = {key: _whole(m.arrival for m in messages) for key, messages in groups.items()}
    stamps = {key: _whole(m.stamp for m in messages) for key, messages in groups.items()}
    if any((np.diff(ns) < -SAME).any() for ns in stamps.values()):
        return arrivals, True
    soonest = {key: int((arrivals[key] - ns).min()) for key, ns in stamps.items()}
    offset = {
        key: min(each for each in soonest.values() if abs(each - own) < SAME)
        for key, own in soonest.items()
    }
    return {key: ns + offset[key] for key, ns in stamps.items()}, False


def _whole(numbers: Iterator[int]) -> Ints:
    return np.array(list(numbers), dtype=np.int64)
