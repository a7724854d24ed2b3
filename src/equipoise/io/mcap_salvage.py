"""Every whole record of an MCAP file, whole, cut or garbled.

Format (public: mcap.dev/spec): magic, then records of an opcode (1 byte), a length (8 bytes, least
first) and content; messages stand in chunks, which have a checksum, and behind each chunk indexes
say how many messages it holds; at the end a footer, and the magic again. Where a record makes no
sense, the next that does is looked for: lengths above 4 GiB do not occur, so four zeros after
five bytes of which the first is an opcode are a place to try.
"""

import re
from collections.abc import Generator, Iterator
from dataclasses import dataclass, field
from io import BytesIO
from typing import Any

from equipoise.io.log_libraries import log_library

MAGIC = b"\x89MCAP0\r\n"
PLACE = re.compile(rb"[\x01-\x0f](?=.{4}\x00{4})", re.DOTALL)
HEAD = 9  # bytes of opcode and length


@dataclass(slots=True)
class Salvage:
    """What a file holds, and what of it is lost."""

    messages: list[Any] = field(default_factory=list[Any])  # mcap.records.Message, in file order
    channels: dict[int, Any] = field(default_factory=dict[int, Any])
    schemas: dict[int, Any] = field(default_factory=dict[int, Any])
    metadata: list[Any] = field(default_factory=list[Any])
    attachments: list[Any] = field(default_factory=list[Any])
    header: Any = None
    ended: bool = False  # the footer is there
    stated: int | None = None  # messages that the file itself says it holds
    indexed: int = 0  # messages that the indexes behind its chunks count
    lost_bytes: int = 0
    lost_places: int = 0
    orphans: int = 0  # messages whose channel is lost

    @property
    def whole(self) -> bool:
        """Say whether nothing is missing."""
        return self.ended and not self.lost_places and not self.orphans

    @property
    def lost_messages(self) -> int:
        """Return how many messages are known to be lost; of a cut-off end nothing is known."""
        counted = self.indexed if self.stated is None else self.stated
        return max(counted - len(self.messages), 0) or self.orphans


def salvaged(content: bytes, source: str) -> Salvage:
    """Return all that can be read; broken content is counted and never raises."""
    reading = _Reading(content, source)
    found = Salvage()
    for record in reading.records():
        _file_away(record, found)
    known = [m for m in found.messages if m.channel_id in found.channels]
    found.orphans = len(found.messages) - len(known)
    found.messages = known
    found.lost_bytes, found.lost_places = reading.lost_bytes, reading.lost_places
    found.ended = found.ended and content.endswith(MAGIC) and content.startswith(MAGIC)
    return found


def _file_away(record: Any, found: Salvage) -> None:
    match type(record).__name__:
        case "Message":
            found.messages.append(record)
        case "Channel":
            found.channels.setdefault(record.id, record)
        case "Schema":
            found.schemas.setdefault(record.id, record)
        case "Metadata":
            found.metadata.append(record)
        case "Attachment":
            found.attachments.append(record)
        case _:
            _count(record, found)


def _count(record: Any, found: Salvage) -> None:
    """Take in what a record says of the file itself."""
    match type(record).__name__:
        case "MessageIndex":
            found.indexed += len(record.records)
        case "Statistics":
            found.stated = record.message_count
        case "Header":
            found.header = found.header or record
        case "Footer":
            found.ended = True
        case _:
            pass


class _Reading:
    """A walk through a file's bytes that goes on behind what is broken."""

    def __init__(self, content: bytes, source: str) -> None:
        self._content = content
        self._stream_reader = log_library("mcap.stream_reader", source)
        self.lost_bytes = self.lost_places = 0

    def records(self) -> Iterator[Any]:
        """Yield the records, those of chunks in place of the chunks."""
        at = len(MAGIC) if self._content.startswith(MAGIC) else 0
        while at < len(self._content):
            end = yield from self._run(at)
            if end >= len(self._content):
                return
            at = self._next_place(end)
            self.lost_bytes += at - end
            self.lost_places += 1

    def _run(self, at: int) -> Generator[Any, None, int]:
        """Yield records from a place on; return where the last sound one ends."""
        stream = BytesIO(self._content)
        stream.seek(at)
        reader = self._stream_reader.StreamReader(
            stream, skip_magic=True, emit_chunks=True, record_size_limit=len(self._content)
        )
        try:
            for record in reader.records:
                inside = self._inside(record)
                at = stream.tell()
                yield from inside
        except Exception:  # a parser of broken bytes raises anything, MemoryError too
            return at
        return len(self._content)

    def _inside(self, record: Any) -> list[Any]:
        """Return a chunk's records, its checksum tested; another record is itself."""
        if type(record).__name__ != "Chunk":
            return [record]
        return self._stream_reader.breakup_chunk(record, validate_crc=True)

    def _next_place(self, after: int) -> int:
        """Return the next place where a record fits into what is left, or the end."""
        end = len(self._content)
        for place in PLACE.finditer(self._content, after + 1):
            at = place.start()
            size = int.from_bytes(self._content[at + 1 : at + HEAD], "little")
            if at + HEAD + size <= end and self._fits(at, size):
                return at
        return end

    def _fits(self, at: int, size: int) -> bool:
        """Say whether a record at a place makes sense from end to end."""
        stop = at + HEAD + size
        stream = BytesIO(self._content[at:stop])
        reader = self._stream_reader.StreamReader(stream, skip_magic=True, emit_chunks=True)
        try:
            record = next(reader.records)
            self._inside(record)
        except Exception:
            return False
        # A footer is followed by the magic; any other by a record or by the cut.
        return stream.tell() == len(stream.getvalue()) and self._followed(stop)

    def _followed(self, stop: int) -> bool:
        rest = self._content[stop : stop + HEAD]
        return len(rest) < HEAD or rest.startswith(MAGIC) or PLACE.match(rest) is not None
