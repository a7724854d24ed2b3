"""A separated text table: find the header, make rows even, turn cells into numbers.

A text is read block by block: the first shows how it is written and what its columns are called.
What we write reads back to the last bit.

Motive writes several header lines (kind, name, identity, rotation or position) above the one with
X, Y, Z, W; a name that occurs twice there is distinguished by what stands above it.
"""

import contextlib
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, replace

import numpy as np

from equipoise.io.columns.column_map import Layout
from equipoise.io.columns.column_store import InMemory, Store
from equipoise.io.columns.table import Table
from equipoise.io.files.reading_budget import Meter, ReadingBudget
from equipoise.io.formats.header_rows import Header, header_of
from equipoise.io.formats.long_text import PlainBlocks, is_for_arrow
from equipoise.io.formats.table_parts import NotInPairs, TableParts
from equipoise.io.formats.text_blocks import Text
from equipoise.io.formats.text_rows import HEAD_LINES, RowCutter, TextRows, writing_of
from equipoise.model.arrays import Series1
from equipoise.model.errors import InputError

FIRST_LINES = 3 * HEAD_LINES  # that hold the header and what it is judged by (chosen)
HELD = 30  # bytes that one of a text takes as rows of cells (chosen: of cells of one digit)


def cut(text: str, source: str, layout: Layout) -> Table:
    """Return the table in a text."""
    return table_in(Text.of(text), source, layout, ReadingBudget().of(source, len(text)))


def table_in(
    text: Text, source: str, layout: Layout, meter: Meter, store: Callable[[], Store] = InMemory
) -> Table:
    """Return the table in a text; InputError if it is none, or takes too much.

    ``store`` makes what its numbers are kept in.
    """
    for in_pairs in (True, False):  # what the first rows seem to need a later one may refute
        with contextlib.suppress(NotInPairs):
            return _table_in(text, source, layout, meter, _Keeping(in_pairs, store()))
    raise AssertionError(source)


def table_of(rows: list[list[str]], lines: list[int], source: str, layout: Layout) -> Table:
    """Return the table in rows of cells and their lines, the header among them."""
    found, meter = TextRows(rows, np.array(lines, dtype=np.int64)), ReadingBudget().of(source, 0)
    header = _header(found, source, layout)
    for in_pairs in (True, False):
        parts = TableParts(header, layout.decimal or ".", meter, in_pairs, InMemory())
        with contextlib.suppress(NotInPairs):
            parts.add_rows(rows[header.end :], found.lines[header.end :])
            return parts.table(source)
    raise AssertionError(source)


def csv_text(columns: Mapping[str, Series1]) -> str:
    """Return a header and rows; NaN becomes a blank cell."""
    # Python prints the fewest digits (up to 17) that give the same double again.
    cells = [["" if x != x else repr(x) for x in map(float, v)] for v in columns.values()]
    rows = map(",".join, zip(*cells, strict=True))
    return "\n".join([",".join(columns), *rows]) + "\n"


@dataclass(frozen=True, slots=True)
class _Keeping:
    """How the cells of a text are kept."""

    in_pairs: bool
    store: Store


def _table_in(text: Text, source: str, layout: Layout, meter: Meter, keeping: _Keeping) -> Table:
    """Return the table; NotInPairs if cells were to be joined and a row cannot be."""
    blocks = text.blocks()
    first = _first(blocks, layout, meter)
    writing = writing_of(first.splitlines(), layout)
    cutter = RowCutter(blocks, writing, source)
    found = _with_names(cutter.rows(first), writing.labels)
    header = _header(found, source, layout)
    noted = replace(header, notes=(*writing.notes, *header.notes))
    parts = TableParts(noted, writing.decimal, meter, keeping.in_pairs, keeping.store)
    width = len(header.names)
    plain = PlainBlocks(width, writing) if is_for_arrow(text.size, width, writing) else None
    parts.add_rows(found.rows[header.end :], found.lines[header.end :])
    for block in blocks:
        meter.check(0)
        _add(block, parts, cutter, plain)
    return parts.table(source)


def _header(found: TextRows, source: str, layout: Layout) -> Header:
    if not found.rows:
        raise InputError(source, "nothing but blank lines", "a header and rows of numbers")
    return header_of(found.rows, found.lines, source, layout)


def _first(blocks: Iterator[str], layout: Layout, meter: Meter) -> str:
    """Return as much of a text as shows how it is written and what its columns are called."""
    read: list[str] = []
    skip, filled = layout.skip_rows or 0, 0
    for block in blocks:
        read.append(block)
        lines = block.splitlines()
        filled += sum(bool(line.strip()) for line in lines[skip:])
        skip = max(skip - len(lines), 0)
        if filled >= FIRST_LINES:
            break
        meter.check(HELD * sum(map(len, read)))
    return "".join(read)


def _with_names(found: TextRows, names: tuple[str, ...]) -> TextRows:
    """Return rows of labelled lines below a row of their names."""
    if not names:
        return found
    head = next(k for k, row in enumerate(found.rows) if len(row) == len(names))
    lines = np.insert(np.array(found.lines, dtype=np.int64), head, found.lines[head])
    return TextRows([*found.rows[:head], [*names], *found.rows[head:]], lines)


def _add(block: str, parts: TableParts, cutter: RowCutter, plain: PlainBlocks | None) -> None:
    """Add the rows that begin in a block."""
    columns = None if plain is None else plain.columns(block)
    if columns is None:
        found = cutter.rows(block)
        parts.add_rows(found.rows, found.lines)
        return
    first = cutter.line + 1
    parts.add_columns(columns, range(first, first + len(columns[0].numbers.values)))
    cutter.passed(block.count("\n"))
