"""Ctrl-C, held back while a message is read from a pipe or written to it.

After a message that is cut in two, the next one has no beginning that can be found.
"""

import signal
import threading
from collections.abc import Generator
from contextlib import contextmanager


@contextmanager
def whole_message() -> Generator[None]:
    """Let the block end before Ctrl-C does what it does; outside the main thread it never does.

    A block that raises has ended, too: its error, a pipe that is broken, stops the run as well, and
    with an account of it.
    """
    if threading.current_thread() is not threading.main_thread():
        yield
        return
    requested: list[int] = []
    before = signal.signal(signal.SIGINT, lambda number, _frame: requested.append(number))
    try:
        yield
    finally:
        signal.signal(signal.SIGINT, signal.SIG_DFL if before is None else before)
    if requested:
        signal.raise_signal(signal.SIGINT)
