"""A terminal's log of a VectorNav VN-100 or VN-200: ASCII messages behind the terminal's clock.

    14:03:21.001 -> $VNQMR,x,y,z,w,mx,my,mz,ax,ay,az,p,q,r*CS
    [14:03:21.001] $VNYMR,yaw,pitch,roll,...,p,q,r*CS

Source: VN-100 user manual, sections "Communication interface" and "Asynchronous outputs". CS is two
hex digits, the exclusive or of all bytes between $ and *, or four, CRC-16-CCITT. Quaternions come
vector first and turn sensor components into north-east-down ones; angles are yaw, pitch, roll in
degrees, 3-2-1; rates are rad/s. The messages hold no time, so a row has that of the terminal, which
restarts at midnight. Axes as in ``flight_axes``.
"""

import math
import re
from binascii import crc_hqx
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from functools import reduce

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
from equipoise.model.arrays import Floats
from equipoise.model.errors import InputError
from equipoise.model.units import DEG, US

BEGINNING = re.compile(rb"^[^\r\n$]{0,60}\$VN[A-Z]{3}[,*]", re.MULTILINE)
SAMPLE = 4096  # bytes, chosen: of the beginning, in which a message has to stand
CLOCK = re.compile(rb"(?<!\d)(\d{1,2}):(\d\d):(\d\d(?:[.,]\d{1,9})?)(?!\d)")
WIDTHS = {"VNQMR": 13, "VNQTN": 4, "VNYMR": 12, "VNYPR": 3, "VNGYR": 3}  # numbers of a message
BEST = {"attitude": ("VNQMR", "VNQTN", "VNYMR", "VNYPR"), "rate": ("VNQMR", "VNYMR", "VNGYR")}
QUATERNIONS = frozenset({"VNQMR", "VNQTN"})
DAY = 86_400.0  # s
LONGEST = 4096  # bytes of a line (chosen: thirty times what a message has)
ROW = 750  # bytes of a row, here and in the tables made of it (chosen: measured are 680)
AXES = "Axes: ahead, left, up of the sensor, whose own y and z point the other way."
MOST_BACK = 0.5  # share of the rows that may be behind the one before (chosen)


@dataclass(slots=True)
class Lines:
    """What a log's lines hold."""

    meter: Meter
    rows: dict[str, list[tuple[float, ...]]] = field(
        default_factory=dict[str, list[tuple[float, ...]]]
    )
    times: dict[str, list[float]] = field(default_factory=dict[str, list[float]])  # s
    broken: int = 0  # by their checksum or their numbers
    timeless: int = 0
    back: int = 0  # behind the line before
    _last: float = -1.0  # s, of the terminal's clock

    def take(self, line: bytes) -> None:
        """Take a line in, if it is a message of a known kind."""
        before, mark, _ = line.rpartition(b"$")
        body = _checked(line)
        if body is None:
            self.broken += bool(mark)
            return
        name, *numbers = body.decode("ascii", errors="replace").split(",")
        if name not in WIDTHS:
            return
        row = _numbers(numbers, WIDTHS[name])
        if row is None:
            self.broken += 1
            return
        t = self._time(before)
        if t is not None:
            self.meter.take(ROW)
            self.rows.setdefault(name, []).append(row)
            self.times.setdefault(name, []).append(t)

    def _time(self, before: bytes) -> float | None:
        """Return when a line came, s; None if that is not known, or it goes back."""
        found = CLOCK.search(before)
        if found is None:
            self.timeless += 1
            return None
        hours, minutes, seconds = found[1], found[2], found[3].replace(b",", b".")
        t = 3600.0 * int(hours) + 60.0 * int(minutes) + float(seconds)
        t += DAY * max(math.ceil((self._last - DAY / 2 - t) / DAY), 0)
        if t < self._last:
            self.back += 1
            return None
        self._last = t
        return t


def is_vectornav(content: bytes) -> bool:
    """Say whether a file begins as a log of a VectorNav."""
    return BEGINNING.search(content[:SAMPLE]) is not None


def read_vectornav(content: Content, source: str, options: ReadOptions) -> tuple[Table, ColumnMap]:
    """Return a log's rows and what they mean; InputError if it holds none, or no clock."""
    lines = Lines(content.meter)
    for line in lines_of(content):
        lines.take(line)
    _check_timed(lines, source)
    found = [
        Source(name, name, len(rows), _channels(name, rows, lines.times[name]))
        for name, rows in lines.rows.items()
    ]
    channels, notes = chosen(found, source, options, BEST)
    notes = (*_left(lines), *notes, AXES)
    return log_table(content.meter, channels, None, notes), flight_map(channels)


def lines_of(content: Content) -> Iterator[bytes]:
    """Yield a text's lines, however they end; of one that is too long the last bytes."""
    rest = b""
    for block in content.blocks():
        content.meter.check(0)
        *lines, rest = (rest + block).splitlines(keepends=True)
        yield from lines
        if rest.endswith((b"\r", b"\n")):
            yield rest
            rest = b""
        rest = rest[-LONGEST:]
    yield rest


def _left(lines: Lines) -> list[str]:
    """Return notes on lines that were left out."""
    notices = (
        (lines.broken, "were broken, by their checksum or their numbers; left out"),
        (lines.timeless, "had no time; left out"),
        (lines.back, "had a time before the last one's; left out"),
    )
    return [f"{count} lines {what}." for count, what in notices if count]


def _check_timed(lines: Lines, source: str) -> None:
    """Raise InputError if the lines do not say when they came."""
    timed = sum(map(len, lines.rows.values()))
    if lines.timeless and not timed:
        found = "messages of a VectorNav in lines without a clock, which hold no time themselves"
        wanted = (
            "a terminal's log with the time in front of each line, or the rate at which they came: "
            f"`equipoise convert {source} run.csv --as vectornav --rate-hz HZ`"
        )
        raise InputError(source, found, wanted)
    if lines.back > MOST_BACK * (timed + lines.back):
        found = f"{lines.back} of {timed + lines.back} lines with a time before the last one's"
        raise InputError(source, found, "times that grow from line to line")


def _channels(
    name: str, rows: Sequence[tuple[float, ...]], times: Sequence[float]
) -> dict[str, LogChannel]:
    numbers, found = np.array(rows, dtype=np.float64), dict[str, Floats]()
    if name in QUATERNIONS:
        found["attitude"] = numbers[:, [3, 0, 1, 2]]
    elif name in BEST["attitude"]:
        yaw, pitch, roll = (numbers[:, :3] * DEG).T
        found["attitude"] = from_euler321(roll, pitch, yaw)
    if name in BEST["rate"]:
        found["rate"] = numbers[:, -3:]
    us = np.round(np.array(times) / US)
    return {channel: channel_of(channel, us, values) for channel, values in found.items()}


def _numbers(texts: Sequence[str], width: int) -> tuple[float, ...] | None:
    """Return a message's numbers; None if it has another count, or one is none."""
    try:
        numbers = tuple(map(float, texts))
    except ValueError:
        return None
    return numbers if len(numbers) == width and np.isfinite(numbers).all() else None


def _checked(line: bytes) -> bytes | None:
    """Return what stands between $ and *; None if the checksum says that it is broken."""
    body, star, checksum = line.rpartition(b"$")[2].partition(b"*")
    checksum = checksum.strip()
    computed = {2: reduce(lambda a, b: a ^ b, body, 0), 4: crc_hqx(body, 0)}.get(len(checksum))
    try:
        return body if star and int(checksum, 16) == computed else None
    except ValueError:
        return None
