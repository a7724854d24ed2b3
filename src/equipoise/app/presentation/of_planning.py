"""A plan beside the usual manoeuvre."""

from collections.abc import Iterator

from equipoise.app.presentation.tables import Table
from equipoise.app.runs.planning import Planning
from equipoise.model.estimate import COM, INERTIA

NAMES = (*COM, *INERTIA)


def lines(done: Planning) -> Iterator[str]:
    """Yield what the plan gains, and what to do."""
    from equipoise.app.views.plan_views import steps_of, verdict

    yield f"Plan for {done.request.testbed.name}: {verdict(done)}"
    for when, what in steps_of(done.planned.manoeuvre, done.request.testbed):
        yield f"  {when:8s} {what}"


def table(done: Planning) -> Table:
    """Return a row a parameter."""
    return {
        "name": list(NAMES),
        "unit": ["m"] * len(COM) + ["kg m2"] * len(INERTIA),
        "usual_sd": done.usual.sd_of(NAMES).tolist(),
        "planned_sd": done.planned.sd_of(NAMES).tolist(),
    }
