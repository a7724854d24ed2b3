"""Ctrl-C, held back while the compiler is at work.

The compiler calls back into Python from places where an exception is swallowed; it would then
fail in its own way, and no bench would be stopped. So the interruption waits until it is done.
"""

import signal
import threading
from collections.abc import Generator
from contextlib import contextmanager
from types import FrameType

COMPILER = ("numba", "llvmlite")


class Interruption:
    """A wish to stop, carried out at once or when the compiler is done."""

    def __init__(self) -> None:
        self._pending = self._put_off = False

    def on_sigint(self, _signal: int, frame: FrameType | None) -> None:
        """Raise KeyboardInterrupt, unless it is put off or would hit the compiler."""
        if not self._put_off and not compiling(frame):
            raise KeyboardInterrupt
        self._pending = True

    @contextmanager
    def put_off(self) -> Generator[None]:
        """Let something short be done whole, such as setting the terminal right again."""
        self._put_off = True
        try:
            yield
        finally:
            self._put_off = False
        self.carry_out()

    def carry_out(self) -> None:
        """Raise what was held back."""
        if self._pending:
            self._pending = False
            raise KeyboardInterrupt


def compiling(frame: FrameType | None) -> bool:
    """Say whether the compiler is among the callers of a frame."""
    while frame is not None:
        if str(frame.f_globals.get("__name__", "")).startswith(COMPILER):
            return True
        frame = frame.f_back
    return False


@contextmanager
def held_back() -> Generator[Interruption]:
    """Let the compiler finish before Ctrl-C takes effect; outside the main thread, do nothing."""
    interruption = Interruption()
    before = signal.getsignal(signal.SIGINT)
    own = threading.current_thread() is threading.main_thread()
    if not own or before is not signal.default_int_handler:
        yield interruption
        return
    signal.signal(signal.SIGINT, interruption.on_sigint)
    try:
        yield interruption
        interruption.carry_out()
    finally:
        signal.signal(signal.SIGINT, before)
