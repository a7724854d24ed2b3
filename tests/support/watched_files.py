"""What a reader does beside reading: files that it writes elsewhere, programs that it begins."""

import os
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from equipoise.io.formats.matlab.hdf5_process import BEGIN

WRITING = {"os.remove", "os.rename", "os.mkdir", "os.rmdir", "os.link", "os.symlink", "os.truncate",
           "shutil.rmtree", "shutil.move"}  # fmt: skip
ELSEWHERE = {"subprocess.Popen", "os.system", "os.exec", "os.fork", "socket.connect"}


class Watcher:
    """Notes what is written outside some folders, and what leaves the process, while it is on.

    A process that reads HDF5 for us is no other program; it has nothing but two open files.
    """

    def __init__(self) -> None:
        self.on, self.found = False, list[str]()
        self.folders: tuple[str, ...] = ()
        sys.addaudithook(self._noted)

    def _noted(self, event: str, words: tuple[Any, ...]) -> None:
        if not self.on:
            return
        if event == "subprocess.Popen" and BEGIN in words[1]:
            return
        if event in ELSEWHERE:
            self.found.append(f"{event} {words[:1]}")
        elif event in WRITING or (event == "open" and self._writes(words)):
            place = self._place(event, words)
            if place and not self._is_allowed(place):
                self.found.append(f"{event} {place}")

    def _is_allowed(self, place: str) -> bool:
        """Say whether a file is in a folder, or Python's own of a module that it first imports."""
        return place.startswith((*self.folders, "/dev/null")) or ".pyc" in Path(place).suffixes

    @staticmethod
    def _place(event: str, words: tuple[Any, ...]) -> str:
        """Return the path that is meant, also one within an open folder; none for a handle."""
        if isinstance(words[0], int):
            return ""
        folder = words[1] if event in ("os.remove", "os.rmdir") else -1
        base = Path(f"/proc/self/fd/{folder}").readlink() if folder >= 0 else Path.cwd()
        return str((base / os.fsdecode(words[0])).resolve())

    @staticmethod
    def _writes(words: tuple[Any, ...]) -> bool:
        flags = words[2] if len(words) > 2 and isinstance(words[2], int) else 0
        return bool(flags & (os.O_WRONLY | os.O_RDWR | os.O_CREAT))

    @contextmanager
    def watching(self, *folders: str) -> Iterator[None]:
        """Watch for a while."""
        self.folders, self.on = tuple(str(Path(each).resolve()) for each in folders), True
        try:
            yield
        finally:
            self.on = False


WATCHER = Watcher()
