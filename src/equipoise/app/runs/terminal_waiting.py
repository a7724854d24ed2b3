"""A person at the terminal who waits for a run: signs of life, live numbers, steps as they come."""

from collections.abc import Iterator
from functools import partial

from equipoise.app.console.rich_blocks import show
from equipoise.app.console.terminal import busy, counted, spread_over, watched
from equipoise.app.live.status_block import TerminalView, watched_by
from equipoise.app.runs.balancing import Through
from equipoise.app.runs.waiting import Waiting
from equipoise.app.text.run_blocks import moment_of
from equipoise.model.step import Step
from equipoise.model.testbed import Testbed

AT_TERMINAL = Waiting(watched, busy, counted, spread_over)


def at_terminal(testbed: Testbed) -> Through:
    """Return how a person at the terminal watches a balancing."""
    view = TerminalView(testbed)

    def awaited(steps: Iterator[Step], what: str) -> Iterator[Step]:
        for step in watched(steps, what, view):
            view.step(step)
            yield step

    return Through(partial(watched_by, view), awaited)


def show_step(step: Step) -> None:
    """Print a step as it comes."""
    show((moment_of(step),))
