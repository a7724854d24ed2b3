"""One commander at a time: a lock on each port of a bench, kept by the operating system.

The lock is on a file named for the port, which says who holds it. It goes with the process that
holds it, however that ends. Observers need none.
"""

import hashlib
import os
import tempfile
from collections.abc import Generator, Sequence
from contextlib import ExitStack, contextmanager, suppress
from pathlib import Path
from typing import IO

from equipoise.model.errors import EquipoiseError, InputError

FOLDER = "equipoise-benches"


class BenchTaken(EquipoiseError):
    """Another process commands a device of this bench."""


@contextmanager
def commanding(addresses: Sequence[str]) -> Generator[None]:
    """Hold the ports of a bench. Raises BenchTaken and says who holds one of them.

    InputError where no lock can be made.
    """
    with ExitStack() as held:
        for address in sorted(set(addresses)):
            held.enter_context(_held(address))
        yield


@contextmanager
def _held(address: str) -> Generator[None]:
    with _opened(address) as file:
        if not _lock(file):
            file.seek(0)
            by = file.read().strip() or "another process"
            raise BenchTaken(
                f"{address} is commanded by {by}; wait for it to end, or stop it; "
                "any number of programs may observe meanwhile"
            )
        with suppress(OSError):  # on a full disk nobody learns who holds it; it is held
            file.truncate(0)
            file.write(f"process {os.getpid()}")
            file.flush()
        yield


def _opened(address: str) -> IO[str]:
    """Return the file to be locked for a port."""
    try:
        folder = Path(tempfile.gettempdir()) / FOLDER
        folder.mkdir(exist_ok=True)
        name = f"{hashlib.sha256(address.encode()).hexdigest()[:16]}.lock"
        return (folder / name).open("a+", encoding="utf-8")
    except OSError as error:
        found = f"no lock of its port ({error.strerror or error})"
        raise InputError(address, found, "a folder for temporary files with space in it") from error


if os.name == "nt":  # pragma: no cover
    import msvcrt

    def _lock(file: IO[str]) -> bool:
        """Lock one byte well behind the text, so that others can read the text."""
        try:
            file.seek(1 << 20)
            msvcrt.locking(file.fileno(), msvcrt.LK_NBLCK, 1)
        except OSError:
            return False
        return True

else:
    import fcntl

    def _lock(file: IO[str]) -> bool:
        try:
            fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except OSError:
            return False
        return True
