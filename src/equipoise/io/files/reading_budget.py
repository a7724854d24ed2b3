"""What reading one file may take: memory and time, counted while it is read.

    memory   64 times the file's size, at least 256 MB, at most 2 GB; or what a person states
    time     20 s and 5 s for each MB of the file, longer in proportion where more memory is stated

A small file that unpacks to gigabytes is a broken or a crafted one: no recording is that even.
"""

import time
from dataclasses import dataclass

from equipoise.model.errors import InputError
from equipoise.model.units import MEGABYTE

RATIO = 64  # bytes that one of a file may stand for (chosen: a record of a still bench has 20)
LEAST = int(256 * MEGABYTE)  # chosen: what the smallest file may take
MOST = int(2000 * MEGABYTE)  # chosen: half of a small computer's memory
SECONDS, SECONDS_PER_MB = 20.0, 5.0  # chosen: ten times what the slowest reader takes
CELL = 100  # bytes, chosen: of a text or a row of numbers as an object in memory


@dataclass(frozen=True, slots=True)
class ReadingBudget:
    """What is stated of it; None: as the file's size has it."""

    memory: int | None = None  # bytes

    def of(self, source: str, size: int) -> "Meter":
        """Return what counts the reading of a file of so many bytes."""
        usual = min(max(RATIO * size, LEAST), MOST)
        memory = usual if self.memory is None else self.memory
        longer = max(memory / usual, 1.0)
        return Meter(source, size, memory, longer * (SECONDS + SECONDS_PER_MB * size / MEGABYTE))


class Meter:
    """Counts what one reading takes; InputError once that is too much."""

    def __init__(self, source: str, size: int, memory: int, seconds: float) -> None:
        self.source, self.size = source, size
        self._memory, self.seconds = memory, seconds
        self._taken, self._begun = 0, time.monotonic()

    @property
    def left(self) -> int:
        """Return how many bytes may be taken yet."""
        return self._memory - self._taken

    def take(self, count: int) -> None:
        """Count bytes that stay in memory."""
        self.check(count)
        self._taken += count

    def check(self, count: int) -> None:
        """Raise InputError if so many bytes more are too many, or the time is over."""
        if count > self.left:
            raise self.refused(f"more than {in_mb(self._memory)} once it is read")
        if time.monotonic() - self._begun > self.seconds:
            raise self.refused(f"not read within {self.seconds:.0f} s")

    def refused(self, found: str) -> InputError:
        """Return the error for what takes too much, with what to do about it."""
        option = f"--max-memory-mb {max(round(2 * self._memory / MEGABYTE), 1)}"
        wanted = f"a recording that takes less; if this is one, {option} lets it take more"
        return InputError(self.source, f"{found} (the file has {in_mb(self.size)})", wanted)


def in_mb(count: int) -> str:
    """Return bytes as people read them."""
    return f"{count / MEGABYTE:.3g} MB"
