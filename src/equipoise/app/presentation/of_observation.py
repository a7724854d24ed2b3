"""What a recording can show: bounds by parameter, and what filters observe."""

from collections.abc import Iterator

from equipoise.app.presentation.tables import Table
from equipoise.app.runs.recordings.observation import Observation
from equipoise.app.text.numbers import unit_for, with_sd
from equipoise.model.estimate import COM, INERTIA


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
            yield f"{head:10s} minimum sd {', '.join(sds)} {unit.name}"


def table(done: Observation) -> Table:
    """Return a row a parameter."""
    from equipoise.app.views.observe_views import columns_of

    return columns_of(done.bounds)
