"""What a recording can show, for terminal, JSON and report."""

import math
from collections.abc import Iterator, Sequence
from typing import Any

from equipoise.app.report.run_record import Output, RunRecord, origin
from equipoise.app.runs.recordings.observation import Observation
from equipoise.app.text.blocks import (
    Blocks,
    Claim,
    Column,
    Row,
    Section,
    Table,
    number,
    paragraphs,
    prose,
    table,
    tabulated,
)
from equipoise.app.text.json_results import OBSERVE
from equipoise.app.text.json_shape import View
from equipoise.app.text.numbers import unit_for, with_sd
from equipoise.app.text.run_blocks import reason_items
from equipoise.maths.linalg import element_sizes
from equipoise.model.estimate import COM, INERTIA, Parameter
from equipoise.model.observability import FilterView, Observability
from equipoise.model.units import DEG, PERCENT

BODY = (*COM, *INERTIA)
Texts = tuple[str, str, str, str, str]


def output_of(done: Observation) -> Output:
    """Return all that is handed over."""
    return Output("observe", document(done), blocks(done), lambda: record_of(done))


def blocks(done: Observation) -> Blocks:
    """Return bounds, filters, and what is unobservable."""
    found = done.bounds
    return (
        *bound_tables(found),
        filter_table(done.filters),
        *unobserved_blocks(found),
        rank_claim(found),
    )


def bound_tables(information: Observability) -> Blocks:
    """Return the least sd of all that is sought."""
    others = [name for name in information.names if name not in BODY]
    ratios = (ratio_table(information.ratios),) if information.ratios else ()
    body = bound_table("Centre of mass and inertia about P, masses at home", information, BODY)
    return (body, bound_table("Also sought", information, others), *ratios)


def unobserved_blocks(information: Observability) -> Blocks:
    """Return what the motion does not show, and how far it goes."""
    unobserved = reason_items((*information.cautions, *information.unobservable))
    return (*unobserved, *paragraphs(sweep_line(information)))


def record_of(done: Observation) -> RunRecord:
    """Return what a recording can show as a report."""
    return RunRecord(
        title="What a recording can determine",
        requested={
            "recording": done.recording.source,
            "unknowns": ", ".join(done.bounds.names),
        },
        testbed=done.testbed,
        conclusion=(rank_claim(done.bounds),),
        sections=(
            Section(
                "Cramer-Rao bounds: smallest sd of any unbiased method", bound_tables(done.bounds)
            ),
            Section("Filters", (filter_table(done.filters),)),
            Section("What the motion does not determine", unobserved_blocks(done.bounds)),
        ),
        origin=origin(sha256=done.recording.sha256),
    )


def rows_of(information: Observability, names: Sequence[str]) -> Iterator[Texts]:
    """Return name, bound, its share of J, prior sd, and unit."""
    sizes = dict(zip(INERTIA, element_sizes(information.inertia_P), strict=True))
    for name in names:
        k = information.names.index(name)
        unit, sd = unit_for(name, information.units[k]), float(information.sd[k])
        shown = name in sizes and 0 < sd < math.inf
        share = f"{sd / PERCENT / sizes[name]:.2g} %" if shown else ""
        before = float(information.before[k])
        stated = with_sd(0.0, before / unit.size)[1] if math.isfinite(before) else ""
        yield name, with_sd(0.0, sd / unit.size)[1], share, stated, unit.name


def bound_table(title: str, information: Observability, names: Sequence[str]) -> Table:
    """Return bounds of some parameters."""
    columns = (Column(), *map(number, ("least sd", "of J", "testbed's sd")), Column("unit"))
    rows = list(rows_of(information, names))
    shown = [k for k in range(len(columns)) if k == 0 or any(row[k] for row in rows)]
    hidden = dict(zip(information.names, information.hidden, strict=True))
    return table(
        title,
        (columns[k] for k in shown),
        (Row(tuple(row[k] for k in shown), "quiet" if hidden[row[0]] else "plain") for row in rows),
    )


def ratio_table(ratios: Sequence[Parameter]) -> Table:
    """Return bounds of what does not need the scale."""
    unit = {ratio.name: unit_for(ratio.name, ratio.unit) for ratio in ratios}
    return tabulated(
        "Ratios (independent of the scale)",
        ratios,
        (Column(), lambda ratio: ratio.name),
        (number("minimum sd"), lambda ratio: with_sd(0.0, ratio.sd / unit[ratio.name].size)[1]),
        (Column("unit"), lambda ratio: unit[ratio.name].name),
    )


def filter_table(filters: Sequence[FilterView]) -> Table:
    """Return how much of its state each filter observes, and what it does not."""
    return tabulated(
        "Observability of filter states along this motion",
        filters,
        (Column(), lambda view: view.name),
        (number("exact sensors"), lambda view: f"{view.possible} of {view.size}"),
        (number("these sensors"), lambda view: (
            f"no {view.measures}" if view.rank is None else f"{view.rank} of {view.size}")),
        (prose(), lambda view: "\n".join(reason.sentence for reason in view.unobservable)),
    )  # fmt: skip


def sweep_line(information: Observability) -> str:
    """Say how far the platform tilts and gravity moves in the body."""
    low, high = (angle / DEG for angle in information.tilt)
    away = math.asin(min(math.sqrt(information.gravity_sweep), 1.0)) / DEG
    return (
        f"Tilt from {low:.3g} to {high:.3g} deg; gravity varies by {away:.3g} deg rms "
        "around its mean direction in the body (least eigenvalue of its sweep "
        f"{information.gravity_sweep:.2g})."
    )


def rank_claim(information: Observability) -> Claim:
    """Say how much of what is sought is observable."""
    condition = (
        f"{information.condition:.2g}" if math.isfinite(information.condition) else "infinite"
    )
    return Claim(
        f"{information.rank} of {information.size} unknowns, or combinations of them, "
        f"are observable; condition number of the information: {condition}."
    )


def document(done: Observation) -> View:
    """Return what a recording can show as JSON, SI units."""
    recording, columns = done.recording, columns_of(done.bounds)
    rows = zip(*columns.values(), strict=True)
    return OBSERVE.write({
        "source": recording.source,
        "sha256": recording.sha256,
        "found": done.bounds,
        "parameters": [dict(zip(columns, row, strict=True)) for row in rows],
        "filters": done.filters,
    })  # fmt: skip


def columns_of(information: Observability) -> dict[str, list[Any]]:
    """Return the bounds as columns, SI."""
    return {
        "name": list(information.names),
        "unit": list(information.units),
        "sd": information.sd.tolist(),
        "testbed_sd": information.before.tolist(),
        "observable": (~information.hidden).tolist(),
        "held": information.held.tolist(),
    }
