"""What a recording can show: bounds by parameter, and what filters observe."""

from collections.abc import Iterator
from typing import TYPE_CHECKING

from equipoise.app.presentation.tables import Arrays, Table, of_table
from equipoise.app.runs.observation import Observation
from equipoise.app.text.blocks import Blocks
from equipoise.app.text.json_shape import View
from equipoise.app.text.numbers import with_sd
from equipoise.app.text.units import unit_for
from equipoise.model.estimate import COM, INERTIA

if TYPE_CHECKING:
    from matplotlib.figure import Figure


def lines(done: Observation) -> Iterator[str]:
    """Yield rank, and the least sd of centre of mass and moments of inertia."""
    bounds = done.bounds
    of = done.recording.source or "a recording"
    yield f"Observation of {of}: {bounds.rank} of {bounds.size} unknowns are observable"
    for head, names in (("com", COM), ("inertia_P", INERTIA)):
        there = [bounds.names.index(name) for name in names if name in bounds.names]
        if there:
            unit = unit_for(names[0], bounds.units[there[0]])
            sds = (with_sd(0.0, float(bounds.sd[k]) / unit.size)[1] for k in there)
            yield f"  {head:10s} least sd {', '.join(sds)} {unit.name}"


def blocks(done: Observation) -> Blocks:
    """Return what the command prints."""
    from equipoise.app.views import observe_views

    return observe_views.blocks(done)


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
