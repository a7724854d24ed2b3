"""Says that kernels are being compiled, once on a computer, while nothing else can be seen."""

from collections.abc import Callable, Generator
from contextlib import contextmanager
from typing import Any

from numba.core import event

from equipoise.app.terminal import COMPILING


@contextmanager
def told_of(tell: Callable[[str], None]) -> Generator[None]:
    """Tell when the compiler begins, and with an empty sentence when it has ended."""

    class Listener(event.Listener):
        """Hear when a kernel is compiled, not when it is only loaded."""

        depth = 0

        def on_start(self, event: Any) -> None:
            self.depth += 1
            if self.depth == 1:
                tell(f"{COMPILING} ...")

        def on_end(self, event: Any) -> None:
            self.depth -= 1
            if self.depth == 0:
                tell("")

    with event.install_listener("numba:compile", Listener()):
        yield
