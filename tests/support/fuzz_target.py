"""Something that takes any bytes, and raises nothing but what it declares."""

import functools
import tempfile
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path


@dataclass(frozen=True, slots=True)
class Target:
    """A parser with bytes that it understands.

    ``take`` lets no declared error out. ``share`` says how often it is tried; the slow less often.
    """

    name: str
    valid: Callable[[], bytes]
    take: Callable[[bytes], None]
    share: float = 1.0


@functools.cache
def folder() -> Path:
    """Return a folder of this process."""
    return Path(_kept().name)


@functools.cache
def _kept() -> tempfile.TemporaryDirectory[str]:
    return tempfile.TemporaryDirectory()
