"""A person at the terminal who waits for a run: signs of life, steps as they come."""

from collections.abc import Generator
from contextlib import contextmanager
from dataclasses import replace

from equipoise.app.arguments.checks import positive
from equipoise.app.arguments.options import Searching
from equipoise.app.arguments.search_time import budget_of
from equipoise.app.console.rich_blocks import show
from equipoise.app.console.terminal import (
    busy,
    counted,
    counted_pieces,
    say_what_is_done,
    watched,
)
from equipoise.app.engine.pool import Engine
from equipoise.app.engine.spread import spread_over
from equipoise.app.runs.waiting import Waiting
from equipoise.app.text.run_blocks import moment_of
from equipoise.estimation.search_budget import Budget, Stage
from equipoise.model.step import Step


def show_stage(stage: Stage) -> None:
    """Show what a search is at."""
    say_what_is_done(stage.value)


def budget_at_terminal(searching: Searching) -> Budget:
    """Return the budget of searches that a person at the terminal waits for."""
    return budget_of(positive("--budget-s", searching.budget_s), show_stage)


AT_TERMINAL = Waiting(watched, busy, counted, counted_pieces)


@contextmanager
def at_terminal_by(engine: Engine) -> Generator[Waiting]:
    """Lend how a person waits at the terminal for pieces of work that an engine does."""
    with engine() as pool:
        yield replace(AT_TERMINAL, spread=spread_over(pool))


def show_step(step: Step) -> None:
    """Print a step as it comes."""
    show((moment_of(step),))
