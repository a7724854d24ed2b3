"""Write several files into a folder, all or none.

They are made in a hidden folder beside their place and moved only when the last one is on the
disk; other files in the folder stay.
"""

import contextlib
import shutil
from collections.abc import Mapping
from pathlib import Path
from uuid import uuid4

from equipoise.io.files.atomic_file import WRITABLE, check_writable, write_whole
from equipoise.model.errors import InputError


def check_folder(path: str | Path) -> None:
    """Raise InputError now if files cannot be put there, before work is lost on it."""
    folder = Path(path).resolve()
    if folder.exists() and not folder.is_dir():
        raise InputError(str(path), "a file", "the name of a folder")
    there = next(p for p in (folder, *folder.parents) if p.exists())
    if not there.is_dir():
        raise InputError(str(path), f"the file '{there}' on the way", "the name of a folder")
    check_writable(there / ".equipoise")


def write_folder(path: str | Path, files: Mapping[str, str | bytes]) -> list[Path]:
    """Write named files into a folder, which is made if need be, and return their paths.

    A name may have folders of its own: ``figures/a.png``.
    """
    check_folder(path)
    folder = Path(path)
    staging = folder / f".{uuid4().hex[:8]}"
    made = [p for p in (folder, *folder.parents) if not p.exists()]  # deepest first
    try:
        staging.mkdir(parents=True)
        for name, content in files.items():
            (staging / name).parent.mkdir(parents=True, exist_ok=True)
            write_whole(staging / name, content)
        for name in files:
            (folder / name).parent.mkdir(parents=True, exist_ok=True)
        return [(staging / name).replace(folder / name) for name in files]
    except OSError as error:
        raise InputError(str(path), error.strerror or str(error), WRITABLE) from error
    finally:
        shutil.rmtree(staging, ignore_errors=True)
        for parent in made:  # goes only while it is empty
            with contextlib.suppress(OSError):
                parent.rmdir()
