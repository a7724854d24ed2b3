"""An estimate: its parameters with sd and interval."""

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING

import numpy as np

from equipoise.app.presentation.tables import Arrays, Table, Variable
from equipoise.app.text.blocks import Blocks, paragraphs
from equipoise.app.text.estimate_text import (
    cells,
    estimate_tables,
    outcome_claim,
    residual_line,
    unobservable_items,
)
from equipoise.app.text.json_document import estimate_json
from equipoise.app.text.json_shape import View
from equipoise.model.estimate import COM, INERTIA, Estimate

if TYPE_CHECKING:
    from matplotlib.figure import Figure

NAMED = (("com", COM), ("inertia_P", INERTIA))


def lines(estimate: Estimate) -> Iterator[str]:
    """Yield the outcome, centre of mass and inertia, and how many parameters there are beside."""
    yield f"Estimate by {estimate.method}: {estimate.outcome.sentence}"
    yield from parameter_lines(estimate)


def parameter_lines(estimate: Estimate) -> Iterator[str]:
    """Yield centre of mass and inertia in the bench's units."""
    shown = 0
    for head, names in NAMED:
        there = [name for name in names if estimate.has(name)]
        shown += len(there)
        if there:
            yield f"  {head:10s} {_values(estimate, there)}"
    if rest := len(estimate.parameters) - shown:
        yield f"  and {rest} more; to_pandas() has all"


def _values(estimate: Estimate, names: Sequence[str]) -> str:
    """Return axes, values and sd, and the unit once."""
    rows = [cells(estimate.parameters[estimate.index(name)]) for name in names]
    said = (f"{name.rsplit('_', 1)[1]} {value} +/- {sd}" for name, value, sd, _, _ in rows)
    return f"{', '.join(said)} {rows[0][-1]}"


def blocks(estimate: Estimate) -> Blocks:
    """Return the outcome, a table a group, what is unobservable, and the residual."""
    return (
        outcome_claim(estimate),
        *estimate_tables(estimate),
        *unobservable_items(estimate),
        *paragraphs(residual_line(estimate.residual)),
    )


def document(estimate: Estimate) -> View:
    """Return the estimate as JSON."""
    return estimate_json(estimate)


def table(estimate: Estimate) -> Table:
    """Return a row a parameter."""
    keys = ("name", "unit", "value", "sd", "low95", "high95", "observable")
    return {key: [getattr(p, key) for p in estimate.parameters] for key in keys}


def arrays(estimate: Estimate) -> Arrays:
    """Return values, sd and covariance along the names; units stand beside the values."""
    rows, along = table(estimate), ("name",)
    found = {key: Variable(along, rows[key])
             for key in ("unit", "value", "sd", "low95", "high95", "observable")}  # fmt: skip
    found["covariance"] = Variable(("name", "name_2"), estimate.covariance)
    names = rows["name"]
    of = {"name": Variable(along, names), "name_2": Variable(("name_2",), names)}
    if (course := estimate.course) is not None:
        found["course"] = Variable(("time_s", "course_name"), course.values)
        found["course_sd"] = Variable(("time_s", "course_name"), course.sd)
        of["time_s"] = Variable(("time_s",), course.t, "s")
        of["course_name"] = Variable(("course_name",), course.names)
    return Arrays(found, of, {"method": estimate.method, "outcome": estimate.outcome.sentence})


def figure(estimate: Estimate) -> "Figure | None":
    """Return centre of mass and inertia with their 95 % intervals."""
    from equipoise.app.figures.estimate import intervals

    shown = [p for p in estimate.parameters
             if p.name in (*COM, *INERTIA) and np.isfinite(p.sd)]  # fmt: skip
    return intervals.draw(shown) if shown else None
