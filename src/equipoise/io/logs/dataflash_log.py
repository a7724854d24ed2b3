"""Logs that ArduPilot writes on board (dataflash, .bin): attitude, rate and acceleration.

Messages (public: ArduPilot's log message reference), of each channel the first that is logged:

    XKQ, NKQ   Q1..Q4, w x y z of the filter, C its core; XKQ1, XKQ2: core 0, 1 of old logs
    AHR2       Q1..Q4 of the filter in reserve
    ATT        Roll, Pitch, Yaw: deg, 3-2-1
    IMU, GYR   GyrX, GyrY, GyrZ: rad/s, I its number; IMU2, IMU3: number 1, 2 of old logs
    IMU, ACC   AccX, AccY, AccZ: m/s^2, FRD, at rest g upwards; I its number

The reference calls the quaternion a rotation from NED to the vehicle; its numbers are those of the
turn that takes components in the vehicle's axes, FRD, to NED ones (ArduPilot's own ``Tbn``). Times
are SampleUS where there is one, else TimeUS: microseconds since the board started.

Format (public: ArduPilot's AP_Logger), all numbers least byte first; messages without a checksum:

    A3 95 80   type, length (1 byte each), name (4), format (16), columns (64): a layout
    A3 95 type, then the fields of the layout's format, a letter each; the length counts all bytes

Broken bytes are stepped over, up to the next that begin as a message does.
"""

from collections import Counter
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field

import numpy as np

from equipoise.io.columns.column_map import ColumnMap
from equipoise.io.columns.read_options import ReadOptions
from equipoise.io.columns.table import Table
from equipoise.io.files.file_content import Content
from equipoise.io.files.reading_budget import Meter
from equipoise.io.logs.flight_axes import flight_map
from equipoise.io.logs.log_sources import Source, channel_of, chosen
from equipoise.io.logs.log_table import LogChannel, log_table
from equipoise.maths.attitude import from_euler321
from equipoise.model.arrays import Floats, Series1
from equipoise.model.units import DEG

MAGIC = b"\xa3\x95"
HEAD = 3  # bytes: magic and type
LAYOUT, LAYOUT_BYTES = 0x80, 89  # type and length of the message that declares a type
TYPES = {  # letter of a format: type of NumPy, unit
    "a": ("V64", 1.0), "b": ("<i1", 1.0), "B": ("<u1", 1.0), "h": ("<i2", 1.0), "H": ("<u2", 1.0),
    "i": ("<i4", 1.0), "I": ("<u4", 1.0), "f": ("<f4", 1.0), "g": ("<f2", 1.0), "d": ("<f8", 1.0),
    "n": ("V4", 1.0), "N": ("V16", 1.0), "Z": ("V64", 1.0), "c": ("<i2", 0.01), "C": ("<u2", 0.01),
    "e": ("<i4", 0.01), "E": ("<u4", 0.01), "L": ("<i4", 1e-7), "M": ("<u1", 1.0),
    "q": ("<i8", 1.0), "Q": ("<u8", 1.0),
}  # fmt: skip
BEST = {"attitude": ("XKQ", "NKQ", "AHR2", "ATT"), "rate": ("IMU", "GYR"),
        "accelerometer": ("IMU", "ACC")}  # fmt: skip
KNOWN = frozenset(kind for kinds in BEST.values() for kind in kinds)
NUMBERED = frozenset({"XKQ", "NKQ", "IMU", "GYR", "ACC"})
INSTANCE = {"XKQ": "C", "NKQ": "C", "IMU": "I", "GYR": "I", "ACC": "I"}
COUNTS = ("b", "B")  # letters of an instance's number
ROW = 150  # bytes of a row, here and in the tables made of it (chosen: measured are 90)
QUATERNION, ANGLES = ("Q1", "Q2", "Q3", "Q4"), ("Roll", "Pitch", "Yaw")
RATE, ACCELERATION = ("GyrX", "GyrY", "GyrZ"), ("AccX", "AccY", "AccZ")


@dataclass(frozen=True, slots=True)
class Layout:
    """What a type of message looks like."""

    name: str
    length: int  # bytes of all
    fields: tuple[tuple[str, str], ...]  # names and letters; none: it makes no sense

    def columns(self, rows: list[bytes]) -> dict[str, Series1]:
        """Return the numbers of messages, by field."""
        kind = np.dtype([(f"c{k}", TYPES[letter][0]) for k, (_, letter) in enumerate(self.fields)])
        table = np.frombuffer(b"".join(rows), dtype=kind)
        with np.errstate(invalid="ignore"):  # broken bytes may be a NaN that signals
            return {
                name: table[f"c{k}"].astype(np.float64) * TYPES[letter][1]
                for k, (name, letter) in enumerate(self.fields)
                if TYPES[letter][0][0] != "V"
            }


