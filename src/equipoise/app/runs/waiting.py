"""How somebody waits for a run: at a terminal with signs of life, or quietly."""

from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import ProcessPoolExecutor
from contextlib import AbstractContextManager, nullcontext
from dataclasses import dataclass, replace
from multiprocessing import get_context
from typing import Any

from equipoise.model.step import Step

Work = Callable[[Any], Any]
Spreading = Callable[[Work, Sequence[Any]], Iterator[Any]]
Share = Callable[[float], None]


@dataclass(frozen=True, slots=True, eq=False)
class Waiting:
    """What goes on while steps, searches and many runs are awaited; texts say what is done."""

    steps: Callable[[Iterator[Step], str], Iterator[Step]]
    doing: Callable[[str], AbstractContextManager[None]]
    search: Callable[[str], AbstractContextManager[Share]]  # yields what takes the share done
    spread: Callable[[int, str], Spreading]  # over so many processes, results in order


def as_they_come(steps: Iterator[Step], _what: str) -> Iterator[Step]:
    """Return the steps as they are."""
    return steps


def spread_quietly(workers: int, _what: str) -> Spreading:
    """Return a way to do work on items in so many processes; one is this process itself."""

    def spread(work: Work, items: Sequence[Any]) -> Iterator[Any]:
        if workers == 1:
            yield from map(work, items)
            return
        with ProcessPoolExecutor(workers, mp_context=get_context("spawn")) as pool:
            yield from pool.map(work, items)

    return spread


QUIET = Waiting(
    as_they_come,
    doing=lambda _what: nullcontext(),
    search=lambda _what: nullcontext(lambda _share: None),
    spread=spread_quietly,
)


def shown(steps: Iterator[Step], on_step: Callable[[Step], None] | None) -> Iterator[Step]:
    """Yield steps, each shown as it is done, if there is somebody to show it to."""
    for step in steps:
        if on_step is not None:
            on_step(step)
        yield step


def passing_on(on_step: Callable[[Step], None] | None) -> Waiting:
    """Return how to wait quietly, each step being passed on as it is done."""

    def passed_on(steps: Iterator[Step], _what: str) -> Iterator[Step]:
        return shown(steps, on_step)

    return replace(QUIET, steps=passed_on)
