"""Ctrl-C and its like, held back while a message is read from a pipe or written to it.

After a message that is cut in two, the next one has no beginning that can be found.
"""

import signal
import threading
from collections.abc import Generator
from contextlib import contextmanager

from equipoise.hardware.bench.stop_signals import STOPPING, put_back


@contextmanager
def whole_message() -> Generator[None]:
    """Let the block end before a signal does what it does; in other threads none does anything.

    A block that raises has ended, too: its error, a pipe that is broken, stops the run as well, and
    with an account of it.
    """
    if threading.current_thread() is not threading.main_thread():
        yield
        return
    requested: list[int] = []
    before = {number: signal.getsignal(number) for number in STOPPING}
    try:
        for number in before:
            signal.signal(number, lambda number, _frame: requested.append(number))
        yield
    finally:
        put_back(tuple(before.items()))
    if requested:
        signal.raise_signal(requested[0])
