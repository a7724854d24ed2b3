"""Work cut into chunks that are worth sending, and one chunk done.

    pieces = t / p,    t = max(0.1 s, 2 ms times the workers)

p being the time that a piece takes, by the latest chunks. To send a chunk costs some milliseconds,
on a cluster more; whoever sends them manages some hundreds a second (``docs/scale.md``). The first
chunks are single pieces, and none has more than twice as many as the one before: what comes first
may take longer, since kernels are loaded for it.
"""

import math
import time
from collections.abc import Callable, Sequence
from typing import Any, NamedTuple

from equipoise.model.errors import InputError
from equipoise.model.version import __version__

LEAST = 0.1  # s, chosen: a hundred times what it costs to send a chunk to a process
EACH = 2e-3  # s a worker, chosen: at most 500 chunks a second, all workers together
SHORTEST = 1e-9  # s: no piece takes less
FRESH = 0.5  # chosen: weight of the latest chunk in the time that a piece takes


class Done(NamedTuple):
    """The results of a chunk in the order of its pieces, and the time that it took."""

    results: list[Any]
    seconds: float


class Pace:
    """How many pieces the next chunk should have."""

    def __init__(self) -> None:
        self._each: float | None = None  # s
        self._size = 1

    def note(self, pieces: int, seconds: float) -> None:
        """Learn from a chunk that was done."""
        each = seconds / pieces
        self._each = each if self._each is None else self._each + FRESH * (each - self._each)

    def size(self, workers: int) -> int:
        """Return how many pieces are worth sending to one of so many workers."""
        if self._each is not None:
            wanted = max(LEAST, EACH * workers)
            fitting = math.ceil(wanted / max(self._each, SHORTEST))
            self._size = min(fitting, 2 * self._size)
        return self._size


def chunk_done(
    version: str, work: Callable[[Any], Any], pieces: Sequence[Any], indices: Sequence[int]
) -> Done:
    """Do pieces one after the other; an error names the index of its piece.

    InputError where this worker has another version of the program than who sent them.
    """
    if version != __version__:
        wanted = f"{version}, as on the sending side: results might differ"
        raise InputError("a worker", f"equipoise {__version__}", wanted)
    began, results = time.perf_counter(), list[Any]()
    for index, piece in zip(indices, pieces, strict=True):
        try:
            results.append(work(piece))
        except Exception as error:
            error.add_note(f"in chunk {index} of the work, counted from 0")
            raise
    return Done(results, time.perf_counter() - began)
