"""Work spread over processes, with a sign of life."""

from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import ProcessPoolExecutor
from multiprocessing import get_context
from typing import TypeVar

from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeElapsedColumn

from equipoise.app.console.terminal import stderr

Item = TypeVar("Item")
Result = TypeVar("Result")
Spreading = Callable[[Callable[[Item], Result], Sequence[Item]], Iterator[Result]]


def spread_over(workers: int, doing: str) -> Spreading[Item, Result]:
    """Return a way to do work on items in so many processes; results come in the items' order."""

    def spread(work: Callable[[Item], Result], items: Sequence[Item]) -> Iterator[Result]:
        columns = (TextColumn("{task.description}"), BarColumn(), MofNCompleteColumn(),
                   TimeElapsedColumn())  # fmt: skip
        with (
            Progress(*columns, console=stderr(), transient=True) as progress,
            ProcessPoolExecutor(workers, mp_context=get_context("spawn")) as pool,
        ):
            yield from progress.track(pool.map(work, items), len(items), description=doing)

    return spread
