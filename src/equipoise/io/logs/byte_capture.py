"""Bytes as they came over a wire, saved to a file: what a driver is fed with, piece by piece.

A file is read as it is consumed, so one of hours takes no more memory than a short one.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Protocol, runtime_checkable

CHUNK = 65536  # bytes, chosen: read at once


@runtime_checkable
class Readable(Protocol):
    """Whatever gives bytes on demand: an open file, or bytes in memory."""

    def read(self, size: int = -1, /) -> bytes:
        """Return so many bytes, fewer at the end."""
        ...

    def readline(self, size: int = -1, /) -> bytes:
        """Return the bytes up to the end of a line, of a long one so many."""
        ...


@dataclass(frozen=True, slots=True)
class Piece:
    """What a port would hand on at once."""

    data: bytes
    t: float | None = None  # s since 1970, when it arrived; None: the file does not say
    ports: tuple[int, int] | None = None  # of a UDP datagram: whence and to where
    broken: bool = False  # these bytes of the file are no whole piece


def stream_pieces(file: Readable) -> Iterator[Piece]:
    """Yield a stream of bytes line by line; what has no lines in it, chunk by chunk."""
    while data := file.readline(CHUNK):
        yield Piece(data)
