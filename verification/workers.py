"""Spread work over processes; results come in the order of the items, whoever is first."""

from collections.abc import Callable, Iterable
from concurrent.futures import ProcessPoolExecutor
from multiprocessing import get_context
from typing import Any

from verification.result import Spread


def spread_over(
    workers: int, report: Callable[[int, int], None] = lambda done, total: None
) -> Spread:
    """Return a way to spread work over processes that tells how far it has come."""

    def spread(work: Callable[[Any], Any], items: Iterable[Any]) -> list[Any]:
        everything = list(items)
        found: list[Any] = []
        with ProcessPoolExecutor(workers, mp_context=get_context("spawn")) as pool:
            for answer in pool.map(work, everything):
                found.append(answer)
                report(len(found), len(everything))
        return found

    return spread
