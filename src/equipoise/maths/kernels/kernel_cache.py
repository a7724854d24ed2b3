"""Keep compiled kernels under what they were made from, not under where or when.

Kernels are merged into those that call them from other modules. So each is kept under a hash of
its own module and of every module of the package that this one imports, directly or not. Another
checkout, a copy with other times of change and a branch visited again find their kernels; an
edited sign compiles each kernel that contains it anew, and no other.

The place is the user's cache folder (`NUMBA_CACHE_DIR` where that is set), else the package
itself. What an installation brought along (``ready_kernels``) is taken over there. This is the one
module below ``io`` that reads files.
"""

import re
from collections.abc import Iterator
from contextlib import suppress
from functools import cache
from hashlib import sha256
from pathlib import Path
from typing import Any

from numba import config
from numba.core.caching import CacheImpl
from numba.misc.appdirs import AppDirs

from equipoise.maths.kernels.ready_kernels import take_ready

PACKAGE = Path(__file__).resolve().parents[2]
ROOM = Path(__file__).resolve().parent.relative_to(PACKAGE)
KEEPING = {ROOM / f"{name}.py" for name in ("kernel_cache", "kernel_lock", "ready_kernels")}
IMPORT = re.compile(rb"^\s*(?:from|import) equipoise\.?([\w.]*)(?: import (\([^)]*\)|.*))?", re.M)
WORD = re.compile(r"\w+")
KEPT = 30 * 86400.0  # s without use, chosen: a branch that was left alone for a month
MARK = "used"  # its time of change is the last use of a folder


@cache
def content(source: Path) -> bytes:
    """Return the text of a source, read once."""
    return source.read_bytes()


@cache
def imported(source: Path, package: Path) -> frozenset[Path]:
    """Return the modules of the package that a source names in its imports, wherever they stand."""
    return frozenset(
        path
        for module, names in IMPORT.findall(content(source))
        for path in _modules(package, module.decode(), names.decode())
    )


def _modules(package: Path, module: str, names: str) -> Iterator[Path]:
    base = package.joinpath(*module.split(".")) if module else package
    for name in ("__init__", *WORD.findall(names)):
        candidate = base / f"{name}.py"
        if candidate.is_file():
            yield candidate
    if base.with_suffix(".py").is_file():
        yield base.with_suffix(".py")


@cache
def stamp(source: Path, package: Path = PACKAGE) -> str:
    """Return a hash of the contents of a source and of all that it imports from the package."""
    waiting, found = [source], {source}
    keeping = {package / path for path in KEEPING}  # how kernels are kept changes none of them
    while waiting:
        new = imported(waiting.pop(), package) - found - keeping
        found |= new
        waiting += new
    digest = sha256()
    for path in sorted(found):
        digest.update(path.relative_to(package).as_posix().encode())
        digest.update(sha256(content(path)).digest())
    return digest.hexdigest()


def folder_of(source: Path) -> Path | None:
    """Return a folder that can be written for the kernels of a source; None: there is none."""
    if not source.is_relative_to(PACKAGE):
        return None
    name = ".".join(source.relative_to(PACKAGE).with_suffix("").parts)
    for place in _places():
        folder = place / f"{name}-{stamp(source)[:20]}"
        with suppress(OSError):
            made = not folder.is_dir()
            folder.mkdir(parents=True, exist_ok=True)
            (folder / MARK).touch()
            if made:
                take_ready(folder, stamp(source))
                _forget(place, (folder / MARK).stat().st_mtime - KEPT)
            return folder
    return None


def kernels_folder() -> Path:
    """Return the user's folder of kernels, which need not be there yet."""
    wanted = f"{config.CACHE_DIR}"  # pyright: ignore # set when numba is imported
    users = f"{AppDirs('equipoise', appauthor=False).user_cache_dir}"  # pyright: ignore
    return Path(wanted or users, "equipoise-kernels")


def _places() -> tuple[Path, Path]:
    return kernels_folder(), PACKAGE / "maths" / "kernels" / "__pycache__"


def _forget(place: Path, before: float) -> None:
    """Remove the kernels that were last used before a time."""
    for mark in place.glob(f"*/{MARK}"):
        with suppress(OSError):  # another process removes it too
            if mark.stat().st_mtime < before:
                for file in mark.parent.iterdir():
                    file.unlink()
                mark.parent.rmdir()


class Locator:
    """What the compiler asks about the place of a function's kernels."""

    def __init__(self, folder: Path, line: int, source: Path) -> None:
        self._folder, self._line, self._source = folder, line, source

    @classmethod
    def from_function(cls, py_func: Any, py_file: str) -> "Locator | None":
        """Return the place of a function of this package, None of another's."""
        source = Path(py_file).resolve()
        folder = folder_of(source)
        return cls(folder, py_func.__code__.co_firstlineno, source) if folder else None

    def ensure_cache_path(self) -> None:
        """Make the folder again where it was removed since."""
        self._folder.mkdir(parents=True, exist_ok=True)
        (self._folder / MARK).touch()

    def get_cache_path(self) -> str:
        """Return the folder."""
        return str(self._folder)

    def get_source_stamp(self) -> str:
        """Return what the kernels were made from."""
        return stamp(self._source)

    def get_disambiguator(self) -> str:
        """Return what distinguishes functions of one name."""
        return str(self._line)


def install() -> None:
    """Let the compiler keep the kernels of this package here, and those of others elsewhere."""
    CacheImpl._locator_classes.insert(0, Locator)  # pyright: ignore # its one way in
