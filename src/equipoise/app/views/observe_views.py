"""What a recording can show, for terminal and JSON."""

import math
from collections.abc import Iterator, Sequence

from rich.console import Group
from rich.text import Text

from equipoise.app.console.rich_tables import quiet_table, titled
from equipoise.app.console.terminal import stdout
from equipoise.app.text.json_document import View, numbers, parameter_json
from equipoise.app.text.numbers import with_sd
from equipoise.app.text.units import PER_DEG, unit_for
from equipoise.estimation.information.filter_observability import FilterView
from equipoise.estimation.information.fisher_information import Observability
from equipoise.maths.linalg import element_sizes
from equipoise.model.estimate import COM, INERTIA, Parameter
from equipoise.model.recording import Recording

SCHEMA = "equipoise/observe/1"
BODY = (*COM, *INERTIA)
PERCENT = 100.0
Row = tuple[str, str, str, str, str]


def rows_of(seen: Observability, names: Sequence[str]) -> Iterator[Row]:
    """Return name, bound, its share of J, what is stated beforehand, and unit."""
    sizes = dict(zip(INERTIA, element_sizes(seen.inertia_P), strict=True))
    for name in names:
        k = seen.names.index(name)
        unit, sd = unit_for(name, seen.units[k]), float(seen.sd[k])
        share = shared(sd, sizes[name]) if name in sizes else ""
        before = float(seen.before[k])
        stated = with_sd(0.0, before * unit.factor)[1] if math.isfinite(before) else ""
        yield name, with_sd(0.0, sd * unit.factor)[1], share, stated, unit.name


def shared(sd: float, size: float) -> str:
    """Return an sd as a share of a moment of inertia."""
    return f"{PERCENT * sd / size:.2g} %" if 0 < sd < math.inf else ""


def bound_table(title: str, seen: Observability, names: Sequence[str]) -> Group:
    """Return bounds of some parameters."""
    table = quiet_table()
    heads = ("", "least sd", "of J", "testbed's sd", "unit")
    rows = list(rows_of(seen, names))
    shown = [k for k in range(len(heads)) if k == 0 or any(row[k] for row in rows)]
    for k in shown:
        table.add_column(heads[k], justify="right" if 0 < k < 4 else "left")
    for row in rows:
        style = "dim" if seen.hidden[seen.names.index(row[0])] else ""
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


def sweep_line(seen: Observability) -> str:
    """Say how far the platform tilts and gravity moves in the body."""
    low, high = (angle * PER_DEG for angle in seen.tilt)
    away = math.asin(min(math.sqrt(seen.gravity_sweep), 1.0)) * PER_DEG
    return (
        f"Tilt from {low:.3g} to {high:.3g} deg; gravity leaves its mean direction in the body by "
        f"{away:.3g} deg rms (least eigenvalue of its sweep {seen.gravity_sweep:.2g})."
    )


def rank_line(seen: Observability) -> str:
    """Say how much of what is sought is seen."""
    number = f"{seen.condition:.2g}" if math.isfinite(seen.condition) else "infinite"
    return (
        f"{seen.rank} of {seen.size} unknowns, or mixtures of them, are seen; condition number of "
        f"the information: {number}."
    )


def show_observability(seen: Observability, filters: Sequence[FilterView]) -> None:
    """Print bounds, filters, and what is not seen."""
    console = stdout()
    others = [name for name in seen.names if name not in BODY]
    tables = [
        bound_table("Centre of mass and inertia about P, masses at home", seen, BODY),
        bound_table("Also sought", seen, others),
        *([ratio_table(seen.ratios)] if seen.ratios else []),
        filter_table(filters),
    ]
    for table in tables:
        console.print(table)
        console.print()
    for caution in seen.cautions:
        console.print(f"! {caution}", style="yellow", markup=False)
    for sentence in seen.sentences:
        console.print(f"! {sentence}", style="yellow", markup=False)
    console.print(sweep_line(seen), markup=False)
    console.print(rank_line(seen), markup=False, style="bold")


def observe_json(recording: Recording, seen: Observability, filters: Sequence[FilterView]) -> View:
    """Return what a recording can show, schema equipoise/observe/1."""
    return {
        "schema": SCHEMA,
        "source": recording.source,
        "sha256": recording.sha256,
        "parameters": [bound_json(seen, k) for k in range(len(seen.names))],
        "ratios": [parameter_json(ratio) for ratio in seen.ratios],
        "rank": seen.rank,
        "size": seen.size,
        "condition": seen.condition,
        "gravity_sweep": seen.gravity_sweep,
        "tilt_rad": list(seen.tilt),
        "inertia_P_kg_m2": numbers(seen.inertia_P),
        "unobservable": list(seen.sentences),
        "cautions": list(seen.cautions),
        "filters": [filter_json(view) for view in filters],
    }


def bound_json(seen: Observability, k: int) -> View:
    """Return one bound, SI."""
    return {
        "name": seen.names[k],
        "unit": seen.units[k],
        "sd": float(seen.sd[k]),
        "testbed_sd": float(seen.before[k]),
        "observable": not bool(seen.hidden[k]),
        "held": bool(seen.held[k]),
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
