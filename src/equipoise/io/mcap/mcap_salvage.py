"""Every whole record of an MCAP file, whole, cut or garbled.

Format (public: mcap.dev/spec): magic, then records of an opcode (1 byte), a length (8 bytes, least
first) and content; messages stand in chunks, which have a checksum, and behind each chunk indexes
say how many messages it holds; at the end a footer, and the magic again. Where a record makes no
sense, the next that does is sought: lengths above 4 GiB do not occur, so four zeros after
five bytes of which the first is an opcode are a place to try.
"""

import re
import zlib
from collections.abc import Iterator
from dataclasses import dataclass, field
from io import BytesIO
from typing import Any

from equipoise.io.files.file_content import Content
from equipoise.io.formats.optional_libraries import log_library

MAGIC = b"\x89MCAP0\r\n"
PLACE = re.compile(rb"[\x01-\x0f](?=.{4}\x00{4})", re.DOTALL)
HEAD = 9  # bytes of opcode and length
KINDS = dict(
    enumerate(
        (
            "Header", "Footer", "Schema", "Channel", "Message", "Chunk", "MessageIndex",
            "ChunkIndex", "Attachment", "AttachmentIndex", "Statistics", "Metadata",
            "MetadataIndex", "SummaryOffset", "DataEnd",
        ),
        start=1,
    )
)  # fmt: skip
CODES = {kind: code for code, kind in KINDS.items()}


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
    findable: bool = False  # an index says where its chunks are
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


def salvaged(content: Content, source: str) -> Salvage:
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
        case "ChunkIndex":
            found.findable = True
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

    def __init__(self, content: Content, source: str) -> None:
        self._content = content.whole()
        self._records = log_library("mcap.records", source)
        self._stream = log_library("mcap.data_stream", source).ReadDataStream
        self._breakup = log_library("mcap.stream_reader", source).breakup_chunk
        self.lost_bytes = self.lost_places = 0

    def records(self) -> Iterator[Any]:
        """Yield the records, those of chunks in place of the chunks."""
        at = len(MAGIC) if self._content.startswith(MAGIC) else 0
        while at < len(self._content) and self._content[at:] != MAGIC:
            found, stop = self._record(at)
            if found is None:
                stop = self._next_place(at)
                self.lost_bytes += stop - at
                self.lost_places += 1
            else:
                yield from found
            at = stop

    def _next_place(self, after: int) -> int:
        """Return the next place where a record makes sense, or the end."""
        for place in PLACE.finditer(self._content, after + 1):
            if self._record(place.start())[0] is not None:
                return place.start()
        return len(self._content)

    def _record(self, at: int) -> tuple[list[Any] | None, int]:
        """Return the record at a place, or those of a chunk, and where it ends; None: no record."""
        stop = at + HEAD + int.from_bytes(self._content[at + 1 : at + HEAD], "little")
        if stop > len(self._content):
            return None, stop
        body = self._content[at + HEAD : stop]
        try:
            found, exact = self._read(self._content[at], body)
        except Exception:  # a parser of broken bytes raises anything, MemoryError too
            return None, stop
        return (found if exact or self._followed(stop) else None), stop

    def _read(self, opcode: int, body: bytes) -> tuple[list[Any], bool]:
        """Return what a record holds, and whether its own lengths fill it exactly.

        A record may have more at its end, of a later version of the format, and there may be
        records of other kinds; either is accepted only if another record follows.
        """
        kind = KINDS.get(opcode)
        if kind is None:
            return [], False
        stream = self._stream(_Strict(body))
        if kind == "Message":  # it has no length of its own
            return [self._records.Message.read(stream, len(body))], False
        record = getattr(self._records, kind).read(stream)
        if kind == "Chunk":
            return self._breakup(record, validate_crc=True), True
        if kind == "Attachment" and zlib.crc32(body[:-4]).to_bytes(4, "little") != body[-4:]:
            raise ValueError("checksum")
        return [record], stream.count == len(body)

    def _followed(self, stop: int) -> bool:
        """Say whether a record, the magic or the cut follows."""
        rest = self._content[stop : stop + HEAD]
        return len(rest) < HEAD or PLACE.match(rest) is not None


class _Strict(BytesIO):
    """Bytes that are not read beyond their end."""

    def read(self, size: int | None = -1, /) -> bytes:
        """Return so many bytes, or raise."""
        found = super().read(size)
        if size is not None and len(found) < size:
            raise EOFError
        return found
