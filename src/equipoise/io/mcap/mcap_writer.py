"""An MCAP file written from its beginning to its end, in memory that does not grow with it.

Libraries keep an entry for each chunk until a file is closed, and one for each of its channels: 20
MB in 8 h of two chunks a second, an eighth of the process. Here nothing is kept of a chunk that is
written: when the file ends, its chunks are read once from record to record, and the index goes to
the disk as it is found (``mcap_summary``). A file that is never ended has no summary, and readers
go through it. A channel stands in the file from when it is opened, before its first message.

Format (public: mcap.dev/spec): magic, header; schemas and channels; chunks, each compressed by
Zstandard with a checksum, with an index of its messages by channel behind it; DataEnd; the summary.
"""

import struct
import zlib
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

from equipoise.io.formats.optional_libraries import log_library
from equipoise.io.mcap.mcap_records import CODES, MAGIC
from equipoise.io.mcap.mcap_summary import write_summary
from equipoise.model.version import __version__

LARGEST = 1_000_000  # bytes of a chunk's messages, beyond which it is written (chosen)
MESSAGE = struct.Struct("<BQHIQQ")  # opcode, length, channel, number, log time, publish time
FIELDS = MESSAGE.size - 9  # bytes of a message's content in front of its data


class McapWriter:
    """Hands the file's bytes, in order, to ``write``."""

    def __init__(self, write: Callable[[bytes], object], source: str) -> None:
        """Begin the file; ``source`` is what an error calls it."""
        self._hand_on = write
        self._records = log_library("mcap.records", source)
        self._builder = log_library("mcap.data_stream", source).RecordBuilder
        self._zstd = log_library("zstandard", source).ZstdCompressor()
        self._at = self._crc = 0
        self._opened: list[Any] = []  # schemas and channels
        self._places: list[Any] = []  # of metadata and attachments
        self._chunk = bytearray()
        self._indexes: dict[int, list[tuple[int, int]]] = {}  # of this chunk: time, offset
        self._counts: dict[int, int] = {}  # messages by channel
        self._chunks, self._span = 0, (0, 0)  # ns, of all messages
        library = f"equipoise {__version__}"
        self._write(MAGIC + self._bytes(self._records.Header(profile="", library=library)))

    def metadata(self, name: str, message: Mapping[str, str]) -> None:
        """Write keys and texts."""
        data = self._bytes(self._records.Metadata(name=name, metadata=dict(message)))
        place = self._records.MetadataIndex(offset=self._at, length=len(data), name=name)
        self._places.append(place)
        self._write(data)

    def attach(self, name: str, media_type: str, ns: int, content: bytes) -> None:
        """Write a file within the file."""
        kind, stated = self._records, {"log_time": ns, "create_time": ns, "name": name}
        stated["media_type"] = media_type
        data = self._bytes(kind.Attachment(data=content, **stated))
        place = kind.AttachmentIndex(
            offset=self._at, length=len(data), data_size=len(content), **stated
        )
        self._places.append(place)
        self._write(data)

    def channel(
        self, topic: str, encoding: str, schema: Any, metadata: Mapping[str, str]
    ) -> Callable[[bytes, int], None]:
        """Open a topic; return what takes a message and its time, ns.

        ``schema`` has a name, an encoding and data. It stands in front of the chunk that grows.
        """
        number = len(self._opened) // 2 + 1
        pair = (
            self._records.Schema(
                id=number, name=schema.name, encoding=schema.encoding, data=schema.data
            ),
            self._records.Channel(
                id=number, topic=topic, message_encoding=encoding, metadata=dict(metadata),
                schema_id=number,
            ),
        )  # fmt: skip
        self._write(b"".join(map(self._bytes, pair)))
        self._opened += pair
        self._counts[number] = 0
        return lambda data, ns: self._message(number, data, ns)

    def flush(self) -> None:
        """End the chunk, if it holds anything, and hand it on in one piece."""
        if not self._chunk:
            return
        times = [ns for entries in self._indexes.values() for ns, _ in entries]
        least, greatest = min(times), max(times)
        known = self._span if self._chunks else (least, greatest)
        data = self._chunk_record(least, greatest) + b"".join(
            self._bytes(self._records.MessageIndex(channel_id=number, records=entries))
            for number, entries in self._indexes.items()
        )
        self._chunk, self._indexes = bytearray(), {}
        self._chunks += 1
        self._span = min(known[0], least), max(known[1], greatest)
        self._write(data)

    def finish(self, path: str | Path) -> None:
        """End the file, which stands at ``path``, with its summary."""
        self.flush()
        records = self._records
        statistics = records.Statistics(
            message_count=sum(self._counts.values()), schema_count=len(self._counts),
            channel_count=len(self._counts), chunk_count=self._chunks,
            attachment_count=sum(isinstance(p, records.AttachmentIndex) for p in self._places),
            metadata_count=sum(isinstance(p, records.MetadataIndex) for p in self._places),
            message_start_time=self._span[0], message_end_time=self._span[1],
            channel_message_counts={k: n for k, n in self._counts.items() if n},
        )  # fmt: skip
        known = [self._bytes(each) for each in (*self._opened, statistics, *self._places)]
        self._write(self._bytes(records.DataEnd(data_section_crc=self._crc)))
        write_summary(path, self._at, known, self._hand_on)

    def _message(self, number: int, data: bytes, ns: int) -> None:
        self._counts[number] = count = self._counts[number] + 1
        self._indexes.setdefault(number, []).append((ns, len(self._chunk)))
        self._chunk += MESSAGE.pack(
            CODES["Message"], FIELDS + len(data), number, count & 0xFFFFFFFF, ns, ns
        )
        self._chunk += data
        if len(self._chunk) > LARGEST:
            self.flush()

    def _chunk_record(self, least: int, greatest: int) -> bytes:
        plain = bytes(self._chunk)
        return self._bytes(
            self._records.Chunk(
                compression="zstd", data=self._zstd.compress(plain), message_start_time=least,
                message_end_time=greatest, uncompressed_crc=zlib.crc32(plain),
                uncompressed_size=len(plain),
            )
        )  # fmt: skip

    def _bytes(self, record: Any) -> bytes:
        builder = self._builder()
        record.write(builder)
        return builder.end()

    def _write(self, data: bytes) -> None:
        self._at += len(data)
        self._crc = zlib.crc32(data, self._crc)
        self._hand_on(data)