@dataclass(slots=True)
class Messages:
    """What a log holds: the rows of each type that is read, as bytes without their heads."""

    meter: Meter
    layouts: dict[int, Layout] = field(default_factory=dict[int, Layout])
    rows: dict[int, list[bytes]] = field(default_factory=dict[int, list[bytes]])
    counts: Counter[int] = field(default_factory=Counter[int])  # rows of all types
    broken: int = 0  # places that made no sense


def read_dataflash(content: Content, source: str, options: ReadOptions) -> tuple[Table, ColumnMap]:
    """Return a log's rows and what they mean; InputError if it holds none."""
    log = messages_of(content)
    damaged = ["The log is damaged: it was read as far as it is whole."] * (log.broken > 0)
    channels, notes = chosen(list(_sources(log)), source, options, BEST)
    return log_table(content.meter, channels, None, (*damaged, *notes)), flight_map(channels)


def messages_of(content: Content) -> Messages:
    """Return the messages of a log, broken ones left out."""
    found, at = Messages(content.meter, {LAYOUT: Layout("FMT", LAYOUT_BYTES, ())}), 0
    while at + HEAD <= len(content):
        content.meter.check(0)
        head = content[at : at + HEAD]
        layout = found.layouts.get(head[2]) if head.startswith(MAGIC) else None
        if layout is None or at + layout.length > len(content):
            found.broken += 1
            at = content.find(MAGIC, at + 1)
            if at < 0:
                break
            continue
        _take(found, head[2], content[at + HEAD : at + layout.length])
        at += layout.length
    return found


def _take(found: Messages, kind: int, body: bytes) -> None:
    if kind != LAYOUT:
        found.counts[kind] += 1
        if _instance(found.layouts[kind].name)[0] in KNOWN:
            found.meter.take(ROW + 2 * len(body))
            found.rows.setdefault(kind, []).append(body)
        return
    number, length = body[:2]
    name, letters, columns = (_text(body[a:b]) for a, b in ((2, 6), (6, 22), (22, 86)))
    if length < HEAD or not name:
        found.broken += 1
        return
    fields = tuple(zip(columns.split(","), letters, strict=False))
    size = sum(np.dtype(TYPES[letter][0]).itemsize for letter in letters if letter in TYPES)
    sound = set(letters) <= TYPES.keys() and len(fields) == len(letters) and size == length - HEAD
    found.layouts.setdefault(number, Layout(name, length, fields if sound else ()))


def _text(data: bytes) -> str:
    return data.partition(b"\0")[0].decode("ascii", errors="replace")


def _sources(log: Messages) -> Iterator[Source]:
    """Yield every type of message; of those that are read every instance."""
    for number, count in log.counts.items():
        layout = log.layouts[number]
        name, instance = _instance(layout.name)
        if name not in KNOWN or not layout.fields:
            yield Source(layout.name, layout.name, count)
            continue
        columns = layout.columns(log.rows[number])
        counted = dict(layout.fields).get(INSTANCE.get(name, "")) in COUNTS
        which = columns[INSTANCE[name]] if counted else np.full(count, float(instance))
        for each in np.unique(which).tolist():
            part = {key: values[which == each] for key, values in columns.items()}
            count = int((which == each).sum())
            yield Source(name, name, count, _channels(part), int(each))


def _instance(name: str) -> tuple[str, int]:
    """Return a type's name and instance: IMU2 of old logs is number 1."""
    base, number = name[:-1], name[-1:]
    numbered = base in NUMBERED and number in ("1", "2", "3")
    return (base, int(number) - 1) if numbered else (name, 0)


def _channels(columns: Mapping[str, Series1]) -> dict[str, LogChannel]:
    """Return attitude, rate and acceleration of the columns of a message, as far as it has them."""
    us = columns.get("SampleUS", columns.get("TimeUS"))
    if us is None:
        return {}
    found: dict[str, Floats] = {}
    if columns.keys() >= set(QUATERNION):
        found["attitude"] = np.stack([columns[name] for name in QUATERNION], axis=1)
    elif columns.keys() >= set(ANGLES):
        found["attitude"] = from_euler321(*(columns[name] * DEG for name in ANGLES))
    if columns.keys() >= set(RATE):
        found["rate"] = np.stack([columns[name] for name in RATE], axis=1)
    if columns.keys() >= set(ACCELERATION):
        found["accelerometer"] = np.stack([columns[name] for name in ACCELERATION], axis=1)
    return {name: channel_of(name, us, values) for name, values in found.items()}
