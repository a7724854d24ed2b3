"""Where a run is put down: the folder that was asked for, or one of its own among the runs.

Its own is in a folder of the month, so that a logbook lists again only the months that changed.
"""

import os
from datetime import datetime
from itertools import chain, count
from pathlib import Path

from equipoise.app.console.terminal import complain
from equipoise.app.text.escaping import for_file_name
from equipoise.io.documents.run_shards import month_of
from equipoise.io.files.atomic_file import check_folder
from equipoise.model.errors import InputError

VARIABLE, USUAL = "EQUIPOISE_RUNS", "equipoise-runs"


def runs_folder() -> Path | None:
    """Return the folder of runs: what the environment says, else here; None: keep no runs."""
    named = os.environ.get(VARIABLE)
    return Path(USUAL) if named is None else Path(named) if named else None


def own_folder(kind: str, platform: str) -> Path | None:
    """Return a new folder's name for a run; None if none is to be kept or can be."""
    runs = runs_folder()
    if runs is None:
        return None
    made = datetime.now()
    month = runs / month_of(made)
    try:
        check_folder(month)
    except InputError as error:
        complain(f"this run is not kept: {error}; --out or {VARIABLE} name another folder")
        return None
    return free(month / f"{made:%Y-%m-%d_%H-%M-%S}_{kind}_{slug(platform)}")


def name_of(folder: Path) -> str:
    """Return what a logbook calls a run in a folder of its own: its path among the runs."""
    return f"{folder.parent.name}/{folder.name}"


def slug(platform: str) -> str:
    """Return what a folder or a record of a platform has of its name."""
    return for_file_name(platform)


def free(folder: Path, suffix: str = "") -> Path:
    """Return a path that is not there yet: the one given, or with a number before its suffix."""
    first = folder.with_name(f"{folder.name}{suffix}") if suffix else folder
    numbered = (folder.with_name(f"{folder.name}_{k}{suffix}") for k in count(2))
    return next(path for path in chain((first,), numbered) if not path.exists())
