"""A person at the terminal who watches a balancing: signs of life and live numbers."""

from collections.abc import Iterator
from functools import partial

from equipoise.app.console.terminal import watched
from equipoise.app.live.status_block import TerminalView, watched_by
from equipoise.app.runs.balancing import Through
from equipoise.model.step import Step
from equipoise.model.testbed import Testbed


def at_terminal(testbed: Testbed) -> Through:
    """Return how a person at the terminal watches a balancing."""
    view = TerminalView(testbed)

    def awaited(steps: Iterator[Step], what: str) -> Iterator[Step]:
        for step in watched(steps, what, view):
            view.step(step)
            yield step

    return Through(partial(watched_by, view), awaited)
