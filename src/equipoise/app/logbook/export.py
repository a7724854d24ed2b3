"""Runs of a logbook as a table: a line a run, SI units in the names of columns."""

from collections.abc import Sequence
from pathlib import Path
from typing import Any

from equipoise.app.text.csv_lines import csv_lines
from equipoise.io.documents.logbook import Logbook
from equipoise.io.files.atomic_file import write_whole
from equipoise.io.formats.parquet_table import parquet_of_cells
from equipoise.model.estimate import COM, INERTIA
from equipoise.model.logged_run import LoggedRun

TEXTS = ("name", "made_at", "platform", "configuration", "kind", "method", "bench", "outcome",
         "sentence")  # fmt: skip
JUDGED = "judged"
UNITS = dict.fromkeys(COM, "m") | dict.fromkeys(INERTIA, "kg_m2")


def write_export(book: Logbook, runs: Sequence[LoggedRun], path: Path) -> None:
    """Write the table as CSV or Parquet, as the file's name asks for."""
    columns = table(book, runs)
    if path.suffix.lower() == ".parquet":
        write_whole(path, parquet_of_cells(columns, str(path)))
    else:
        write_whole(path, csv_lines(list(columns), zip(*columns.values(), strict=True)))


def table(book: Logbook, runs: Sequence[LoggedRun]) -> dict[str, list[Any]]:
    """Return the columns; None for what a run has not."""
    columns: dict[str, list[Any]] = {c: [getattr(run, c) for run in runs] for c in TEXTS}
    columns["temperature_degC"] = [run.temperature for run in runs]
    home = [{p.name: p for p in book.numbers(run.name, "home")} for run in runs]
    judged = [{p.name: p for p in book.numbers(run.name, "standing")} for run in runs]
    parts = [("", home, (*COM, *INERTIA)), (f"{JUDGED}_", judged, COM)]
    for prefix, found, names in parts:
        for name in names:
            numbers = [each.get(name) for each in found]
            column = f"{prefix}{name}"
            columns[f"{column}_{UNITS[name]}"] = [None if p is None else p.value for p in numbers]
            columns[f"{column}_sd_{UNITS[name]}"] = [None if p is None else p.sd for p in numbers]
    return columns
