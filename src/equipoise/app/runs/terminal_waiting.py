"""A person at the terminal who waits for a run: signs of life, steps as they come."""

from equipoise.app.arguments.checks import positive
from equipoise.app.arguments.options import Searching
from equipoise.app.arguments.search_time import budget_of
from equipoise.app.console.rich_blocks import show
from equipoise.app.console.terminal import (
    busy,
    counted,
    say_what_is_done,
    spread_over,
    watched,
)
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


AT_TERMINAL = Waiting(watched, busy, counted, spread_over)


def show_step(step: Step) -> None:
    """Print a step as it comes."""
    show((moment_of(step),))
