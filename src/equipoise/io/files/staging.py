"""Hidden folders in which files are made before they take their names, and the end of left ones.

A writer holds a lock on its folder as long as it lives. What a killed one has left goes when the
next one writes there: a folder of our name that nobody holds. Where a system has no locks for
folders, one that is a day old is nobody's.
"""

import contextlib
import os
import re
import shutil
import time
from collections.abc import Generator
from pathlib import Path
from uuid import uuid4

NAME = re.compile(r"\.equipoise-[0-9a-f]{8}")
OLD = 86400.0  # s, chosen: longer than any writing, and than clocks are set by


@contextlib.contextmanager
def staging(folder: Path) -> Generator[Path]:
    """Lend a folder of one's own in a folder; it goes with all that is left in it at the end.

    Raises OSError where there can be none.
    """
    sweep(folder)
    place, handle = _made(folder)
    try:
        yield place
    finally:
        shutil.rmtree(place, ignore_errors=True)
        if handle is not None:
            os.close(handle)


def sweep(folder: Path) -> None:
    """Remove what killed writers have left in a folder; whatever cannot be removed stays."""
    with contextlib.suppress(OSError), os.scandir(folder) as entries:
        for entry in entries:
            if NAME.fullmatch(entry.name) and entry.is_dir(follow_symlinks=False):
                with contextlib.suppress(OSError):
                    _remove_if_left(Path(entry.path))


def _made(folder: Path) -> tuple[Path, int | None]:
    """Return a new folder and what holds its lock; None: there are no locks here."""
    while True:
        place = folder / f".equipoise-{uuid4().hex[:8]}"
        place.mkdir()
        handle, is_held = _locked(place)
        if not is_held and place.exists():
            return place, handle
        if handle is not None:  # somebody who sweeps was between the two lines above
            os.close(handle)


def _remove_if_left(place: Path) -> None:
    handle, is_held = _locked(place)
    try:
        is_old = time.time() - place.stat().st_mtime > OLD
        if not is_held and (handle is not None or is_old):
            shutil.rmtree(place, ignore_errors=True)
    finally:
        if handle is not None:
            os.close(handle)


if os.name == "nt":  # pragma: no cover

    def _locked(place: Path) -> tuple[int | None, bool]:
        """Return that there is no lock."""
        return None, False

else:
    import fcntl

    def _locked(place: Path) -> tuple[int | None, bool]:
        """Return a handle that locks the folder, if there are locks; whether another holds it."""
        try:
            handle = os.open(place, os.O_RDONLY | os.O_DIRECTORY | os.O_NOFOLLOW)
        except FileNotFoundError:
            return None, True  # swept
        try:
            fcntl.flock(handle, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except OSError as error:
            os.close(handle)
            return None, isinstance(error, BlockingIOError)
        return handle, False
