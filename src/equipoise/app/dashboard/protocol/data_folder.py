"""The files that the dashboard may touch: runs and recordings in one folder, none outside."""

import os
from collections.abc import Iterator
from datetime import datetime
from itertools import islice
from pathlib import Path

from equipoise.app.logbook.run_folder import USUAL, free, runs_folder, slug
from equipoise.io.documents.run_folder import RECORDING
from equipoise.io.documents.run_shards import MONTH
from equipoise.model.errors import InputError

RECORDINGS = "recordings"
SUFFIX = ".mcap"
LAST = 1000  # runs whose recordings are offered; chosen: some milliseconds
SHOWN = 100  # characters of a name that was not found; chosen


def data_folder() -> Path:
    """Return the folder of runs (``EQUIPOISE_RUNS``), absolute."""
    return (runs_folder() or Path(USUAL)).resolve()


def within(folder: Path, name: str) -> Path:
    """Return a file of the folder by its name in it; InputError for what is outside, or not there.

    Links are followed before the location of a file is checked. A name that the system refuses
    (too long, with a zero in it) is one that is not there.
    """
    wanted = f"a file within {folder}"
    if not name.isprintable():
        raise InputError("file", ascii(name)[:SHOWN], wanted)
    try:
        path = (folder / name).resolve()
        there = path.is_relative_to(folder.resolve()) and path.is_file()
    except (OSError, ValueError):
        there, path = False, folder
    if not there:
        raise InputError("file", f"'{name[:SHOWN]}'", wanted)
    return path


def recordings(folder: Path) -> list[str]:
    """Return the names of the recordings in it, the newest first; of runs those of the last ones.

    Names of runs begin with their time, so that the last by name are found without all others.
    """
    kept = (path for path in islice(_last_runs(folder), LAST) if path.is_file())
    found = [*folder.glob(f"{RECORDINGS}/*{SUFFIX}"), *kept]
    ordered = sorted(found, key=lambda path: path.stat().st_mtime, reverse=True)
    return [path.relative_to(folder).as_posix() for path in ordered]


def _last_runs(folder: Path) -> Iterator[Path]:
    """Yield where runs have their recordings, the last run by its name first."""
    inside = _names(folder)
    months = [name for name in inside if MONTH.fullmatch(name)]
    for place in (*(folder / month for month in months), folder):
        for name in inside if place == folder else _names(place):
            yield place / name / RECORDING


def _names(folder: Path) -> list[str]:
    """Return the names in a folder backwards; nothing if it is none."""
    try:
        return sorted((name for name in os.listdir(folder) if name[0] != "."), reverse=True)  # noqa: PTH208
    except OSError:
        return []


def new_recording(folder: Path, platform: str) -> Path:
    """Return the path of a new recording; its folder is made."""
    where = folder / RECORDINGS
    where.mkdir(parents=True, exist_ok=True)
    now = datetime.now().strftime("%Y-%m-%d_%H-%M-%S")
    return free(where / f"{now}_{slug(platform)}", SUFFIX)
