"""What a recording can show: bounds by parameter, and what filters observe."""

from collections.abc import Iterator
from typing import TYPE_CHECKING

from equipoise.app.presentation.tables import Arrays, Table, of_table
from equipoise.app.runs.observation import Observation
from equipoise.app.text.blocks import Block, Grid, Heading, Items
from equipoise.app.text.json_document import View
from equipoise.app.text.numbers import with_sd
from equipoise.app.text.units import unit_for
from equipoise.model.estimate import COM, INERTIA

if TYPE_CHECKING:
    from matplotlib.figure import Figure

HEADS = ("", "least sd", "of J", "testbed's sd", "unit")


def lines(done: Observation) -> Iterator[str]:
    """Yield rank, and the least sd of centre of mass and moments of inertia."""
    bounds = done.bounds
    of = done.recording.source or "a recording"
    yield f"Observation of {of}: {bounds.rank} of {bounds.size} unknowns are observable"
    for head, names in (("com", COM), ("inertia_P", INERTIA)):
        there = [bounds.names.index(name) for name in names if name in bounds.names]
        if there:
            unit = unit_for(names[0], bounds.units[there[0]])
            sds = (with_sd(0.0, float(bounds.sd[k]) * unit.factor)[1] for k in there)
            yield f"  {head:10s} least sd {', '.join(sds)} {unit.name}"


def blocks(done: Observation) -> Iterator[Block]:
    """Yield the bounds, what filters observe, and what is not observable."""
    from equipoise.app.views.observe_views import rows_of

    yield Heading("Least sd that any method can reach")
    yield Grid(HEADS, tuple(rows_of(done.bounds, done.bounds.names)))
    yield Heading("What filters can observe of their state")
    yield Grid(("filter", "possible", "rank", "size"), tuple(
        (view.name, str(view.possible), "" if view.rank is None else str(view.rank),
         str(view.size)) for view in done.filters
    ))  # fmt: skip
    if done.bounds.sentences or done.bounds.cautions:
        yield Items((*done.bounds.cautions, *done.bounds.sentences))


def document(done: Observation) -> View:
    """Return what `equipoise observe --json` prints."""
    from equipoise.app.views.observe_views import observe_json

    return observe_json(done)


def table(done: Observation) -> Table:
    """Return a row a parameter."""
    bounds = done.bounds
    return Table(
        "name",
        {
            "name": list(bounds.names),
            "unit": list(bounds.units),
            "sd": bounds.sd.tolist(),
            "testbed_sd": bounds.before.tolist(),
            "observable": (~bounds.hidden).tolist(),
            "held": bounds.held.tolist(),
        },
    )


def arrays(done: Observation) -> Arrays:
    """Return the table's columns along the names."""
    return of_table(table(done))


def figure(done: Observation) -> "Figure | None":
    """Return nothing: bounds have no figure of their own."""
    return None
