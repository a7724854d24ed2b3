"""The last catch: what nobody has foreseen, wherever it was raised, as a sentence.

Threads, warnings and logs of libraries write to stderr past every console, tracebacks and names
included. Here they take the same way as everything else.
"""

import logging
import sys
import threading
import warnings
from collections.abc import Sequence

from equipoise.app.console.crash_file import crash_of
from equipoise.app.console.terminal import complain, stderr
from equipoise.app.text.escaping import for_terminal


def report_crash(error: BaseException, arguments: Sequence[str]) -> None:
    """Print the sentence; what a crash file would hold too, where none could be written."""
    crash = crash_of(error, arguments)
    complain(crash.sentence)
    if crash.path is None and sys.stderr is not None:
        stderr().print(crash.text)


def catch_threads(arguments: Sequence[str]) -> list[BaseException]:
    """Return a list that gets each error that ends a thread from now on; each is reported."""
    caught: list[BaseException] = []

    def catch(ended: threading.ExceptHookArgs) -> None:
        if ended.exc_value is not None and not issubclass(ended.exc_type, SystemExit):
            caught.append(ended.exc_value)
            report_crash(ended.exc_value, arguments)

    threading.excepthook = catch
    return caught


class _Visible(logging.Formatter):
    def format(self, record: logging.LogRecord) -> str:
        """Return what a library logs, all of it visible."""
        return for_terminal(super().format(record))


def show_libraries_words() -> None:
    """Let warnings and logs of libraries be text, whatever names they repeat."""
    warnings.formatwarning = _visible_warning
    if logging.lastResort is not None:
        logging.lastResort.setFormatter(_Visible())


def _visible_warning(
    message: Warning | str,
    category: type[Warning],
    filename: str,
    lineno: int,
    line: str | None = None,
) -> str:
    return for_terminal(f"{filename}:{lineno}: {category.__name__}: {message}\n")
