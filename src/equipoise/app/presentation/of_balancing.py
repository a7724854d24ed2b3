"""A balancing: its steps, before and after, the verdict."""

from collections.abc import Iterator
from typing import TYPE_CHECKING

from equipoise.app.presentation.block_parts import moments, step_table
from equipoise.app.presentation.tables import Arrays, Table, of_table
from equipoise.app.runs.balancing import Balancing, change_of, measurements
from equipoise.app.text.before_after import HEADS, rows
from equipoise.app.text.blocks import Block, Claim, Grid, Heading
from equipoise.app.text.json_document import View

if TYPE_CHECKING:
    from matplotlib.figure import Figure

BESIDE = 2  # columns of the truth, which only a simulated platform has


def lines(done: Balancing) -> Iterator[str]:
    """Yield how it ended, and how many steps it took."""
    bench = "simulated" if done.simulated else "real"
    moves = sum(step.kind == "move" for step in done.steps)
    end = done.steps[-1].time
    yield f"Balancing of {done.testbed.name} ({bench}) by {done.law}: {done.verdict.sentence}"
    yield f"  {len(done.steps)} steps, {moves} of them moves, {end:.4g} s of bench time"


def blocks(done: Balancing) -> Iterator[Block]:
    """Yield steps, before and after, and the verdict."""
    yield from moments(done.steps)
    change = change_of(done)
    if change is not None:
        found = list(rows(change))
        count = len(HEADS) if found[0].truth_before else len(HEADS) - BESIDE
        yield Heading("Before and after")
        yield Grid(HEADS[:count], tuple(tuple(row)[:count] for row in found))
    yield Claim(done.verdict.sentence, done.verdict.passed)


def document(done: Balancing) -> View:
    """Return what `equipoise balance --json` prints."""
    from equipoise.app.views.balance_views import document_of

    return document_of(done, done.seed)


def table(done: Balancing) -> Table:
    """Return a row a step."""
    return step_table(done.steps)


def arrays(done: Balancing) -> Arrays:
    """Return the table's columns along the steps."""
    return of_table(table(done))


def figure(done: Balancing) -> "Figure | None":
    """Return the centre of mass at every estimate, with target, tolerance and truth."""
    from equipoise.app.figures.balancing import balanced_steps
    from equipoise.app.figures.balancing.balanced_com import Story
    from equipoise.app.views.balance_views import true_course

    if not measurements(done):
        return None
    goal = done.goal
    return balanced_steps.draw(
        Story(measurements(done), goal.target, goal.tolerance, true_course(done))
    )
