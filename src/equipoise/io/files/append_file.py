"""A file that grows: every write goes to the system at once, and to the disk soon after.

What the system has survives the end of this program; what the disk has survives the end of power.
The disk is waited for in a thread: a memory card may take seconds, and a bench may not wait. After
the first failure nothing is written any more, and what was half written is cut off.
"""

import contextlib
import errno
import os
import threading
from pathlib import Path

from equipoise.io.files.atomic_file import WRITABLE, check_writable
from equipoise.model.errors import InputError

# A pipe or a device cannot be forced to a disk, and need not be.
NO_DISK = (errno.EINVAL, errno.ENOTSUP, errno.EROFS)


def check_new(path: str | Path) -> None:
    """Raise InputError now if a file cannot be begun there, before a bench is started for it."""
    _check_empty(path)
    check_writable(path)


def _check_empty(path: str | Path) -> None:
    target = Path(path)
    if target.is_file() and target.stat().st_size:
        raise InputError(str(path), "a file that exists", "a new one: records are kept")


class DurableFile:
    """A new file, written from its beginning to its end; ``failure`` says what stopped it."""

    def __init__(self, path: str | Path) -> None:
        """Begin a file; InputError if there is one that holds something."""
        target = Path(path)
        _check_empty(path)
        try:
            self._file = target.open("wb", buffering=0)
        except OSError as error:
            raise InputError(str(path), error.strerror or str(error), WRITABLE) from error
        self.failure: OSError | None = None
        self._wanted, self._closing = threading.Event(), False
        self._thread = threading.Thread(target=self._settle, name="to disk", daemon=True)
        self._thread.start()
        _keep_name(target.parent)

    def write(self, data: bytes | bytearray) -> int:
        """Write all of it or fail; a failed file refuses all that follows."""
        if self.failure is not None:
            raise self.failure
        begun, rest = self._file.tell(), memoryview(data)
        try:
            while rest:
                rest = rest[self._file.write(rest) or 0 :]
        except OSError as error:
            self.failure = error
            with contextlib.suppress(OSError):
                self._file.truncate(begun)
            raise
        return len(data)

    @property
    def closed(self) -> bool:
        """Say whether it takes no more, since it was closed."""
        return self._file.closed

    def flush(self) -> None:
        """Have the disk take what was written, soon; does not wait for it."""
        self._wanted.set()

    def close(self) -> None:
        """Have the disk take everything, and wait for it."""
        if self._file.closed:
            return
        self._closing = True
        self._wanted.set()
        self._thread.join()
        self._file.close()

    def _settle(self) -> None:
        """Force the file to the disk whenever that is wanted, and a last time at the end."""
        last = False
        while not last:
            self._wanted.wait()
            self._wanted.clear()
            last = self._closing
            try:
                os.fsync(self._file.fileno())
            except OSError as error:
                if error.errno not in NO_DISK:
                    self.failure = self.failure or error


def _keep_name(folder: Path) -> None:
    """Have the disk take the new file's name too, where a folder can be forced there."""
    with contextlib.suppress(OSError):
        handle = os.open(folder, os.O_RDONLY)
        try:
            os.fsync(handle)
        finally:
            os.close(handle)
