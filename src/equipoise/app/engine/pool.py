"""An engine opened: an executor as ``concurrent.futures`` has them, and how much goes into it.

Whatever carries out many runs is such an executor: this process, processes beside it, a cluster.
"""

from collections.abc import Callable
from concurrent.futures import Executor, Future
from contextlib import AbstractContextManager, nullcontext
from dataclasses import dataclass
from typing import ParamSpec, TypeVar

P = ParamSpec("P")
T = TypeVar("T")
AHEAD = 2  # chunks a worker, chosen: the next one waits there when one is done


@dataclass(frozen=True, slots=True, eq=False)
class Pool:
    """An executor, its workers at this moment, and the chunks that each is given at once."""

    executor: Executor
    workers: Callable[[], int]
    ahead: int = AHEAD


Engine = Callable[[], AbstractContextManager[Pool]]


class InThisProcess(Executor):
    """Does each piece of work when it is submitted, here."""

    def submit(self, fn: Callable[P, T], /, *args: P.args, **kwargs: P.kwargs) -> Future[T]:
        """Do the work, and return its result or its error as a future; Ctrl-C goes through."""
        future = Future[T]()
        try:
            future.set_result(fn(*args, **kwargs))
        except Exception as error:
            future.set_exception(error)
        return future


def one() -> int:
    """Return the number of workers that this process is."""
    return 1


HERE = Pool(InThisProcess(), one, ahead=1)


def in_this_process() -> AbstractContextManager[Pool]:
    """Lend this process."""
    return nullcontext(HERE)
