"""What a chunk of an MCAP file unpacks to, counted as it does.

A stated size may be garbled or a lie, so that memory is taken for what comes out, piece by piece;
at once only where the packed bytes and the chunk state the same.
"""

import zlib
from collections.abc import Iterator
from typing import Any

from equipoise.io.files.reading_budget import Meter
from equipoise.io.formats.optional_libraries import log_library
from equipoise.io.mcap.mcap_records import Packed

PIECE = 1 << 22  # bytes that are unpacked at once (chosen)
WIDEST = 1 << 27  # bytes of a window of Zstandard, its own limit


def unpacked(chunk: Packed, meter: Meter) -> bytes | memoryview:
    """Return a chunk's records; InputError if they are too much, else raises if it is broken."""
    match chunk.compression:
        case "":
            data: bytes | memoryview = chunk.data
        case "zstd":
            data = _of_zstandard(chunk, meter)
        case "lz4":
            data = _joined(_of_lz4(chunk, meter), meter)
        case _:
            raise ValueError("compression")
    if chunk.crc and zlib.crc32(data) != chunk.crc:
        raise ValueError("checksum")
    return data


def _of_zstandard(chunk: Packed, meter: Meter) -> bytes:
    library: Any = log_library("zstandard", meter.source)
    unpacker = library.ZstdDecompressor(max_window_size=WIDEST)
    if library.frame_content_size(chunk.data) == chunk.size:
        meter.check(chunk.size)
        return unpacker.decompress(chunk.data)
    with unpacker.stream_reader(chunk.data) as stream:
        return _joined(iter(lambda: stream.read(PIECE), b""), meter)


def _of_lz4(chunk: Packed, meter: Meter) -> Iterator[bytes]:
    unpacker: Any = log_library("lz4.frame", meter.source).LZ4FrameDecompressor()
    piece = chunk.size if PIECE < chunk.size <= meter.left else PIECE
    yield unpacker.decompress(chunk.data, max_length=piece)
    while not unpacker.eof:
        more = unpacker.decompress(b"", max_length=PIECE)
        if not more and unpacker.needs_input:
            raise EOFError
        yield more


def _joined(pieces: Iterator[bytes], meter: Meter) -> bytes:
    """Return pieces as one; InputError as soon as they are too much."""
    found: list[bytes] = []
    size = 0
    for piece in pieces:
        size += len(piece)
        meter.check(2 * size if found else size)  # here, and as one in the end
        found.append(piece)
    return b"".join(found) if len(found) != 1 else found[0]
