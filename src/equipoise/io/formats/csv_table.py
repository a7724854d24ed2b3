"""A separated text table: find separator and header, cut into cells, turn cells into numbers.

Cells stay text until a column is asked for: foreign tables carry many columns nobody needs.
"""

import csv
import math
from dataclasses import dataclass
from functools import partial

import numpy as np

from equipoise.io.columns.column_map import Layout
from equipoise.io.formats.csv_header import column_names, header_row
from equipoise.model.arrays import Series1
from equipoise.model.errors import InputError

SEPARATORS = (";", "\t")  # looked for before the comma, which may be a decimal comma
HEAD_LINES = 50  # lines; chosen: more than any header has
csv.field_size_limit(1 << 20)  # characters; a cell beyond this is not a table's


@dataclass(frozen=True, slots=True, eq=False)
class TextTable:
    """A table of text cells."""

    source: str
    names: tuple[str, ...]
    cells: tuple[tuple[str, ...], ...]  # by column
    lines: tuple[int, ...]  # the line of the file each row ends on
    decimal: str
    notes: tuple[str, ...] = ()

    def __len__(self) -> int:
        """Return the number of rows."""
        return len(self.lines)

    def place(self, row: int) -> str:
        """Return the line of a row."""
        return f"line {self.lines[row]}"

    def numbers(self, name: str) -> Series1:
        """Return a column, NaN where a cell is blank."""
        if self.names.count(name) > 1:
            raise InputError(f"{self.source}, header", f"two columns '{name}'", "one")
        column = self.cells[self.names.index(name)]
        try:
            values = np.array([float(cell) if cell else math.nan for cell in column])
        except ValueError:
            values = np.array([self._number(cell, row, name) for row, cell in enumerate(column)])
        for row in np.flatnonzero(~np.isfinite(values)).tolist():
            if column[row] and column[row].strip():
                raise self._not_a_number(row, name)
        return values

    def _number(self, cell: str, row: int, name: str) -> float:
        """Return one cell's number, NaN if it is blank."""
        text = cell.strip()
        if not text:
            return math.nan
        try:
            return float(text.replace(",", ".") if self.decimal == "," else text)
        except ValueError:
            raise self._not_a_number(row, name) from None

    def _not_a_number(self, row: int, name: str) -> InputError:
        where = f"{self.source}, {self.place(row)}, column '{name}'"
        cell = self.cells[self.names.index(name)][row].strip()
        return InputError(where, f"'{cell}'", "a finite number, or a blank cell for no reading")


def cut(text: str, source: str, layout: Layout) -> TextTable:
    """Return the table in a text."""
    separator = layout.separator or _separator(text)
    rows, lines = _rows(text, source, separator)
    if not rows:
        raise InputError(source, "nothing but blank lines", "a header and rows of numbers")
    head = header_row(rows) if layout.skip_rows is None else _row_after(lines, layout.skip_rows)
    if head >= len(rows):
        raise InputError(source, f"only {len(rows)} rows", "a header and rows of numbers")
    names = column_names(rows, head)
    body, kept, notes = _even(rows[head + 1 :], lines[head + 1 :], len(names), source)
    if not body:
        raise InputError(source, "a header but no rows", "rows of numbers")
    decimal = layout.decimal or ("," if separator != "," else ".")
    columns = tuple(zip(*body, strict=True))
    return TextTable(source, names, columns, tuple(kept), decimal, notes)


def _separator(text: str) -> str:
    """Return the separator that stands in most of the first lines."""
    lines = [line for line in text[: 1 << 16].splitlines()[:HEAD_LINES] if line.strip()]
    often = (s for s in SEPARATORS if sum(s in line for line in lines) * 2 > len(lines))
    return next(often, ",")


def _rows(text: str, source: str, separator: str) -> tuple[list[list[str]], list[int]]:
    """Return the rows that are not blank, and their lines."""
    rows: list[list[str]] = []
    lines: list[int] = []
    reader = csv.reader(text.splitlines(), delimiter=separator)
    try:
        for row in reader:
            if row and (row[0] or any(map(str.strip, row))):
                rows.append(row)
                lines.append(reader.line_num)
    except csv.Error as error:
        where = f"{source}, line {reader.line_num}"
        raise InputError(where, str(error), "a row of separated cells") from error
    return rows, lines


def _row_after(lines: list[int], skipped: int) -> int:
    """Return the first row after a number of lines."""
    return sum(line <= skipped for line in lines)


def _even(
    rows: list[list[str]], lines: list[int], width: int, source: str
) -> tuple[list[list[str]], list[int], tuple[str, ...]]:
    """Return rows of equal width; a last row that was cut short goes, with a note."""
    if not rows or set(map(len, rows)) == {width}:
        return rows, lines, ()
    notes: tuple[str, ...] = ()
    if len(rows[-1]) < width and len(rows) > 1:
        notes = (f"The last row (line {lines[-1]}) is cut short; it was left out.",)
        rows, lines = rows[:-1], lines[:-1]
    fit = partial(_fitted, width=width, source=source)
    return list(map(fit, rows, lines)), lines, notes


def _fitted(row: list[str], line: int, width: int, source: str) -> list[str]:
    """Return a row of the header's width; blank cells beyond it are a separator too many."""
    if len(row) < width or any(map(str.strip, row[width:])):
        raise InputError(f"{source}, line {line}", f"{len(row)} cells", f"{width}, as the header")
    return row[:width]
