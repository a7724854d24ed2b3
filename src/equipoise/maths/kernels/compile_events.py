"""Tells who listens when kernels are compiled, once on a computer, so that a wait can be explained.

Whoever listens need not wait until the compiler is loaded.
"""

from collections.abc import Callable, Generator
from contextlib import contextmanager
from typing import Any, NamedTuple


class Listener(NamedTuple):
    """Called when the compiler begins and when it has ended."""

    begun: Callable[[], None]
    ended: Callable[[], None]


LISTENERS: list[Listener] = []


@contextmanager
def compiler_notices(begun: Callable[[], None], ended: Callable[[], None]) -> Generator[None]:
    """Call when the compiler begins and when it has ended."""
    listener = Listener(begun, ended)
    LISTENERS.append(listener)
    try:
        yield
    finally:
        LISTENERS.remove(listener)


def install() -> None:
    """Pass the compiler's own events on; kernels that are loaded do not count."""
    from numba.core import event

    class Outermost(event.Listener):
        """A kernel may have others compiled on the way: the outermost counts."""

        depth, listening = 0, ()

        def on_start(self, event: Any) -> None:
            self.depth += 1
            if self.depth == 1:
                self.listening = tuple(LISTENERS)
                for each in self.listening:
                    each.begun()

        def on_end(self, event: Any) -> None:
            self.depth -= 1
            if self.depth == 0:
                for each in self.listening:
                    each.ended()

    event.register("numba:compile", Outermost())
