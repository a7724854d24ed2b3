"""A plan beside the usual manoeuvre."""

from collections.abc import Iterator
from typing import TYPE_CHECKING

from equipoise.app.presentation.tables import Arrays, Table, of_table
from equipoise.app.runs.planning import Planning
from equipoise.app.text.blocks import Blocks
from equipoise.app.text.json_shape import View
from equipoise.model.estimate import COM, INERTIA

if TYPE_CHECKING:
    from matplotlib.figure import Figure

NAMES = (*COM, *INERTIA)


def lines(done: Planning) -> Iterator[str]:
    """Yield what the plan gains, and what to do."""
    from equipoise.app.views.plan_views import steps_of, verdict

    yield f"Plan for {done.request.testbed.name}: {verdict(done)}"
    for when, what in steps_of(done.planned.manoeuvre, done.request.testbed):
        yield f"  {when:8s} {what}"


def blocks(done: Planning) -> Blocks:
    """Return what the command prints."""
    from equipoise.app.views import plan_views

    return plan_views.blocks(done)


def document(done: Planning) -> View:
    """Return what `equipoise plan --json` prints."""
    from equipoise.app.views.plan_views import plan_json

    return plan_json(done)


def table(done: Planning) -> Table:
    """Return a row a parameter."""
    return Table(
        "name",
        {
            "name": list(NAMES),
            "unit": ["m"] * len(COM) + ["kg m2"] * len(INERTIA),
            "usual_sd": done.usual.sd_of(NAMES).tolist(),
            "planned_sd": done.planned.sd_of(NAMES).tolist(),
        },
    )


def arrays(done: Planning) -> Arrays:
    """Return the table's columns along the names."""
    return of_table(table(done))


def figure(done: Planning) -> "Figure | None":
    """Return nothing: a plan has no figure."""
    return None
