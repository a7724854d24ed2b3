"""One process compiles a kernel; others that want it wait for what it keeps."""

import time
from collections.abc import Generator
from contextlib import ExitStack, contextmanager, suppress
from pathlib import Path
from typing import IO

try:
    import fcntl
except ImportError:  # Windows: several may compile the same
    fcntl = None

LONGEST = 600.0  # s, chosen: then each compiles for itself
POLL = 0.02  # s


@contextmanager
def alone(folder: Path, name: str) -> Generator[None]:
    """Wait until no other process holds the name in a folder, and hold it."""
    with ExitStack() as opened:
        with suppress(OSError):  # nothing can be kept in the folder, or it knows no locks
            file = opened.enter_context((folder / f"{name}.lock").open("a", encoding="utf-8"))
            _wait(file)
        yield


def _wait(file: IO[str]) -> None:
    until = time.monotonic() + LONGEST
    while fcntl is not None and time.monotonic() < until:
        try:
            return fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            time.sleep(POLL)
