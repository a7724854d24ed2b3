"""A separated text table: find separator and header, cut into cells, turn cells into numbers.

What we write reads back to the last bit.

Motive writes several header lines (kind, name, identity, rotation or position) above the one with
X, Y, Z, W; a name that occurs twice there is distinguished by what stands above it.
"""

import csv
import math
from collections.abc import Mapping
from functools import partial

import numpy as np

from equipoise.io.columns.column_map import Layout
from equipoise.io.columns.table import Table
from equipoise.model.arrays import Series1
from equipoise.model.errors import InputError

SEPARATORS = (";", "\t")  # sought before the comma, which may be a decimal comma
HEAD_LINES = 50  # lines; chosen: more than any header has
SHARE = 0.5  # of a row's filled cells that must be numbers for it to hold data (chosen)
ABOVE = 3  # filled cells that a line above the header needs to belong to it (chosen)
csv.field_size_limit(1 << 20)  # characters; a cell beyond this is not a table's


def cut(text: str, source: str, layout: Layout) -> Table:
    """Return the table in a text."""
    separator = layout.separator or _separator(text)
    rows, lines = _rows(text, source, separator)
    return table_of(rows, lines, source, layout, "," if separator != "," else ".")


def table_of(
    rows: list[list[str]], lines: list[int], source: str, layout: Layout, decimal: str = "."
) -> Table:
    """Return the table in rows of cells and their lines, the header among them.

    ``decimal`` is the point of a number unless the layout states another.
    """
    if not rows:
        raise InputError(source, "nothing but blank lines", "a header and rows of numbers")
    skipped = layout.skip_rows
    head = _header_row(rows) if skipped is None else sum(line <= skipped for line in lines)
    if head >= len(rows):
        raise InputError(source, f"only {len(rows)} rows", "a header and rows of numbers")
    names = _column_names(rows, head)
    body, kept, notes = _even(rows[head + 1 :], lines[head + 1 :], len(names), source)
    if not body:
        raise InputError(source, "a header but no rows", "rows of numbers")
    cells = tuple(zip(*body, strict=True))
    column = partial(_numbers, cells=cells, decimal=layout.decimal or decimal)
    return Table(source, names, len(body), column, tuple(kept), notes)


def csv_text(columns: Mapping[str, Series1]) -> str:
    """Return a header and rows; NaN becomes a blank cell."""
    # Python prints the fewest digits (up to 17) that give the same double again.
    cells = [["" if x != x else repr(x) for x in map(float, v)] for v in columns.values()]
    rows = map(",".join, zip(*cells, strict=True))
    return "\n".join([",".join(columns), *rows]) + "\n"


def _numbers(table: Table, name: str, cells: tuple[tuple[str, ...], ...], decimal: str) -> Series1:
    """Return a column of cells (by column) as numbers, NaN where a cell is blank."""
    if table.names.count(name) > 1:
        raise InputError(f"{table.source}, header", f"two columns '{name}'", "one")
    column = cells[table.names.index(name)]
    try:
        values = np.array([float(cell) if cell else math.nan for cell in column])
    except ValueError:
        values = np.array([_number(cell, decimal) for cell in column])
    for row in np.flatnonzero(~np.isfinite(values)).tolist():
        found = column[row].strip()
        if found:
            raise table.not_a_number(row, name, found, "a blank cell")
    return values


def _number(cell: str, decimal: str) -> float:
    """Return one cell's number, NaN if it is blank or no number."""
    text = cell.strip()
    try:
        return float(text.replace(",", ".") if decimal == "," else text)
    except ValueError:
        return math.nan


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


def _header_row(rows: list[list[str]]) -> int:
    """Return the row before the first that holds data, as the next does; the first if none does.

    Motive's line of identities is all numbers as well, but more header follows it.
    """
    data = [_holds_data(row) for row in rows[:HEAD_LINES]]
    pairs = zip(data, [*data[1:], True], strict=True)
    first = next((i for i, (this, after) in enumerate(pairs) if this and after), 1)
    return max(first - 1, 0)


def _column_names(rows: list[list[str]], head: int) -> tuple[str, ...]:
    """Return a name for each column; it is empty where the header has none."""
    names = [name.strip() for name in rows[head]]
    filled = [name for name in names if name]
    if len(set(filled)) == len(filled):
        return tuple(names)
    # Motive leaves the first cell of these lines blank; its line of settings begins with text.
    above = [row for row in rows[:head] if not row[0].strip() and _filled(row) >= ABOVE]
    return tuple(_full_name(name, i, above) for i, name in enumerate(names))


def _full_name(name: str, column: int, above: list[list[str]]) -> str:
    """Return a name with what stands above it, as kind/name/rotation/X."""
    parents = [row[column].strip() for row in above if column < len(row)]
    return "/".join([*filter(None, parents), name])


def _filled(row: list[str]) -> int:
    return sum(bool(cell.strip()) for cell in row)


def _holds_data(row: list[str]) -> bool:
    filled = [cell for cell in row if cell.strip()]
    return len(filled) > 1 and sum(map(_is_number, filled)) > SHARE * len(filled)


def _is_number(cell: str) -> bool:
    try:
        float(cell.replace(",", "."))
    except ValueError:
        return False
    return True
