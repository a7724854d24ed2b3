"""A file for a library that reads as many bytes as the file says: never more than there are."""

from io import SEEK_CUR, SEEK_SET, BufferedIOBase

from equipoise.io.files.file_content import Content

LONGEST = 65536  # bytes of a line (chosen)


class CountedFile(BufferedIOBase):
    """A content as an open file; each read looks at the time. Closing it leaves the content."""

    def __init__(self, content: Content) -> None:
        self._file, self._size, self._meter = content.from_start(), len(content), content.meter

    def read(self, size: int | None = -1, /) -> bytes:
        """Return so many bytes, fewer at the end; InputError if they are too many."""
        left = max(self._size - self._file.seek(0, SEEK_CUR), 0)
        count = left if size is None or size < 0 else min(size, left)
        self._meter.check(count)
        return self._file.read(count)

    def readline(self, size: int | None = LONGEST, /) -> bytes:
        """Return the bytes up to the end of a line, of a long one so many."""
        count = LONGEST if size is None or size < 0 else size
        self._meter.check(count)
        return self._file.readline(count)

    def seek(self, at: int, whence: int = SEEK_SET, /) -> int:
        """Go to a place, and return it."""
        return self._file.seek(at, whence)
