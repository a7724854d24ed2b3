"""What a chunk of an MCAP file unpacks to, counted as it does.

A stated size may be garbled or a lie, so that memory is taken for what comes out, piece by piece;
at once only where the packed bytes and the chunk state the same.
"""

import zlib
from collections.abc import Iterator
from typing import Any

from equipoise.io.files.reading_budget import Meter
from equipoise.io.formats.optional_libraries import log_library
from equipoise.io.logs.unpacking_work import Work
from equipoise.io.logs.zstd_frames import PIECE, joined, unframed
from equipoise.io.mcap.mcap_records import Packed


def unpacked(chunk: Packed, work: Work) -> bytes | memoryview:
    """Return a chunk's records; InputError if they are too much, else raises if it is broken."""
    match chunk.compression:
        case "":
            data: bytes | memoryview = chunk.data
            work.add(len(data))
        case "zstd":
            data = unframed(chunk.data, work, chunk.size)
        case "lz4":
            data = joined(_of_lz4(chunk, work.meter), work)
        case _:
            raise ValueError("compression")
    if chunk.crc and zlib.crc32(data) != chunk.crc:
        raise ValueError("checksum")
    return data


def _of_lz4(chunk: Packed, meter: Meter) -> Iterator[bytes]:
    unpacker: Any = log_library("lz4.frame", meter.source).LZ4FrameDecompressor()
    piece = chunk.size if PIECE < chunk.size <= meter.left else PIECE
    yield unpacker.decompress(chunk.data, max_length=piece)
    while not unpacker.eof:
        more = unpacker.decompress(b"", max_length=PIECE)
        if not more and unpacker.needs_input:
            raise EOFError
        yield more
