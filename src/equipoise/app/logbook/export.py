"""Runs of a logbook as a table: a line a run, SI units in the names of columns."""

from pathlib import Path
from typing import Any

import numpy as np

from equipoise.app.text.csv_lines import csv_lines
from equipoise.io.documents.logbook import Choice, Logbook
from equipoise.io.files.atomic_file import write_whole
from equipoise.io.formats.parquet_table import parquet_of_cells
from equipoise.model.estimate import COM, INERTIA

TEXTS = ("name", "made_at", "platform", "configuration", "kind", "method", "bench", "outcome",
         "sentence")  # fmt: skip
TEMPERATURE = "temperature"
UNITS = dict.fromkeys(COM, "m") | dict.fromkeys(INERTIA, "kg_m2")
PARTS = {"home": ("", (*COM, *INERTIA)), "standing": ("judged_", COM)}  # prefix and names


def write_export(book: Logbook, choice: Choice, path: Path) -> None:
    """Write the table as CSV or Parquet, as the file's name asks for."""
    columns = table(book, choice)
    if path.suffix.lower() == ".parquet":
        write_whole(path, parquet_of_cells(columns, str(path)))
    else:
        cells = (c.tolist() if isinstance(c, np.ma.MaskedArray) else c for c in columns.values())
        write_whole(path, csv_lines(list(columns), zip(*cells, strict=True)))


def table(book: Logbook, choice: Choice) -> dict[str, Any]:
    """Return the columns; None, or masked, for what a run has not."""
    found = book.table((*TEXTS, TEMPERATURE), list(PARTS), choice)
    columns: dict[str, Any] = {name: found.columns[name] for name in TEXTS}
    columns["temperature_degC"] = found.columns[TEMPERATURE]
    for part, (prefix, names) in PARTS.items():
        numbers = found.numbers(part, names)
        for k, name in enumerate(names):
            for kind, values in (("", numbers.value), ("sd_", numbers.sd)):
                column = np.ma.array(values[:, k], mask=~numbers.there[:, k])
                columns[f"{prefix}{name}_{kind}{UNITS[name]}"] = column
    return columns
