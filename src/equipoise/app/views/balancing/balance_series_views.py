"""A series of balancings for terminal, JSON and report."""

from collections.abc import Iterator

import numpy as np

from equipoise.app.figures.catalogue import Picture
from equipoise.app.figures.estimate import run_boxes
from equipoise.app.report.build import steps_section
from equipoise.app.report.run_record import Logged, Output, RunRecord, origin
from equipoise.app.report.series_files import name_of, recordings_of
from equipoise.app.runs.balance_series import BalancedSeries
from equipoise.app.runs.balancing import Balancing
from equipoise.app.text.blocks import Blocks, Column, Row, Table, number, table
from equipoise.app.text.json_document import BALANCE_SERIES
from equipoise.app.text.json_shape import View
from equipoise.app.text.numbers import fixed, with_sd
from equipoise.app.text.run_blocks import verdict_claim
from equipoise.app.views.balancing.balance_views import document_fields, requested
from equipoise.model.estimate import COM
from equipoise.model.units import UM
from equipoise.model.verdict import Verdict

TITLE = "Centre of mass as the masses stand, by the verdict of each run; and the truth"


def output_of(done: BalancedSeries) -> Output:
    """Return all that is handed over."""
    logged = Logged("balance", done.law, "simulated", None, verdict=done.verdict)
    return Output("balance_series", document(done), blocks(done), lambda: record_of(done), logged)


def blocks(done: BalancedSeries) -> Blocks:
    """Return a row a run, and the verdict."""
    return (runs_table(done), verdict_claim(done.verdict))


def runs_table(done: BalancedSeries) -> Table:
    """Return how each run ended."""
    columns = (
        Column("run"), *(number(name, "um") for name in COM), number("truth x, y, z", "um"),
        number("moves"), number("time", "s"), Column("verdict"),
    )  # fmt: skip
    count = len(done.runs)
    return table(TITLE, columns, (row_of(k, count, run) for k, run in enumerate(done.runs, 1)))


def row_of(k: int, count: int, run: Balancing) -> Row:
    """Return a run's texts."""
    cells = (
        name_of(k, count), *com_texts(run.verdict),
        ", ".join(fixed(float(value) / UM, 1) for value in run.truths[-1].com),
        str(sum(step.move is not None for step in run.steps)),
        fixed(run.steps[-1].time, 1), str(run.verdict.outcome),
    )  # fmt: skip
    return Row(cells, "plain" if run.verdict.passed else "bad")


def com_texts(verdict: Verdict) -> list[str]:
    """Return the centre of mass that a verdict states, with its sd."""
    if verdict.com is None or verdict.sd is None:
        return ["", "", ""]
    numbers = zip(verdict.com / UM, verdict.sd / UM, strict=True)
    return [" ± ".join(with_sd(float(value), float(sd))) for value, sd in numbers]


def document(done: BalancedSeries) -> View:
    """Return every run as JSON."""
    return BALANCE_SERIES.write({
        "verdict": done.verdict,
        "runs": [document_fields(run) | {"seed": run.seed} for run in done.runs],
    })  # fmt: skip


def pictures(done: BalancedSeries) -> Iterator[Picture]:
    """Yield where the runs leave the centre of mass, as box plots."""
    found = [run.verdict.com for run in done.runs if run.verdict.com is not None]
    if len(found) > 1:
        values, target = np.array(found).T, done.goal.target
        boxed = {
            name: run_boxes.Boxed([*map(float, column)], "m", None, float(wanted))
            for name, column, wanted in zip(COM, values, target, strict=True)
        }
        drawn = run_boxes.draw(boxed, "target")
        yield Picture("series_com", run_boxes.CAPTION_OF_BALANCING, drawn)


def record_of(done: BalancedSeries) -> RunRecord:
    """Return the series as a report; the recordings lie beside it."""
    count = len(done.runs)
    recordings = [run.recording for run in done.runs if run.recording is not None]
    return RunRecord(
        title="Balancing, a series of runs",
        requested={**requested(done.runs[0]), "law": done.law, "runs": str(count)},
        testbed=done.testbed,
        conclusion=blocks(done),
        sections=[
            steps_section(f"Steps of {name_of(k, count)}", run.steps, {})
            for k, run in enumerate(done.runs, 1)
        ],
        origin=origin(testbed=done.testbed.source),
        figures=list(pictures(done)),
        files=recordings_of(recordings),
    )
