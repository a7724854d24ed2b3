"""The summary at the end of an MCAP file, with the place of every chunk, read from the file itself.

Format (public: mcap.dev/spec): records, those of a kind side by side; then where each kind begins;
then the footer, with a checksum of the summary and of the footer's own beginning; then the magic.
"""

import struct
import zlib
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass, field
from itertools import groupby
from pathlib import Path
from typing import BinaryIO

from equipoise.io.mcap.mcap_records import CODES, HEAD, KINDS, MAGIC

BLOCK = 65536  # bytes that are read, and written, at once (chosen)
CHUNK_FIELDS = struct.Struct("<QQQII")  # first time, last time, size, checksum, length of a name


@dataclass(slots=True)
class _Chunk:
    """A chunk and the message indexes behind it."""

    times: tuple[int, int]  # ns, of its first and its last message
    begin: int  # where it stands in the file
    length: int
    compression: bytes
    sizes: tuple[int, int]  # bytes, compressed and not
    indexes: dict[int, int] = field(default_factory=dict[int, int])  # of a channel: where it stands
    indexed: int = 0  # bytes of all of them

    def record(self) -> bytes:
        """Return its place in the file's index."""
        places = b"".join(struct.pack("<HQ", *place) for place in self.indexes.items())
        content = b"".join(
            (
                struct.pack("<QQQQI", *self.times, self.begin, self.length, len(places)), places,
                struct.pack("<QI", self.indexed, len(self.compression)), self.compression,
                struct.pack("<QQ", *self.sizes),
            )
        )  # fmt: skip
        return _head("ChunkIndex", len(content)) + content


def write_summary(
    path: str | Path, begin: int, known: Sequence[bytes], write: Callable[[bytes], object]
) -> None:
    """Write what follows DataEnd, which ends at byte ``begin``.

    ``known``: the summary's records but those of the chunks, which are looked up in the file.
    ``write`` appends to the file at ``path``; what it has taken can be read there, unless it was
    moved away. Then there is no summary, and readers go through the whole file.
    """
    if not Path(path).is_file():
        write(_head("Footer", 20) + bytes(20) + MAGIC)
        return
    end = _End(begin, write)
    kinds = sorted(known, key=lambda record: record[0])  # by opcode, in order otherwise
    for _, records in groupby(kinds, key=lambda record: record[0]):
        end.group(records)
    with Path(path).open("rb", buffering=BLOCK) as file:
        end.group(chunk.record() for chunk in _chunks(file))
    end.finish()


class _End:
    """The summary as it grows."""

    def __init__(self, begin: int, write: Callable[[bytes], object]) -> None:
        self._begin = self._at = begin
        self._write, self._waiting = write, bytearray()
        self._groups: list[bytes] = []  # where each kind of record begins and how long it is
        self._crc = 0

    def group(self, records: Iterable[bytes]) -> None:
        """Append all records of a kind."""
        begin, opcode = self._at, 0
        for record in records:
            opcode = record[0]
            self._append(record)
        if opcode:
            place = struct.pack("<BQQ", opcode, begin, self._at - begin)
            self._groups.append(_head("SummaryOffset", len(place)) + place)

    def finish(self) -> None:
        """Append where each kind begins, the footer and the magic."""
        offsets = self._at
        for place in self._groups:
            self._append(place)
        footer = _head("Footer", 20) + struct.pack("<QQ", self._begin, offsets)
        crc = zlib.crc32(footer, self._crc)
        self._append(footer + struct.pack("<I", crc) + MAGIC)
        self._write(bytes(self._waiting))

    def _append(self, data: bytes) -> None:
        self._at += len(data)
        self._crc = zlib.crc32(data, self._crc)
        self._waiting += data
        if len(self._waiting) > BLOCK:
            self._write(bytes(self._waiting))
            self._waiting.clear()


def _chunks(file: BinaryIO) -> Iterator[_Chunk]:
    """Yield the chunks of a data section, each with the indexes behind it."""
    chunk, at = None, len(MAGIC)
    while True:
        file.seek(at)
        opcode, length = struct.unpack("<BQ", file.read(HEAD))
        kind, size = KINDS[opcode], HEAD + length
        if kind == "MessageIndex" and chunk is not None:
            (channel,) = struct.unpack("<H", file.read(2))
            chunk.indexes[channel] = at
            chunk.indexed += size
        elif chunk is not None:
            yield chunk
            chunk = None
        if kind == "Chunk":
            chunk = _chunk(file, at, size)
        elif kind == "DataEnd":
            return
        at += size


def _chunk(file: BinaryIO, begin: int, length: int) -> _Chunk:
    """Return what a chunk says of itself in front of its messages."""
    first, last, plain, _, named = CHUNK_FIELDS.unpack(file.read(CHUNK_FIELDS.size))
    name = file.read(named)
    (packed,) = struct.unpack("<Q", file.read(8))
    return _Chunk((first, last), begin, length, name, (packed, plain))


def _head(kind: str, length: int) -> bytes:
    return struct.pack("<BQ", CODES[kind], length)
