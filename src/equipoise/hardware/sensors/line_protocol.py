"""Lines that a microcontroller prints: a row of CSV or an object of JSON each.

    12345,0.7071,0.0000,0.0000,0.7071,0.12,-0.05,3.40       format = "csv"
    {"t_ms": 12345, "imu": {"qw": 0.7071, ...}}             format = "json"

What the columns are stands in the unit's settings, see ``columns``:

    columns = ["t_ms", "qw", "qx", "qy", "qz", "gx_deg_s", "gy_deg_s", "gz_deg_s"]

CSV is parted by commas, semicolons, tabs or spaces. In JSON a column names its key, with the keys
around it before dots; where the key has another name it stands behind an equals sign:
"imu.qw", or "qw=imu.quaternion.w".

There is no checksum: a number that is garbled into another number is a row. Numbers that arrive
before the first end of line are void, since the line may have lost its beginning. A datagram or a
message holds whole lines.
"""

import json
import re
from collections.abc import Mapping, Sequence
from typing import Any, cast

from equipoise.hardware.sensors.columns import SKIPPED, columns_of
from equipoise.hardware.sensors.settings import Settings
from equipoise.hardware.transport.conversation import SensorDriver
from equipoise.hardware.transport.finite_numbers import all_finite
from equipoise.hardware.transport.line_splitter import Lines
from equipoise.model.hardware import SensorUnit
from equipoise.model.reading import Reading

KEYS = ("format", "columns", "send")
FORMATS = ("csv", "json")
PARTED = re.compile(rb"\s*[,;]\s*|\s+")
WORDS = re.compile(rb"[#A-Za-z]")  # a heading or a remark begins so, a row of numbers does not
WHOLE = ("udp:", "udpout:", "ws:", "wss:")  # ports whose messages hold whole lines

Numbers = dict[str, float]


class LineProtocol(SensorDriver):
    """The conversation; settings: ``format``, ``columns``, and a line to ``send`` at opening.

    It is sent again until there is a row: a board that restarts when its port is opened does not
    hear what is sent at once.
    """

    def __init__(self, unit: SensorUnit) -> None:
        settings = Settings(unit, KEYS)
        self._send = settings.text("send")
        super().__init__({self._send: self._send.encode() + b"\n"} if self._send else {})
        form = settings.text("format", "csv", FORMATS)
        columns = [declared(column) for column in settings.names("columns")]
        self._columns = columns_of(unit, settings, [name for name, _ in columns])
        for name, key in columns:
            if form == "csv" and name != key:
                raise settings.wrong(f"column '{key}'", 'format = "json" for keys')
        self._read = _Json(columns) if form == "json" else _Csv([name for name, _ in columns])
        self._lines, self._begun = Lines(), False
        self._whole = unit.port.address.startswith(WHOLE)

    def opened(self) -> None:
        """Restart."""
        super().opened()
        self._lines.cleared()
        self._begun = not self._whole

    def feed(self, data: bytes) -> Sequence[Reading]:
        """Return the rows that are complete with these bytes."""
        if self._begun:
            _, end, data = data.replace(b"\r", b"\n").partition(b"\n")
            self._begun = not end
        dropped = self._lines.dropped
        lines = self._lines.cut(data + b"\n" if self._whole else data)
        if self._lines.dropped > dropped:  # one that was too long to be any
            self.count(corrupt=1)
        return [reading for line in lines for reading in self._line(line)]

    def _line(self, line: bytes) -> list[Reading]:
        row = self._read(line)
        if row == {}:
            return self.counted(None)
        readings = [] if row is None else self._columns.readings(row)
        if readings:
            self.requests.confirmed(self._send)
        return self.counted(readings)


class _Csv:
    """A row of numbers, by place."""

    def __init__(self, names: list[str]) -> None:
        self._names = names

    def __call__(self, line: bytes) -> Numbers | None:
        """Return the numbers by name; empty for words, None if it is no such row."""
        line = line.strip()
        if WORDS.match(line) and self._names[:1] != [SKIPPED]:
            return {}
        fields = PARTED.split(line)
        if len(fields) != len(self._names):
            return None
        wanted = zip(self._names, fields, strict=True)
        return _finite({name: field for name, field in wanted if name != SKIPPED})


class _Json:
    """An object, by keys."""

    def __init__(self, columns: Sequence[tuple[str, str]]) -> None:
        self._paths = {name: key.split(".") for name, key in columns if name != SKIPPED}

    def __call__(self, line: bytes) -> Numbers | None:
        """Return the numbers by name; empty if there are none of ours, None if it is broken."""
        try:
            message = json.loads(line)
        except (ValueError, RecursionError):
            return None
        found = {name: _at(message, path) for name, path in self._paths.items()}
        if all(value is None for value in found.values()):
            return {}
        plain = all(type(value) in (int, float) for value in found.values())
        return _finite(found) if plain else None


def declared(column: str) -> tuple[str, str]:
    """Return a column's name and its key: "qw=imu.q.w", "imu.qw" or "qw"."""
    name, equals, key = column.partition("=")
    return (name, key) if equals else (column.rpartition(".")[2], column)


def _at(message: Any, path: Sequence[str]) -> Any:
    """Return what stands at a path; None if nothing does."""
    for key in path:
        if not isinstance(message, dict):
            return None
        message = cast("dict[str, Any]", message).get(key)
    return message


def _finite(fields: Mapping[str, Any]) -> Numbers | None:
    values = all_finite(fields.values())
    return None if values is None else dict(zip(fields, values, strict=True))
