"""A separated text table: find the header, make rows even, turn cells into numbers.

What we write reads back to the last bit.

Motive writes several header lines (kind, name, identity, rotation or position) above the one with
X, Y, Z, W; a name that occurs twice there is distinguished by what stands above it.
"""

from collections.abc import Callable, Mapping
from dataclasses import replace
from functools import cache

import numpy as np

from equipoise.io.columns.column_map import Layout
from equipoise.io.columns.row_faults import FaultyRows, RowFault
from equipoise.io.columns.table import Numbers, Table
from equipoise.io.formats.cell_numbers import numbers_of
from equipoise.io.formats.header_rows import filled, header_of, place_of
from equipoise.io.formats.long_text import LONG, plain_table
from equipoise.io.formats.text_rows import text_rows
from equipoise.model.arrays import Ints, Series1
from equipoise.model.errors import InputError


def cut(text: str, source: str, layout: Layout) -> Table:
    """Return the table in a text."""
    plain = plain_table(text, source, layout) if len(text) > LONG else None
    return row_by_row(text, source, layout) if plain is None else plain


def row_by_row(text: str, source: str, layout: Layout) -> Table:
    """Return the table in a text of any length and any faults."""
    found = text_rows(text, source, layout)
    table = table_of(found.rows, found.lines, source, layout, found.decimal)
    return replace(table, notes=(*found.notes, *table.notes))


def table_of(
    rows: list[list[str]], lines: list[int], source: str, layout: Layout, decimal: str = "."
) -> Table:
    """Return the table in rows of cells and their lines, the header among them.

    ``decimal`` is the point of a number unless the layout states another.
    """
    if not rows:
        raise InputError(source, "nothing but blank lines", "a header and rows of numbers")
    header = header_of(rows, lines, source, layout)
    body, kept = rows[header.end :], lines[header.end :]
    if not body:
        raise InputError(source, "a header but no rows", "rows of numbers")
    body, notes = _joined_in_pairs(body, len(header.names), decimal)
    body, kept, short = _without_cut_end(body, kept, len(header.names))
    even, faulty = _even(body, kept, len(header.names), source)
    cells = tuple(zip(*even, strict=True))
    point = layout.decimal or decimal

    @cache
    def numbers(name: str) -> Numbers:
        return numbers_of(cells[place_of(header, name, source)], point)

    return Table(
        source,
        header.names,
        len(even),
        lambda _, name: numbers(name),
        tuple(kept),
        (*header.notes, *notes, *short),
        faulty,
        lambda name, row: cells[header.names.index(name)][row],
        header.units,
    )


def csv_text(columns: Mapping[str, Series1]) -> str:
    """Return a header and rows; NaN becomes a blank cell."""
    # Python prints the fewest digits (up to 17) that give the same double again.
    cells = [["" if x != x else repr(x) for x in map(float, v)] for v in columns.values()]
    rows = map(",".join, zip(*cells, strict=True))
    return "\n".join([",".join(columns), *rows]) + "\n"


def _joined_in_pairs(
    rows: list[list[str]], width: int, decimal: str
) -> tuple[list[list[str]], tuple[str, ...]]:
    """Return rows whose numbers were cut in two by a decimal comma as they were before."""
    if decimal == "," or not all(len(row) == 2 * width for row in rows[:-1] or rows):
        return rows, ()
    pairs = [list(zip(row[::2], row[1::2], strict=True)) for row in rows if len(row) == 2 * width]
    if not all(fraction.strip().isdigit() for row in pairs for _, fraction in row):
        return rows, ()
    joined = [[f"{whole.strip()}.{part.strip()}" for whole, part in row] for row in pairs]
    cut_end = rows[len(pairs) :]
    note = "Each number is cut in two by a decimal comma; the parts were joined."
    return [*joined, *([c[: width - 1] for c in cut_end])], (note,)


def _without_cut_end(
    rows: list[list[str]], lines: list[int], width: int
) -> tuple[list[list[str]], list[int], tuple[str, ...]]:
    """Return rows without a last one that was cut short, as where a logger lost power."""
    if len(rows) < 2 or len(rows[-1]) >= width:
        return rows, lines, ()
    note = f"The last row (line {lines[-1]}) is cut short; it was left out."
    return rows[:-1], lines[:-1], (note,)


def _even(
    rows: list[list[str]], lines: list[int], width: int, source: str
) -> tuple[list[list[str]], tuple[FaultyRows, ...]]:
    """Return rows of equal width; those with cells too few or too many are blank, and faulty."""
    if set(map(len, rows)) == {width}:
        return rows, ()
    few = np.array([len(row) < width for row in rows])
    # Blank cells beyond the header are a separator too many.
    many = np.array([filled(row[width:]) > 0 for row in rows])
    kinds = ((RowFault.CUT_SHORT, few), (RowFault.TOO_WIDE, many))
    faulty = tuple(
        _uneven(kind, np.flatnonzero(mask), rows, width, lambda row: f"{source}, line {lines[row]}")
        for kind, mask in kinds
        if mask.any()
    )
    bad = few | many
    blank = [""] * width
    return [blank if b else row[:width] for row, b in zip(rows, bad, strict=True)], faulty


def _uneven(
    kind: RowFault, which: Ints, rows: list[list[str]], width: int, where: Callable[[int], str]
) -> FaultyRows:
    row = int(which[0])
    wanted = f"{width}, as the header"
    if kind == RowFault.TOO_WIDE and len(which) == len(rows):
        wanted += "; are the decimal points commas? Then separate the cells by ';'"
    return FaultyRows(kind, which, where(row), f"{len(rows[row])} cells", wanted)
