"""A crash file: what a maintainer needs of an error that nobody has foreseen, and no data.

It holds the kind of the error and where it was raised, the versions of Python, Equipoise and its
libraries, the platform, the arguments, and length and SHA-256 of each file that they name. It
holds no content of a file, no value of a variable, no environment, and not the error's message,
which may repeat a cell. The arguments stand there as they were given: no option takes a secret.
"""

import hashlib
import os
import platform
import re
import shlex
import sys
import tempfile
import traceback
from collections.abc import Iterator, Sequence
from contextlib import suppress
from dataclasses import dataclass
from datetime import UTC, datetime
from pathlib import Path

from equipoise.app.text.escaping import for_one_line, for_terminal
from equipoise.model.errors import UnforeseenError
from equipoise.model.version import __version__

PREFIX, SUFFIX = "crash_", ".txt"
KEPT = 20  # files, chosen: the newest
HASHED = 1 << 30  # bytes, chosen: a longer file is not read for its hash, which would take long
CAUSES = 20  # errors of one chain, chosen
SHOWN = 200  # letters of a message in the sentence, chosen
# What a worker process hands over of its own trace; the lines between may repeat data.
FRAME = re.compile(r'^  File "[^"]+", line \d+, in [\w<>.]+$', re.MULTILINE)
REQUIREMENT = re.compile(r"[A-Za-z0-9._-]+")


@dataclass(frozen=True, slots=True)
class Crash:
    """A sentence for a person; the file, or None where none could be written; what it holds."""

    sentence: str
    path: Path | None
    text: str


def crash_of(error: BaseException, arguments: Sequence[str]) -> Crash:
    """Return what is to be said of an error that nobody has foreseen, its crash file written.

    What the frames of the error hold in memory is let go: it may be why memory ran out.
    """
    with suppress(RuntimeError):
        traceback.clear_frames(error.__traceback__)
    text = crash_text(error, arguments)
    path = _kept(text)
    return Crash(_sentence(error, path), path, text)


def crash_text(error: BaseException, arguments: Sequence[str]) -> str:
    """Return what a crash file holds."""
    lines = (
        f"equipoise {__version__} stopped at an unexpected error",
        f"at: {datetime.now(UTC).isoformat(timespec='seconds')}",
        f"arguments: {shlex.join(arguments)}",
        *map(_described, _named_files(arguments)),
        f"made with: Python {platform.python_version()}, {', '.join(_libraries())}",
        f"on: {platform.platform()}, {platform.machine()}, byte order {sys.byteorder}",
        *_trace(error),
    )
    return "\n".join(map(for_terminal, lines)) + "\n"


def crash_folder() -> Path:
    """Return where crash files go: the place that the system has for states of programs.

    Raises RuntimeError where nobody has a home.
    """
    if sys.platform == "win32":
        base = _folder_of("LOCALAPPDATA") or Path.home() / "AppData" / "Local"
    elif sys.platform == "darwin":
        base = Path.home() / "Library" / "Application Support"
    else:
        base = _folder_of("XDG_STATE_HOME") or Path.home() / ".local" / "state"
    return base / "equipoise" / "crashes"


def _folder_of(variable: str) -> Path | None:
    """Return an absolute path that the environment names; another one does not count."""
    named = Path(os.environ.get(variable, ""))
    return named if named.is_absolute() else None


def _sentence(error: BaseException, path: Path | None) -> str:
    message = for_one_line(str(error))[:SHOWN]
    named = "" if isinstance(error, UnforeseenError) else type(error).__name__
    what = ": ".join(filter(None, (named, message)))
    if path is None:
        return f"unexpected error ({what}); no crash file could be written"
    return f"unexpected error ({what}); please report it with {path} (no data in it)"  # fmt: skip


def _kept(text: str) -> Path | None:
    """Write a crash file, whole, for its owner alone; None where that cannot be."""
    try:
        folder = crash_folder()
        folder.mkdir(mode=0o700, parents=True, exist_ok=True)
        handle, temporary = tempfile.mkstemp(dir=folder)  # its owner's alone
        try:
            with open(handle, "wb") as file:  # noqa: PTH123  (an open one)
                file.write(text.encode("utf-8", "backslashreplace"))
            when = datetime.now(UTC).strftime("%Y-%m-%dT%H-%M-%S.%f")
            path = Path(temporary).replace(folder / f"{PREFIX}{when}_{os.getpid()}{SUFFIX}")
        except BaseException:
            Path(temporary).unlink(missing_ok=True)
            raise
        for old in sorted(folder.glob(f"{PREFIX}*{SUFFIX}"))[:-KEPT]:
            old.unlink(missing_ok=True)
    except (OSError, RuntimeError):
        return None
    return path


def _trace(error: BaseException) -> Iterator[str]:
    """Yield kind and frames of an error and of what caused it, the last one first."""
    found: BaseException | None = error
    for count in range(CAUSES):
        if found is None:
            return
        kind = type(found)
        yield f"{'caused by' if count else 'error'}: {kind.__module__}.{kind.__qualname__}"
        frames = traceback.format_tb(found.__traceback__)
        yield from (line for frame in frames for line in frame.splitlines())
        if kind.__name__ == "_RemoteTraceback":
            yield from FRAME.findall(str(found))
        found = found.__cause__ or (None if found.__suppress_context__ else found.__context__)


def _named_files(arguments: Sequence[str]) -> Iterator[Path]:
    """Yield each file that the arguments name, also as ``--option=file``."""
    for word in arguments:
        for name in dict.fromkeys((word, word.partition("=")[2])):
            with suppress(OSError, ValueError):
                if name and Path(name).is_file():
                    yield Path(name)


def _described(path: Path) -> str:
    """Return what identifies a file without a word of it."""
    try:
        size = path.stat().st_size
        if size > HASHED:
            return f"file: {path}, {size} bytes"
        with path.open("rb") as file:
            digest = hashlib.file_digest(file, "sha256").hexdigest()
    except OSError as error:
        return f"file: {path}, not read: {error.strerror}"
    return f"file: {path}, {size} bytes, sha256 {digest}"


def _libraries() -> Iterator[str]:
    """Yield the libraries that are there of those that Equipoise may use, with their versions."""
    import importlib.metadata  # takes longer than the rest of the program's start

    with suppress(importlib.metadata.PackageNotFoundError):
        for each in importlib.metadata.requires("equipoise") or ():
            name = REQUIREMENT.match(each)
            with suppress(importlib.metadata.PackageNotFoundError):
                if name is not None:
                    yield f"{name[0]} {importlib.metadata.version(name[0])}"
