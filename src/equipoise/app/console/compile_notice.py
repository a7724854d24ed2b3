"""Notices when kernels are compiled, once on a computer, so that the wait can be explained."""

from collections.abc import Callable, Generator
from contextlib import contextmanager
from typing import Any

from numba.core import event

COMPILE = "numba:compile"


class Compiling(event.Listener):
    """Calls when the compiler begins and when it has ended; kernels that are loaded do not count.

    A kernel may have others compiled on the way: the outermost counts.
    """

    def __init__(self, begun: Callable[[], None], ended: Callable[[], None]) -> None:
        self._begun, self._ended, self._depth = begun, ended, 0

    def on_start(self, event: Any) -> None:
        """Notice a kernel that is compiled."""
        self._depth += 1
        if self._depth == 1:
            self._begun()

    def on_end(self, event: Any) -> None:
        """Notice that it is."""
        self._depth -= 1
        if self._depth == 0:
            self._ended()


@contextmanager
def compiler_notices(begun: Callable[[], None], ended: Callable[[], None]) -> Generator[None]:
    """Call when the compiler begins and when it has ended."""
    with event.install_listener(COMPILE, Compiling(begun, ended)):
        yield
