"""What frames of Zstandard (RFC 8878) unpack to, counted as they do."""

from collections.abc import Iterator
from functools import partial
from pathlib import Path
from typing import Any

from equipoise.io.files.broken_bytes import as_value_error, each_unbroken
from equipoise.io.files.file_content import Content
from equipoise.io.formats.optional_libraries import log_library
from equipoise.io.logs.unpacking_work import Work

PIECE = 1 << 22  # bytes that are unpacked at once (chosen)
WIDEST = 1 << 27  # bytes of a window, Zstandard's own limit
BROKEN = "Zstandard file", "a whole file: copy it again"


def unframed(data: bytes | memoryview, work: Work, stated: int | None = None) -> bytes:
    """Return what a frame unpacks to; InputError if it is too much, ValueError if it is broken.

    ``stated``: its size, as what is around it has it. Where the frame says another, memory is taken
    for what comes out and not for what is said.
    """
    library = log_library("zstandard", work.meter.source)
    unpacker = library.ZstdDecompressor(max_window_size=WIDEST)
    with as_value_error():
        size: int = library.frame_content_size(data)
        if size >= 0 and stated in (None, size):
            work.meter.check(size)
            work.add(size)
            return unpacker.decompress(data)
        with unpacker.stream_reader(data) as stream:
            return joined(iter(partial(stream.read, PIECE), b""), work)


def joined(pieces: Iterator[bytes], work: Work) -> bytes:
    """Return pieces as one; InputError as soon as they are too much."""
    found: list[bytes] = []
    size = 0
    for piece in pieces:
        size += len(piece)
        work.add(len(piece))
        work.meter.check(2 * size if found else size)  # here, and as one in the end
        found.append(piece)
    return b"".join(found) if len(found) != 1 else found[0]


def unframe_file(content: Content, out: Path) -> None:
    """Write what a file unpacks to; InputError if it is broken, or too much for its size."""
    library: Any = log_library("zstandard", content.meter.source)
    work = Work(content.meter, len(content))
    unpacker = library.ZstdDecompressor(max_window_size=WIDEST)
    with unpacker.stream_reader(content.from_start()) as stream, out.open("wb") as file:
        pieces = iter(partial(stream.read, PIECE), b"")
        for piece in each_unbroken(pieces, content.meter.source, *BROKEN):
            content.meter.check(0)
            work.add(len(piece))
            file.write(piece)
