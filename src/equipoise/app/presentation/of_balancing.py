"""A balancing: its steps, before and after, the verdict."""

from collections.abc import Iterator
from typing import TYPE_CHECKING

from equipoise.app.presentation.tables import Table
from equipoise.app.runs.balancing import Balancing, measurements
from equipoise.app.text.blocks import Blocks
from equipoise.app.text.run_blocks import moments

if TYPE_CHECKING:
    from matplotlib.figure import Figure


def lines(done: Balancing) -> Iterator[str]:
    """Yield how it ended, and how many steps it took."""
    bench = "simulated" if done.simulated else "real"
    moves = sum(step.kind == "move" for step in done.steps)
    end = done.steps[-1].time
    yield f"Balancing of {done.testbed.name} ({bench}) by {done.law}: {done.verdict.sentence}"
    yield f"  {len(done.steps)} steps, {moves} of them moves, {end:.4g} s of bench time"


def blocks(done: Balancing) -> Blocks:
    """Return steps, before and after, and the verdict."""
    from equipoise.app.views.balancing import balance_views

    return (*moments(done.steps), *balance_views.blocks(done))


def table(done: Balancing) -> Table:
    """Return a row a step."""
    steps = done.steps
    return {
        "step": list(range(1, len(steps) + 1)),
        "time_s": [step.time for step in steps],
        "kind": [step.kind for step in steps],
        "sentence": [step.sentence for step in steps],
    }


def figure(done: Balancing) -> "Figure | None":
    """Return the centre of mass at every estimate, with target, tolerance and truth."""
    from equipoise.app.figures.balancing import balanced_steps
    from equipoise.app.figures.balancing.story import Story
    from equipoise.app.views.balancing.balance_views import true_course

    if not measurements(done):
        return None
    goal = done.goal
    return balanced_steps.draw(
        Story(measurements(done), goal.target, goal.tolerance, true_course(done))
    )
