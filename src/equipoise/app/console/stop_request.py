"""Ctrl-C, SIGTERM and SIGHUP: one request to stop, made where it can be carried out.

A signal's handler raises between two lines of Python, whichever they are. The compiler, a module
that is being imported and a finaliser are no places to raise in: the exception is swallowed there,
or comes out as an error of another kind, and no bench would be stopped. So the request waits, is
made again soon, and after ``PATIENCE`` wherever it is.
"""

import _thread
import signal
import threading
import time
from collections.abc import Generator, Iterable
from contextlib import contextmanager
from types import FrameType

from equipoise.hardware.bench.stop_signals import HANG_UP, STOPPING, put_back

COMPILER = ("numba", "llvmlite")
IMPORTING = ("_frozen_importlib", "importlib")
CALLBACKS = ("weakref", "_weakrefset")  # an exception in a callback is only printed
UNFIT = (*COMPILER, *IMPORTING, *CALLBACKS)  # beginnings of modules' names
FINALISER = "__del__"
AGAIN = 0.02  # s, chosen: until a request that had to wait is made again
PATIENCE = 60.0  # s, chosen: the compiler takes some 20 s for the largest kernel
ECHO = 2.0  # s, chosen: for both kernel and shell to report that a terminal is gone


class Stopped(KeyboardInterrupt):
    """A request to stop, and the signal that made it."""

    def __init__(self, number: int) -> None:
        super().__init__()
        self.number = number


class Requests:
    """The handler of these signals: raises at once, or as soon as it can."""

    def __init__(self) -> None:
        self._pending: int | None = None
        self._since = 0.0  # when it was first to be made
        self._put_off = self._reminded = False
        self._raised = float("-inf")  # when a request was last made

    def on_signal(self, number: int, frame: FrameType | None) -> None:
        """Raise Stopped, unless it is put off, would be lost, or repeats what was said.

        A terminal that is gone may say so twice: that is no second request to leave.
        """
        reminded, self._reminded = self._reminded, False
        now = time.monotonic()
        echo = number == HANG_UP and now < self._raised + ECHO
        if echo or (reminded and self._pending is None):
            return
        if self._pending is None:
            self._since = now
        self._pending = number
        if self._put_off or (unfit(frame) and now < self._since + PATIENCE):
            _thread.start_new_thread(self._remind, (number,))
            return
        self.carry_out()

    def _remind(self, number: int) -> None:
        """Make a request again that had to wait; a thread's whole life."""
        time.sleep(AGAIN)
        if self._pending is not None:
            self._reminded = True
            signal.raise_signal(number)

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
        """Make the request that had to wait."""
        number, self._pending = self._pending, None
        if number is not None:
            self._raised = time.monotonic()
            raise Stopped(number)


def unfit(frame: FrameType | None) -> bool:
    """Say whether what is raised at a frame may be lost in one of its callers."""
    while frame is not None:
        module = str(frame.f_globals.get("__name__", ""))
        if module.startswith(UNFIT) or frame.f_code.co_name == FINALISER:
            return True
        frame = frame.f_back
    return False


@contextmanager
def stoppable(numbers: Iterable[int] = STOPPING) -> Generator[Requests]:
    """Let these signals request a stop; those that somebody ignores or has taken stay his.

    Within another such block, and outside the main thread, nothing changes.
    """
    requests = Requests()
    if threading.current_thread() is not threading.main_thread():
        yield requests
        return
    before = {number: signal.getsignal(number) for number in numbers}
    for handler in before.values():
        owner = getattr(handler, "__self__", None)
        if isinstance(owner, Requests):
            yield owner
            return
    ours = {number: handler for number, handler in before.items() if handler is usual(number)}
    try:
        for number in ours:
            signal.signal(number, requests.on_signal)
        yield requests
        requests.carry_out()
    finally:
        put_back(tuple(ours.items()))


def leave_to_system() -> None:
    """Let Ctrl-C end the program at once from here on, as a signal ends any program.

    All is written and every bench is closed; what Python still tidies up would only turn a request
    into a traceback, or lose it.
    """
    if signal.getsignal(signal.SIGINT) is signal.default_int_handler:
        signal.signal(signal.SIGINT, signal.SIG_DFL)


def usual(number: int) -> object:
    """Return the handler of a signal in a program that Python has just begun."""
    return signal.default_int_handler if number == signal.SIGINT else signal.SIG_DFL


def number_of(stop: KeyboardInterrupt) -> int:
    """Return the signal that requested a stop."""
    return stop.number if isinstance(stop, Stopped) else signal.SIGINT


def cause_of(stop: KeyboardInterrupt) -> str:
    """Return what requested a stop, as it stands behind "stopped by"."""
    number = number_of(stop)
    return "hand" if number == signal.SIGINT else signal.Signals(number).name


def exit_code_of(stop: KeyboardInterrupt) -> int:
    """Return what shells give a program that a signal ended."""
    return 128 + number_of(stop)
