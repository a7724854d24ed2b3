"""Where runs stand on the disk: in the folder of all runs, or in one for each month within it."""

import os
import re
from datetime import datetime
from pathlib import Path

from equipoise.model.logged_run import RUN

MONTH = re.compile(r"\d{4}-\d\d")


def month_of(time: datetime) -> str:
    """Return the folder, among the runs, of those that are made at a time."""
    return f"{time:%Y-%m}"


def stamp_of(path: str) -> int | None:
    """Return when a file or folder was last changed, ns; None if it is not there."""
    try:
        return os.stat(path).st_mtime_ns  # noqa: PTH116  (pathlib takes three times as long)
    except OSError:
        return None


def stamps_within(folder: Path) -> dict[str, int | None]:
    """Return the folders in one, and of each when its ``run.json`` was written; None: it has none.

    Raises OSError if the folder is gone or may not be listed.
    """
    top = str(folder)
    with os.scandir(top) as entries:
        names = sorted(e.name for e in entries if not e.is_file(follow_symlinks=False))
    runs = (name for name in names if not name.startswith("."))
    return {name: stamp_of(f"{top}/{name}/{RUN}") for name in runs}
