"""Write a file, or several into a folder, whole or not at all.

The content goes to a file in a hidden folder beside the target (``staging``) and takes its place
only when it is on the disk, so that a full disk or a stopped program leaves the old file, or none,
never half of one. Several files are made there and moved only when the last one is on the disk: a
new folder comes whole; in one that is there, other files stay. No error names a hidden folder.
"""

import contextlib
import os
from collections.abc import Generator, Mapping
from pathlib import Path

from equipoise.io.files.staging import staging
from equipoise.model.errors import EquipoiseError, InputError

WRITABLE = "a path that can be written"
WHOLE = "whole"  # name of a folder that is made


@contextlib.contextmanager
def whole_file(path: str | Path) -> Generator[Path]:
    """Lend a temporary path of the same name; it becomes ``path`` if the block ends well."""
    target = _target(path)
    if target.exists() and not target.is_file():
        with _named(path):
            yield target  # a device or a pipe has no half-written state and must not be replaced
        return
    with _named(path), staging(target.parent) as place, _instead(place / target.name, path):
        temporary = place / target.name
        temporary.touch()
        yield temporary
        _settle(temporary, target)


@contextlib.contextmanager
def _named(path: str | Path) -> Generator[None]:
    """Make an error of the system a sentence on what was to be written."""
    try:
        yield
    except OSError as error:
        raise InputError(str(path), error.strerror or str(error), WRITABLE) from error


@contextlib.contextmanager
def _instead(temporary: Path, path: str | Path) -> Generator[None]:
    """Name the target in every error that names the temporary path."""

    def named(text: object) -> object:
        return text.replace(str(temporary), str(path)) if isinstance(text, str) else text

    try:
        yield
    except (EquipoiseError, OSError) as error:
        error.args = tuple(map(named, error.args))
        for key, value in vars(error).items():
            setattr(error, key, named(value))
        raise


def write_whole(path: str | Path, content: str | bytes) -> None:
    """Write text (as UTF-8, its line ends as they are) or bytes, whole or not at all."""
    with whole_file(path) as temporary:
        temporary.write_bytes(content.encode() if isinstance(content, str) else content)


def check_writable(path: str | Path) -> None:
    """Raise InputError now if ``path`` cannot be written, before hours of work are lost on it."""
    target = _target(path)
    if target.exists() and not target.is_file():
        return
    with _named(path), staging(target.parent):
        pass


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
    with _named(path), staging(there):
        pass


def write_folder(path: str | Path, files: Mapping[str, str | bytes]) -> list[Path]:
    """Write named files into a folder, which is made if need be, and return their paths.

    A name may have folders of its own: ``figures/a.png``.
    """
    check_folder(path)
    folder = Path(path)
    there = folder.is_dir()
    made = [p for p in (folder, *folder.parents) if not p.exists()]  # deepest first
    try:
        with _named(path):
            (folder if there else folder.parent).mkdir(parents=True, exist_ok=True)
            with staging(folder if there else folder.parent) as place:
                _moved(_filled(place / WHOLE, files, folder), folder, files)
    finally:
        for parent in made:  # goes only while it is empty
            with contextlib.suppress(OSError):
                parent.rmdir()
    return [folder / name for name in files]


def _filled(place: Path, files: Mapping[str, str | bytes], folder: Path) -> Path:
    """Write files into a new folder, ``place``; errors name the one where they are to be."""
    with _instead(place, folder):
        place.mkdir()
        for name, content in files.items():
            (place / name).parent.mkdir(parents=True, exist_ok=True)
            write_whole(place / name, content)
    return place


def _moved(place: Path, folder: Path, files: Mapping[str, str | bytes]) -> None:
    """Let files take their places: all at once where there is no such folder yet."""
    if not folder.exists():
        place.rename(folder)
        return
    for name in files:
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (place / name).replace(folder / name)
