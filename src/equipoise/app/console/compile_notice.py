"""Notices when kernels are compiled, once on a computer, so that the wait can be explained."""

from collections.abc import Callable, Generator
from contextlib import contextmanager
from typing import Any

from numba.core import event


@contextmanager
def compiler_notices(begun: Callable[[], None], ended: Callable[[], None]) -> Generator[None]:
    """Call when the compiler begins and when it has ended; kernels that are loaded do not count."""

    class Listener(event.Listener):
        """A kernel may have others compiled on the way: the outermost counts."""

        depth = 0

        def on_start(self, event: Any) -> None:
            self.depth += 1
            if self.depth == 1:
                begun()

        def on_end(self, event: Any) -> None:
            self.depth -= 1
            if self.depth == 0:
                ended()

    with event.install_listener("numba:compile", Listener()):
        yield
