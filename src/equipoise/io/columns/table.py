"""A table of a file, whatever its format: named columns of numbers that are read when asked for."""

from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np

from equipoise.io.columns.row_faults import FaultyRows
from equipoise.model.arrays import Bools, Ints, Series1

BLANK = "a blank cell"
Lines = range | Ints  # of a file: one for each row


def no_rows() -> Ints:
    """Return no row."""
    return np.zeros(0, dtype=np.int64)


@dataclass(frozen=True, slots=True, eq=False)
class Numbers:
    """One column."""

    values: Series1  # NaN where there is no finite number
    nan: Ints = field(default_factory=no_rows)  # rows whose cell says that it is no number
    garbage: Ints = field(default_factory=no_rows)  # rows whose cell holds something else

    def part(self, start: int, stop: int) -> "Numbers":
        """Return the rows from one to before another."""
        return Numbers(
            self.values[start:stop],
            rows_between(self.nan, start, stop),
            rows_between(self.garbage, start, stop),
        )


def finite(values: Series1, blank: Bools | None = None) -> Numbers:
    """Return a column of numbers as they are in memory; where it is ``blank`` nothing is said."""
    infinite = np.flatnonzero(np.isinf(values))
    nan = np.isnan(values)
    if blank is not None:
        nan &= ~blank
    clean = np.where(np.isfinite(values), values, np.nan) if len(infinite) else values
    return Numbers(clean, np.flatnonzero(nan), infinite)


def rows_between(rows: Ints, start: int, stop: int) -> Ints:
    """Return which of some rows, in order, are in a part of a table, counted from its first."""
    first, last = np.searchsorted(rows, [start, stop])
    return rows[first:last] - start


@dataclass(frozen=True, slots=True, eq=False)
class Table:
    """Named columns of numbers, each row with a place that a person can find.

    A column stays as it stands in the file until it is asked for: foreign tables carry many columns
    that nobody needs.
    """

    source: str  # the file
    names: tuple[str, ...]  # of the columns
    count: int  # rows
    column: Callable[["Table", str], Numbers]  # InputError for a column that is none of numbers
    lines: Lines = range(0)  # the line of the file each row ends on; none: rows are counted
    notes: tuple[str, ...] = ()  # what reading the table had to leave out
    faulty: tuple[FaultyRows, ...] = ()  # rows that hold nothing: a line that was cut, say
    cell: Callable[[str, int], str] | None = None  # what a cell holds, as text
    units: tuple[str, ...] = ()  # of the columns, as a row below the names has them
    blank: str = BLANK  # how this kind of file says that there is no reading
    # Some rows of a column, where they are read without the rest.
    rows: Callable[[str, int, int], Numbers] | None = None

    def __len__(self) -> int:
        """Return the number of rows."""
        return self.count

    def place(self, row: int) -> str:
        """Return where a row is, such as 'line 7' or, counted from 1, 'row 7'."""
        return f"line {self.lines[row]}" if len(self.lines) else f"row {row + 1}"

    def numbers(self, name: str) -> Numbers:
        """Return a column; InputError if it is none of numbers."""
        return self.column(self, name)

    def part(self, start: int, stop: int) -> "Table":
        """Return the rows from one to before another, without notes on the whole."""
        cell = self.cell
        return Table(
            self.source,
            self.names,
            stop - start,
            lambda _, name: self.rows_of(name, start, stop),
            self.lines[start:stop],
            cell=None if cell is None else lambda name, row: cell(name, start + row),
            units=self.units,
            blank=self.blank,
        )

    def rows_of(self, name: str, start: int, stop: int) -> Numbers:
        """Return the rows of a column from one to before another."""
        if self.rows is not None:
            return self.rows(name, start, stop)
        return self.numbers(name).part(start, stop)

    def found(self, name: str, row: int) -> str:
        """Return what stands in a cell that holds no finite number, as an error quotes it."""
        text = "" if self.cell is None else self.cell(name, row).strip()
        return f"'{text}'" if text else BLANK
