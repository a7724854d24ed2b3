"""Times that a table has as text, made seconds: dates of ISO 8601, clocks of the day."""

import math
import re
from collections.abc import Callable, Iterator
from dataclasses import replace
from datetime import UTC, datetime

import numpy as np

from equipoise.io.columns.column_map import ColumnMap
from equipoise.io.columns.table import Numbers, Table
from equipoise.model.errors import InputError

CLOCK = re.compile(r"(\d{1,2}):(\d\d)(?::(\d\d(?:[.,]\d+)?))?")
ISO = "ISO"
FORMATS = (ISO, "clock of the day")  # of times as text


def with_times_as_numbers(table: Table, columns: ColumnMap) -> Table:
    """Return a table whose time is in seconds, if a map says how it is written.

    Dates count from the first of them. A cell that is no such time is a faulty one.
    """
    if columns.time_format is None:
        return table
    name = columns.time[0].names[0]
    if table.cell is None or name not in table.names:
        return table
    first = _first(_cells(table, name))
    read = _seconds_of_day if columns.time_format != ISO else _since(first)
    values = np.fromiter(map(read, _cells(table, name)), np.float64, len(table))
    none = np.flatnonzero(np.isnan(values))
    garbage = [row for row in none.tolist() if table.cell(name, row).strip()]
    numbers = Numbers(values, garbage=np.array(garbage, dtype=np.int64))
    if len(none) == len(values):
        where, found = f"{table.source}, {table.place(0)}, column '{name}'", table.cell(name, 0)
        raise InputError(where, f"'{found.strip()}'", _example(columns.time_format))
    start = f"The clock starts at {first}; this is taken as zero."
    notes = (*table.notes, start) if columns.time_format == ISO else table.notes
    return _with_times(table, name, numbers, notes)


def _with_times(table: Table, time: str, numbers: Numbers, notes: tuple[str, ...]) -> Table:
    """Return a table whose times are numbers."""

    def column(_: Table, name: str) -> Numbers:
        return numbers if name == time else table.numbers(name)

    def rows(name: str, start: int, stop: int) -> Numbers:
        return numbers.part(start, stop) if name == time else table.rows_of(name, start, stop)

    return replace(table, column=column, rows=rows, notes=notes)


def _cells(table: Table, name: str) -> Iterator[str]:
    """Yield the texts of a column's cells."""
    assert table.cell is not None  # the caller has looked
    return (table.cell(name, row).strip() for row in range(len(table)))


def _first(cells: Iterator[str]) -> datetime | None:
    return next((date for date in map(_date, cells) if date is not None), None)


def _date(cell: str) -> datetime | None:
    """Return a date and time; one without a zone is taken as all the others are, in one zone."""
    try:
        date = datetime.fromisoformat(cell.replace(",", "."))
    except ValueError:
        return None
    return date if date.tzinfo is not None else date.replace(tzinfo=UTC)


def _since(first: datetime | None) -> Callable[[str], float]:
    """Return how a date becomes seconds since the first."""

    def seconds(cell: str) -> float:
        date = _date(cell)
        return math.nan if date is None or first is None else (date - first).total_seconds()

    return seconds


def _seconds_of_day(cell: str) -> float:
    match = CLOCK.fullmatch(cell)
    if match is None:
        return math.nan
    return (
        3600.0 * int(match[1]) + 60.0 * int(match[2]) + float((match[3] or "0").replace(",", "."))
    )


def _example(written: str) -> str:
    return (
        "a date such as '2024-05-03T14:11:40.123'" if written == ISO else "a time as '14:11:40.123'"
    )
