"""One way to do the same work on many pieces, whichever engine carries it out.

Work is a pure function, and so the results are the same whatever the engine, the chunks and the
order in which they come. Of several pieces that end in an error it is the first one's that is
raised: pieces are sent in their order, and what was sent before is awaited.
"""

from collections.abc import Callable, Generator, Iterable, Iterator, Sequence
from contextlib import AbstractContextManager, nullcontext
from itertools import chain
from typing import Any, Protocol, TypeVar

from equipoise.app.engine.pool import HERE, Pool
from equipoise.app.engine.sent_chunks import SentChunks

Piece = TypeVar("Piece")
Result = TypeVar("Result")
Report = Callable[[int, int], None]  # takes how many pieces are done, and of how many
Counting = Callable[[], AbstractContextManager[Report]]


class Spread(Protocol):
    """Does work on pieces; results come in the pieces' order."""

    def __call__(
        self, work: Callable[[Piece], Result], pieces: Sequence[Piece], /
    ) -> Iterator[Result]:
        """Yield the results."""
        ...


class Keeping(Protocol):
    """What keeps results as they come, and has those of before."""

    def found(self, pieces: Sequence[Any]) -> dict[int, Any]:
        """Return the results that are kept, by the index of their piece."""
        ...

    def keeping(self) -> AbstractContextManager[Callable[[Any, Any], None]]:
        """Lend what keeps a piece's result; at the end of the block all of them are on the disk."""
        ...


class KeepingNothing:
    """Has no results, and keeps none."""

    def found(self, pieces: Sequence[Any]) -> dict[int, Any]:
        """Return nothing."""
        return {}

    def keeping(self) -> AbstractContextManager[Callable[[Any, Any], None]]:
        """Lend what does nothing."""
        return nullcontext(lambda _piece, _result: None)


NOTHING_KEPT = KeepingNothing()


def uncounted() -> AbstractContextManager[Report]:
    """Count for nobody."""
    return nullcontext(lambda _done, _total: None)


def spread_over(pool: Pool, counting: Counting = uncounted, kept: Keeping = NOTHING_KEPT) -> Spread:
    """Return a way to do work by a pool; ``counting`` shows how many pieces are done."""

    def spread(work: Callable[[Piece], Result], pieces: Sequence[Piece]) -> Iterator[Result]:
        known = kept.found(pieces)
        missing = [k for k in range(len(pieces)) if k not in known]

        def fresh() -> Iterator[tuple[int, Result]]:
            with counting() as report, kept.keeping() as keep:
                report(len(known), len(pieces))
                arriving = as_they_come(pool, work, pieces, missing)
                for done, (index, result) in enumerate(arriving, len(known) + 1):
                    keep(pieces[index], result)
                    report(done, len(pieces))
                    yield index, result

        return in_order(chain(known.items(), fresh()))

    return spread


def as_they_come(
    pool: Pool,
    work: Callable[[Piece], Result],
    pieces: Sequence[Piece],
    indices: Sequence[int],
) -> Generator[tuple[int, Result]]:
    """Yield results of some of the pieces, with their indices, as soon as they are there."""
    chunks = SentChunks(pool, work, pieces, indices)
    try:
        while chunks.send():
            yield from chunks.awaited()
    finally:
        chunks.cancel()


def in_order(arriving: Iterable[tuple[int, Result]]) -> Iterator[Result]:
    """Yield results by their indices, from 0 on."""
    early, following = dict[int, Result](), 0
    for index, result in arriving:
        early[index] = result
        while following in early:
            yield early.pop(following)
            following += 1


IN_TURN = spread_over(HERE)
