"""Write a file whole or not at all.

The content goes to a temporary file beside the target and takes its name only when it is on the
disk, so that a full disk or a stopped program leaves the old file, or none, never half of one.
"""

import contextlib
import os
from collections.abc import Generator
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
