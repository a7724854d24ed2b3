"""What a recording can show, for terminal and JSON."""

import math
from collections.abc import Iterator, Sequence

from rich.console import Group
from rich.text import Text

from equipoise.app.console.rich_tables import quiet_table, titled
from equipoise.app.console.terminal import stdout
from equipoise.app.runs.observation import Observation
from equipoise.app.text.json_document import View, numbers, parameter_json
from equipoise.app.text.numbers import with_sd
from equipoise.app.text.units import PER_DEG, unit_for
from equipoise.maths.linalg import element_sizes
from equipoise.model.estimate import COM, INERTIA, Parameter
from equipoise.model.observability import FilterView, Observability

SCHEMA = "equipoise/observe/1"
BODY = (*COM, *INERTIA)
PERCENT = 100.0
Row = tuple[str, str, str, str, str]


def rows_of(information: Observability, names: Sequence[str]) -> Iterator[Row]:
    """Return name, bound, its share of J, what is stated beforehand, and unit."""
    sizes = dict(zip(INERTIA, element_sizes(information.inertia_P), strict=True))
    for name in names:
        k = information.names.index(name)
        unit, sd = unit_for(name, information.units[k]), float(information.sd[k])
        share = shared(sd, sizes[name]) if name in sizes else ""
        before = float(information.before[k])
        stated = with_sd(0.0, before * unit.factor)[1] if math.isfinite(before) else ""
        yield name, with_sd(0.0, sd * unit.factor)[1], share, stated, unit.name


def shared(sd: float, size: float) -> str:
    """Return an sd as a share of a moment of inertia."""
    return f"{PERCENT * sd / size:.2g} %" if 0 < sd < math.inf else ""


def bound_table(title: str, information: Observability, names: Sequence[str]) -> Group:
    """Return bounds of some parameters."""
    table = quiet_table()
    heads = ("", "least sd", "of J", "testbed's sd", "unit")
    rows = list(rows_of(information, names))
    shown = [k for k in range(len(heads)) if k == 0 or any(row[k] for row in rows)]
    for k in shown:
        table.add_column(heads[k], justify="right" if 0 < k < 4 else "left")
    for row in rows:
        style = "dim" if information.hidden[information.names.index(row[0])] else ""
        table.add_row(*(Text(row[k]) for k in shown), style=style)
    return titled(title, table)


def ratio_table(ratios: Sequence[Parameter]) -> Group:
    """Return bounds of what does not need the scale."""
    table = quiet_table()
    table.add_column("", style="bold")
    table.add_column("least sd", justify="right")
    table.add_column("unit")
    for ratio in ratios:
        unit = unit_for(ratio.name, ratio.unit)
        table.add_row(ratio.name, with_sd(0.0, ratio.sd * unit.factor)[1], unit.name)
    return titled("Ratios, which do not need the scale", table)


def filter_table(filters: Sequence[FilterView]) -> Group:
    """Return what filters see of their state."""
    table = quiet_table()
    table.add_column("", no_wrap=True)
    for head in ("exact sensors", "these sensors"):
        table.add_column(head, justify="right", no_wrap=True)
    table.add_column("")
    for view in filters:
        with_noise = f"no {view.measures}" if view.rank is None else f"{view.rank} of {view.size}"
        sees = f"{view.possible} of {view.size}"
        table.add_row(Text(view.name, style="bold"), sees, with_noise, "\n".join(view.sentences))
    return titled("What filters see of their state along this motion", table)


def sweep_line(information: Observability) -> str:
    """Say how far the platform tilts and gravity moves in the body."""
    low, high = (angle * PER_DEG for angle in information.tilt)
    away = math.asin(min(math.sqrt(information.gravity_sweep), 1.0)) * PER_DEG
    return (
        f"Tilt from {low:.3g} to {high:.3g} deg; gravity leaves its mean direction in the body by "
        f"{away:.3g} deg rms (least eigenvalue of its sweep {information.gravity_sweep:.2g})."
    )


def rank_line(information: Observability) -> str:
    """Say how much of what is sought is seen."""
    number = f"{information.condition:.2g}" if math.isfinite(information.condition) else "infinite"
    return (
        f"{information.rank} of {information.size} unknowns, or mixtures of them, are observable; "
        "condition number of "
        f"the information: {number}."
    )


def show_observability(done: Observation) -> None:
    """Print bounds, filters, and what is not seen."""
    console, information, filters = stdout(), done.bounds, done.filters
    others = [name for name in information.names if name not in BODY]
    tables = [
        bound_table("Centre of mass and inertia about P, masses at home", information, BODY),
        bound_table("Also sought", information, others),
        *([ratio_table(information.ratios)] if information.ratios else []),
        filter_table(filters),
    ]
    for table in tables:
        console.print(table)
        console.print()
    for caution in information.cautions:
        console.print(f"! {caution}", style="yellow", markup=False)
    for sentence in information.sentences:
        console.print(f"! {sentence}", style="yellow", markup=False)
    console.print(sweep_line(information), markup=False)
    console.print(rank_line(information), markup=False, style="bold")


def observe_json(done: Observation) -> View:
    """Return what a recording can show, schema equipoise/observe/1."""
    recording, information, filters = done.recording, done.bounds, done.filters
    return {
        "schema": SCHEMA,
        "source": recording.source,
        "sha256": recording.sha256,
        "parameters": [bound_json(information, k) for k in range(len(information.names))],
        "ratios": [parameter_json(ratio) for ratio in information.ratios],
        "rank": information.rank,
        "size": information.size,
        "condition": information.condition,
        "gravity_sweep": information.gravity_sweep,
        "tilt_rad": list(information.tilt),
        "inertia_P_kg_m2": numbers(information.inertia_P),
        "unobservable": list(information.sentences),
        "cautions": list(information.cautions),
        "filters": [filter_json(view) for view in filters],
    }


def bound_json(information: Observability, k: int) -> View:
    """Return one bound, SI."""
    return {
        "name": information.names[k],
        "unit": information.units[k],
        "sd": float(information.sd[k]),
        "testbed_sd": float(information.before[k]),
        "observable": not bool(information.hidden[k]),
        "held": bool(information.held[k]),
    }


def filter_json(view: FilterView) -> View:
    """Return what a filter sees."""
    return {
        "name": view.name,
        "measures": view.measures,
        "size": view.size,
        "possible_rank": view.possible,
        "rank": view.rank,
        "unobservable": list(view.sentences),
    }
