"""A person at the terminal who waits for a run: signs of life on stderr."""

from contextlib import AbstractContextManager

from equipoise.app.console.process_pool import spread_over
from equipoise.app.console.terminal import busy, counted, watched
from equipoise.app.runs.waiting import Waiting


def _doing(what: str) -> AbstractContextManager[None]:
    return busy(what)


AT_TERMINAL = Waiting(watched, _doing, counted, spread_over)
