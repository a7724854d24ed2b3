"""The time that a search may take: processor time of this process, less what compiling takes.

Waiting for others costs nothing, and the first run on a computer may take as long as any.
"""

import time
from collections.abc import Callable
from functools import cache, partial

from equipoise.estimation.search_budget import Budget, Stage, unwatched
from equipoise.maths.kernels.compile_events import LISTENERS, Listener


class CompilerTime:
    """Processor time (s) that the compiler has taken since this was made."""

    def __init__(self) -> None:
        self._since, self.total = 0.0, 0.0

    def begin(self) -> None:
        """Notice that the compiler begins."""
        self._since = time.process_time()

    def end(self) -> None:
        """Notice that it has ended."""
        self.total += time.process_time() - self._since


@cache
def compiler_time() -> CompilerTime:
    """Return the compiler's time in this process, counted from the first call on."""
    found = CompilerTime()
    LISTENERS.append(Listener(found.begin, found.end))
    return found


def searched_for() -> float:
    """Return the processor time (s) of this process without the compiler's."""
    return time.process_time() - compiler_time().total


class Allowance:
    """So many seconds of processor time from now on."""

    def __init__(self, seconds: float) -> None:
        self._end = searched_for() + seconds

    def __call__(self) -> bool:
        """Say whether they are spent."""
        return searched_for() >= self._end


def budget_of(seconds: float, at: Callable[[Stage], None] = unwatched) -> Budget:
    """Return the budget of searches that may take so many seconds each."""
    return Budget(partial(Allowance, seconds), at)
