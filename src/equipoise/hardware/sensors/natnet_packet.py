"""Packets of NatNet 3.0 to 4.x, as OptiTrack's Motive sends them: little endian.

    packet         u16 kind, u16 size, payload of that size
    frame (7)      i32 number, sections, timecode 2 x u32, f64 s since Motive began,
                   three u64 of the cameras' clocks, from 4.1 on 2 x u32 of precise time,
                   i16 flags, i32 end
    section        i32 count; from 4.1 on i32 size in bytes; so many bodies, markers, ...
    rigid body     i32 id, position 3 x f32 m, quaternion x y z w 4 x f32, f32 mean error m,
                   i16 flags of which 1 says that it was tracked
    names (5)      i32 count; each i32 kind, from 4.1 on i32 size; of a body (kind 1) its name
                   ended by zero, i32 id, ...

Source: the public NatNet SDK, samples PacketClient and PythonClient. A frame does not say which
version it is of: it is of the one by which it ends where the packet ends.
"""

import struct
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass

CONNECT, SERVER, REQUEST_NAMES, NAMES, FRAME, ALIVE = 0, 1, 4, 5, 7, 10
HEAD = 4  # bytes before the payload
TRACKED = 1
BODY, MARKER, POINT = 38, 26, 12  # bytes
SUFFIX, PRECISE = 46, 54  # bytes after the sections, without and with precise time
RIGID_BODY = 1  # kind of a description


class BrokenPacket(Exception):
    """A packet that is of no known version."""


@dataclass(frozen=True, slots=True)
class Body:
    """A rigid body in a frame."""

    id: int
    turn: tuple[float, float, float, float]  # x, y, z, w
    tracked: bool


@dataclass(frozen=True, slots=True)
class Frame:
    """What is of use of a frame."""

    number: int
    stamp: float  # s
    bodies: tuple[Body, ...]


def packet(kind: int, payload: bytes) -> bytes:
    """Return a packet."""
    return struct.pack("<HH", kind, len(payload)) + payload


def opened(data: bytes) -> tuple[int, bytes]:
    """Return the kind and the payload of a packet."""
    if len(data) < HEAD or len(data) < HEAD + _size(data):
        raise BrokenPacket
    return int(struct.unpack_from("<H", data)[0]), data[HEAD : HEAD + _size(data)]


def cut_packets(chunks: Iterable[bytes]) -> Iterator[bytes]:
    """Yield packets that were saved one behind the other; a cut one at the end is no whole one."""
    data = b""
    for chunk in chunks:
        data, at = data + chunk, 0
        while len(data) - at >= HEAD and len(data) - at >= (size := HEAD + _size(data, at)):
            yield data[at : at + size]
            at += size
        data = data[at:]
    if data:
        yield data


def _size(data: bytes, at: int = 0) -> int:
    return int(struct.unpack_from("<H", data, at + 2)[0])


def frame_of(payload: bytes) -> Frame:
    """Return a frame of whichever version."""
    for read in (_frame_with_sizes, _frame_without):
        try:
            return read(Reader(payload))
        except (BrokenPacket, struct.error):
            continue
    raise BrokenPacket


def names_of(payload: bytes) -> dict[str, int]:
    """Return the ids of rigid bodies by name; of version 4.1 or later."""
    reader, found = Reader(payload), dict[str, int]()
    try:
        for _ in range(reader.count()):
            kind, part = reader.count(), Reader(reader.bytes(reader.count()))
            if kind == RIGID_BODY:
                name = part.name()
                found[name] = part.count()
    except struct.error as error:
        raise BrokenPacket from error
    if reader.left:
        raise BrokenPacket
    return found


class Reader:
    """Takes one value after the other; raises when there is no more."""

    def __init__(self, data: bytes) -> None:
        self._data, self._at = data, 0

    @property
    def left(self) -> int:
        """How many bytes have not been taken."""
        return len(self._data) - self._at

    def bytes(self, size: int) -> bytes:
        """Return so many bytes."""
        if size > self.left:
            raise BrokenPacket
        self._at += size
        return self._data[self._at - size : self._at]

    def count(self) -> int:
        """Return a whole number, not negative."""
        (value,) = struct.unpack("<i", self.bytes(4))
        if value < 0:
            raise BrokenPacket
        return int(value)

    def name(self) -> str:
        """Return a text that ends with zero."""
        text, end, _ = self._data[self._at :].partition(b"\0")
        if not end:
            raise BrokenPacket
        self._at += len(text) + 1
        return text.decode(errors="replace")


def _frame_with_sizes(reader: Reader) -> Frame:
    """Return a frame of 4.1 or later: eight sections, each with its size."""
    number = reader.count()
    sections: list[tuple[int, bytes]] = []
    for _ in range(8):  # marker sets, points, bodies, skeletons, assets, markers, plates, devices
        count = reader.count()
        sections.append((count, reader.bytes(reader.count())))
    count, bodies = sections[2]
    if len(bodies) != count * BODY or reader.left not in (SUFFIX, PRECISE):
        raise BrokenPacket
    return Frame(number, _stamp(reader), _bodies(bodies))


def _frame_without(reader: Reader) -> Frame:
    """Return a frame of 3.0 to 4.0, whose sections must be walked through."""
    number = reader.count()
    _each(reader, _skip_marker_set)
    reader.bytes(POINT * reader.count())
    bodies = reader.bytes(BODY * reader.count())
    _each(reader, _skip_skeleton)
    reader.bytes(MARKER * reader.count())
    _each(reader, _skip_channels)  # force plates
    _each(reader, _skip_channels)  # devices
    if reader.left != SUFFIX:
        raise BrokenPacket
    return Frame(number, _stamp(reader), _bodies(bodies))


def _each(reader: Reader, skip: Callable[[Reader], None]) -> None:
    for _ in range(reader.count()):
        skip(reader)


def _skip_marker_set(reader: Reader) -> None:
    reader.name()
    reader.bytes(POINT * reader.count())


def _skip_skeleton(reader: Reader) -> None:
    reader.bytes(4)
    reader.bytes(BODY * reader.count())


def _skip_channels(reader: Reader) -> None:
    reader.bytes(4)
    for _ in range(reader.count()):
        reader.bytes(4 * reader.count())


def _stamp(reader: Reader) -> float:
    reader.bytes(8)  # timecode
    return float(struct.unpack("<d", reader.bytes(8))[0])


def _bodies(data: bytes) -> tuple[Body, ...]:
    rows = struct.iter_unpack("<i3f4ffh", data)
    return tuple(Body(row[0], row[4:8], bool(row[9] & TRACKED)) for row in rows)
