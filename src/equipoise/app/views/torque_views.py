"""The torque of each cause for terminal, JSON, CSV and report."""

from collections.abc import Iterator

from equipoise.app.figures.catalogue import Picture
from equipoise.app.figures.estimate import torque_by_cause
from equipoise.app.report.run_record import Output, RunRecord, origin
from equipoise.app.runs.recordings.torque_attribution import AttributedTorque
from equipoise.app.text.blocks import (
    Blocks,
    Claim,
    Column,
    Section,
    Table,
    number,
    tabulated,
)
from equipoise.app.text.csv_lines import csv_lines
from equipoise.app.text.estimate_text import estimate_tables, outcome_claim
from equipoise.app.text.json_shape import View
from equipoise.app.text.json_torque import LEDGER
from equipoise.app.text.run_blocks import reason_items
from equipoise.io.columns.cause_columns import cause_column
from equipoise.model.arrays import Series1
from equipoise.model.torque_by_cause import TorqueByCause
from equipoise.model.units import UN_M


def output_of(done: AttributedTorque) -> Output:
    """Return all that is handed over."""
    return Output("ledger", document(done.torque), blocks(done.torque), lambda: record_of(done))


def blocks(torque: TorqueByCause) -> Blocks:
    """Return the torque of each cause, and whether the sum closes the momentum balance."""
    closed, *others = torque.reasons
    claim = Claim(closed.sentence, "good" if torque.closes else "bad")
    return (cause_table(torque), claim, *reason_items(others, "plain"))


def document(torque: TorqueByCause) -> View:
    """Return the torque of each cause as JSON, SI units."""
    return LEDGER.write(torque)


def record_of(done: AttributedTorque) -> RunRecord:
    """Return the torque of each cause as a report, with its columns as CSV beside it."""
    torque, estimate = done.torque, done.estimate
    return RunRecord(
        title="Disturbance torque by cause",
        requested={"recording": done.recording.source},
        testbed=done.testbed,
        conclusion=blocks(torque)[1:],
        sections=(
            Section("Torque of each cause", (cause_table(torque),)),
            Section("The estimate", (*estimate_tables(estimate), outcome_claim(estimate))),
        ),
        origin=origin(sha256=done.recording.sha256),
        figures=list(pictures_of(torque)),
        files={"ledger.csv": csv_of(torque)},
    )


def pictures_of(torque: TorqueByCause) -> Iterator[Picture]:
    """Yield the figure of all causes."""
    drawn = torque_by_cause.draw(torque)
    yield Picture("torque_by_cause", torque_by_cause.CAPTION, drawn)


def cause_table(torque: TorqueByCause) -> Table:
    """Return rms, greatest and band of each cause, over all seconds and axes."""
    seconds = f"{len(torque.t)} intervals of {torque.interval:g} s"
    return tabulated(
        f"Torque in {seconds}, uN m per body axis",
        torque.courses,
        (Column(), lambda course: course.name),
        (number("rms x"), lambda course: f"{course.rms[0] / UN_M:.3g}"),
        (number("rms y"), lambda course: f"{course.rms[1] / UN_M:.3g}"),
        (number("rms z"), lambda course: f"{course.rms[2] / UN_M:.3g}"),
        (number("greatest"), lambda course: f"{course.greatest / UN_M:.3g}"),
        (number("sd"), lambda course: f"{course.typical_sd / UN_M:.3g}"),
    )


def columns_of(torque: TorqueByCause) -> dict[str, Series1]:
    """Return the torque of each cause as columns, SI, a row an interval."""
    return {"t_s": torque.t} | {cause_column(name): c for name, c in torque.columns.items()}


def csv_of(torque: TorqueByCause) -> str:
    """Return these columns as a CSV file."""
    columns = columns_of(torque)
    rows = zip(*(column.tolist() for column in columns.values()), strict=True)
    return csv_lines(list(columns), ([f"{value:.9g}" for value in row] for row in rows))
