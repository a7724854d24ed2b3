"""The bytes of a file as they are asked for, and what reading them may take.

A file of gigabytes is walked through block by block; what needs all of it at once asks for it, and
that is counted.
"""

import hashlib
import io
from collections.abc import Generator, Iterable, Iterator
from contextlib import contextmanager
from io import BufferedIOBase
from pathlib import Path
from typing import overload

from equipoise.io.files.reading_budget import Meter, ReadingBudget
from equipoise.io.files.source_file import open_bytes, size_of
from equipoise.model.errors import InputError

BLOCK = 1 << 20  # bytes that are read at once (chosen)
USUAL = ReadingBudget()


class Content:
    """A file's bytes, sliced and searched as ``bytes`` are."""

    def __init__(self, file: BufferedIOBase, size: int, meter: Meter) -> None:
        self.file, self.meter = file, meter
        self._size, self._at, self._block = size, 0, b""

    @classmethod
    def of(cls, data: bytes, source: str, budget: ReadingBudget = USUAL) -> "Content":
        """Return bytes in memory as a file's."""
        return cls(io.BytesIO(data), len(data), budget.of(source, len(data)))

    def __len__(self) -> int:
        """Return how many there are."""
        return self._size

    @overload
    def __getitem__(self, key: int) -> int: ...
    @overload
    def __getitem__(self, key: slice) -> bytes: ...
    def __getitem__(self, key: int | slice) -> int | bytes:
        """Return a byte, or some that follow each other."""
        if isinstance(key, int):
            return self[key : key + 1][0]
        start, stop, _ = key.indices(self._size)
        first = start - self._at
        if first < 0 or stop - self._at > len(self._block):
            self._load(start, stop)
            first = start - self._at
        return self._block[first : stop - self._at] if stop > start else b""

    def _load(self, start: int, stop: int) -> None:
        if stop - start > BLOCK:
            self.meter.check(stop - start)
        self.file.seek(start)
        self._at, self._block = start, self.file.read(max(stop - start, BLOCK))

    def startswith(self, mark: bytes | tuple[bytes, ...], at: int = 0) -> bool:
        """Say whether bytes stand at a place."""
        marks = mark if isinstance(mark, tuple) else (mark,)
        return any(self[at : at + len(each)] == each for each in marks)

    def endswith(self, mark: bytes) -> bool:
        """Say whether bytes stand at the end."""
        return self[max(self._size - len(mark), 0) :] == mark

    def find(self, mark: bytes, at: int = 0) -> int:
        """Return the first place of bytes from a place on; -1 if there is none."""
        while at + len(mark) <= self._size:
            self[at : at + len(mark)]
            found = self._block.find(mark, at - self._at)
            if found >= 0:
                return self._at + found
            at = self._at + len(self._block) - len(mark) + 1
        return -1

    def blocks(self) -> Iterator[bytes]:
        """Yield all of it, block by block."""
        for at in range(0, self._size, BLOCK):
            yield self[at : at + BLOCK]

    def from_start(self) -> BufferedIOBase:
        """Return the file at its beginning, for what reads it as a file."""
        self.file.seek(0)
        return self.file

    def whole(self) -> bytes:
        """Return all of it at once."""
        self.meter.take(self._size)
        return self.from_start().read()

    def inner(self, data: bytes) -> "Content":
        """Return what it unpacks to, counted with it."""
        return Content(io.BytesIO(data), len(data), self.meter)

    def sha256(self) -> str:
        """Return the digest of all of it, in hex."""
        return sha256_of(self.blocks())


def sha256_of(blocks: Iterable[bytes]) -> str:
    """Return the digest of blocks, one behind the other, in hex."""
    digest = hashlib.sha256()
    for block in blocks:
        digest.update(block)
    return digest.hexdigest()


@contextmanager
def opened(path: str | Path, wanted: str, budget: ReadingBudget = USUAL) -> Generator[Content]:
    """Lend a file's content; ``wanted`` says what kind of file should be there.

    InputError if there is none, if it is empty, or no regular file.
    """
    with open_bytes(path, wanted) as file:
        size = size_of(file)
        content = Content(file, size, budget.of(str(path), size))
        if size <= BLOCK and not content[:].strip():
            raise InputError(str(path), "an empty file", wanted)
        yield content
