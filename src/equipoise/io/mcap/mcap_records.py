"""Records of an MCAP file, one by one (public: mcap.dev/spec).

A record is an opcode (1 byte), a length (8 bytes, least first) and content. Lengths above 4 GiB do
not occur, so four zeros after five bytes of which the first is an opcode are a place to try.
"""

import re
import struct
import zlib
from io import BytesIO
from typing import Any, NamedTuple

MAGIC = b"\x89MCAP0\r\n"
PLACE = re.compile(rb"[\x01-\x0f](?=.{4}\x00{4})", re.DOTALL)
HEAD = 9  # bytes of opcode and length
HEADING = struct.Struct("<BQ")
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
MESSAGE = struct.Struct("<HIQQ")  # channel, sequence, times of log and of publishing; then data
CHUNK = struct.Struct("<QQQII")  # first time, last time, size, checksum, length of a name
CHUNK_HEAD = CHUNK.size + 16  # bytes, with a name of eight letters
PARSED = 30  # bytes in memory for one of a record of names and values (chosen: names are short)


class Message(NamedTuple):
    """A message as it stands in the file."""

    channel_id: int
    sequence: int
    log_time: int  # ns
    publish_time: int  # ns
    data: bytes


class MessageIndex(NamedTuple):
    """How many messages of a channel a chunk holds, as the file says."""

    messages: int


class Packed(NamedTuple):
    """A chunk whose messages are still packed."""

    size: int  # bytes, unpacked, as stated
    crc: int  # of what is unpacked; 0: none
    compression: str
    data: memoryview


def message_in(data: bytes | memoryview, start: int, stop: int) -> Message:
    """Return the message whose content stands between two places; EOFError if there is none."""
    if stop - start < MESSAGE.size:
        raise EOFError
    channel, sequence, logged, published = MESSAGE.unpack_from(data, start)
    data = bytes(data[start + MESSAGE.size : stop])
    return Message(channel, sequence, logged, published, data)


def chunk_in(body: bytes) -> Packed:
    """Return the chunk in a record's content; raises if its lengths do not fit."""
    *_, size, crc, named = CHUNK.unpack_from(body)
    at = CHUNK.size + named
    (packed,) = struct.unpack_from("<Q", body, at)
    data = memoryview(body)[at + 8 : at + 8 + packed]
    if len(data) < packed:
        raise EOFError
    return Packed(size, crc, body[CHUNK.size : at].decode(), data)


def fits_chunk(head: bytes, length: int) -> bool:
    """Say whether the first bytes of a record's content are a chunk's of such a length."""
    try:
        *_, named = CHUNK.unpack_from(head)
        at = CHUNK.size + named
        return at + 8 + struct.unpack_from("<Q", head, at)[0] == length
    except struct.error:  # too short, or so long a name
        return False


def record_in(kind: str, body: bytes, library: Any) -> tuple[Any, bool]:
    """Return a record of another kind, and whether its own lengths fill the content exactly.

    ``library``: mcap.records. Raises whatever broken bytes make it raise.
    """
    if kind == "MessageIndex":
        (size,) = struct.unpack_from("<I", body, 2)
        return MessageIndex(size // 16), size + 6 == len(body)
    if kind == "Attachment" and zlib.crc32(memoryview(body)[:-4]) != _last(body):
        raise ValueError("checksum")
    stream = library.ReadDataStream(_Strict(body))
    record = getattr(library, kind).read(stream)
    return record, stream.count == len(body)


def _last(body: bytes) -> int:
    return int.from_bytes(body[-4:], "little")


class _Strict(BytesIO):
    """Bytes that are not read beyond their end."""

    def read(self, size: int | None = -1, /) -> bytes:
        """Return so many bytes, or raise."""
        found = super().read(size)
        if size is not None and len(found) < size:
            raise EOFError
        return found
