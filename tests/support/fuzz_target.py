"""Something that takes any bytes, and raises nothing but what it declares."""

from collections.abc import Callable
from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Target:
    """A parser with bytes that it understands.

    ``take`` lets no declared error out. ``share`` says how often it is tried; the slow less often.
    """

    name: str
    valid: Callable[[], bytes]
    take: Callable[[bytes], None]
    share: float = 1.0
