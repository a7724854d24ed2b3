"""A file for a library that reads as many bytes as the file says: never more than there are."""

from equipoise.io.files.file_content import Content

LONGEST = 65536  # bytes of a line (chosen)


class CountedFile:
    """A content as an open file; each read looks at the time."""

    def __init__(self, content: Content) -> None:
        self._file, self._size, self._meter = content.from_start(), len(content), content.meter

    def read(self, size: int = -1, /) -> bytes:
        """Return so many bytes, fewer at the end; InputError if they are too many."""
        left = max(self._size - self._file.tell(), 0)
        count = left if size < 0 else min(size, left)
        self._meter.check(count)
        return self._file.read(count)

    def readline(self, size: int = LONGEST, /) -> bytes:
        """Return the bytes up to the end of a line, of a long one so many."""
        self._meter.check(size)
        return self._file.readline(size)

    def seek(self, at: int, whence: int = 0, /) -> int:
        """Go to a place, and return it."""
        return self._file.seek(at, whence)

    def tell(self) -> int:
        """Return the place."""
        return self._file.tell()

    def close(self) -> None:
        """Leave the file as it is: who has opened it closes it."""
