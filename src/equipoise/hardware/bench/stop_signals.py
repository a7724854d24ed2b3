"""The signals by which people, services and terminals ask a program to stop.

SIGINT is Ctrl-C; SIGTERM is sent by a service that stops; SIGHUP by a terminal or an SSH session
that is gone. Windows has no SIGHUP.
"""

import signal
from collections.abc import Callable, Generator, Sequence
from contextlib import contextmanager
from types import FrameType
from typing import Any

NAMES = ("SIGINT", "SIGTERM", "SIGHUP")
STOPPING = tuple(signal.Signals[name] for name in NAMES if hasattr(signal, name))
HANG_UP: int | None = getattr(signal, "SIGHUP", None)
Handler = Callable[[int, FrameType | None], None]


def leave_to_commander() -> None:
    """Ignore them all, in a process that ends when its commander does.

    A terminal or a service tells all processes of a group at once; this one then has masses to halt
    and a record to close.
    """
    for number in STOPPING:
        signal.signal(number, signal.SIG_IGN)


@contextmanager
def handled(number: int | None, handler: Handler) -> Generator[None]:
    """Let a signal be handled otherwise for a while; not one that is ignored, as `nohup` wants."""
    before = None if number is None else signal.getsignal(number)
    if number is None or before in (None, signal.SIG_IGN):
        yield
        return
    signal.signal(number, handler)
    try:
        yield
    finally:
        signal.signal(number, before)


def put_back(before: Sequence[tuple[int, Any]]) -> None:
    """Give each signal its handler of before, the others too where one of these raises meanwhile.

    The first of them may be called before the second is there, at any of these lines: what it
    raises comes out in the end.
    """
    missing, raised = dict(before), None
    while missing:
        try:
            for number, handler in tuple(missing.items()):
                signal.signal(number, signal.SIG_DFL if handler is None else handler)
                del missing[number]
        except BaseException as error:
            raised = error
    if raised is not None:
        raise raised
