"""Chunks that were sent to a pool and have not come back; as many as keep its workers busy."""

from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import FIRST_COMPLETED, BrokenExecutor, CancelledError, Future, wait
from typing import Any

from equipoise.app.engine.chunks import Done, Pace, chunk_done
from equipoise.app.engine.pool import Pool
from equipoise.model.errors import InputError
from equipoise.model.version import __version__

LOST = "its sudden end, as when memory is exhausted"
GONE = "no scheduler any more: it, or its connection, has ended"
RESUME = "; completed runs kept by --resume are not computed again"


class SentChunks:
    """Some pieces of work on their way, chunk by chunk, in their order."""

    def __init__(
        self,
        pool: Pool,
        work: Callable[[Any], Any],
        pieces: Sequence[Any],
        indices: Sequence[int],
    ) -> None:
        self._pool, self._work, self._pieces, self._indices = pool, work, pieces, indices
        self._next, self._pace = 0, Pace()
        self._sent = dict[Future[Done], Sequence[int]]()
        self._errors = dict[int, BaseException]()  # by the first piece of their chunk

    def send(self) -> bool:
        """Send chunks as long as workers want some; say whether any is awaited.

        After an error no more are sent. It is raised when none is awaited.
        """
        workers = self._pool.workers()
        while self._rest and not self._errors and len(self._sent) < self._pool.ahead * workers:
            size = self._pace.size(workers)
            self._send_one(self._indices[self._next : self._next + size])
            self._next += size
        if self._errors and not self._sent:
            raise self._errors[min(self._errors)]
        return bool(self._sent)

    @property
    def _rest(self) -> bool:
        return self._next < len(self._indices)

    def _send_one(self, indices: Sequence[int]) -> None:
        pieces = [self._pieces[k] for k in indices]
        try:
            sent = self._pool.executor.submit(chunk_done, __version__, self._work, pieces, indices)
        except BrokenExecutor as error:
            self._errors[indices[0]] = _explained(error)
        else:
            self._sent[sent] = indices

    def awaited(self) -> Iterator[tuple[int, Any]]:
        """Wait for one chunk at least; yield results of those that are back, with their indices."""
        for future in wait(self._sent, return_when=FIRST_COMPLETED).done:
            indices = self._sent.pop(future)
            try:
                done = future.result()
            except (Exception, CancelledError) as error:
                self._errors[indices[0]] = _explained(error)
                continue
            self._pace.note(len(indices), done.seconds)
            yield from zip(indices, done.results, strict=True)

    def cancel(self) -> None:
        """Give up what is on its way."""
        for future in self._sent:
            future.cancel()


def _explained(error: BaseException) -> BaseException:
    """Return an error of an engine as a sentence, and one of the work as it is."""
    if isinstance(error, BrokenExecutor):
        found = InputError("a worker process", LOST, f"more memory, or fewer --workers{RESUME}")
    elif isinstance(error, CancelledError):
        found = InputError("--on", GONE, f"a scheduler that runs until the work is done{RESUME}")
    else:
        return error
    found.__cause__ = error
    return found
