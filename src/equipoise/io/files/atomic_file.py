"""Write a file, or several into a folder, whole or not at all.

The content goes to a temporary file beside the target and takes its name only when it is on the
disk, so that a full disk or a stopped program leaves the old file, or none, never half of one.
Several files are made in a hidden folder beside their place and moved only when the last one is on
the disk; other files in the folder stay.
"""

import contextlib
import os
import shutil
from collections.abc import Generator, Mapping
from pathlib import Path
from uuid import uuid4

from equipoise.model.errors import InputError

WRITABLE = "a path that can be written"


@contextlib.contextmanager
def whole_file(path: str | Path) -> Generator[Path]:
    """Lend a temporary path of the same suffix; it becomes ``path`` if the block ends well."""
    target = _target(path)
    if target.exists() and not target.is_file():
        yield target  # a device or a pipe has no half-written state and must not be replaced
        return
    temporary = target.with_name(f".{target.stem}.{uuid4().hex[:8]}{target.suffix}")
    try:
        temporary.touch()
        yield temporary
        _settle(temporary, target)
    except OSError as error:
        raise InputError(str(path), error.strerror or str(error), WRITABLE) from error
    finally:
        with contextlib.suppress(OSError):
            temporary.unlink(missing_ok=True)


def write_whole(path: str | Path, content: str | bytes) -> None:
    """Write text (as UTF-8, its line ends as they are) or bytes, whole or not at all."""
    with whole_file(path) as temporary:
        temporary.write_bytes(content.encode() if isinstance(content, str) else content)


def check_writable(path: str | Path) -> None:
    """Raise InputError now if ``path`` cannot be written, before hours of work are lost on it."""
    target = _target(path)
    probe = target.with_name(f".{target.name}.{uuid4().hex[:8]}")
    if target.exists() and not target.is_file():
        return
    try:
        probe.touch()
        probe.unlink()
    except OSError as error:
        raise InputError(str(path), error.strerror or str(error), WRITABLE) from error


def _target(path: str | Path) -> Path:
    """Return where the content belongs, links followed, or say why it cannot go there."""
    target = Path(path).resolve()
    if target.is_dir():
        raise InputError(str(path), "a directory", "the name of a file to write")
    if not target.parent.is_dir():
        raise InputError(str(path), f"no directory '{target.parent}'", "an existing directory")
    return target


def _settle(temporary: Path, target: Path) -> None:
    """Force the content to the disk, then give it its name; an old file's permissions stay."""
    with temporary.open("rb+") as stream:
        os.fsync(stream.fileno())
    if target.exists():
        if not os.access(target, os.W_OK):
            raise PermissionError(13, "a file that may not be written", str(target))
        temporary.chmod(target.stat().st_mode)
    temporary.replace(target)


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
