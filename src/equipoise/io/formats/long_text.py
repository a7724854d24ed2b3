"""A long text cut into columns by pyarrow, where it is so plain that none of our rules has a say.

    header    found in the first lines, by the rules for every text
    body      lines as wide as the header, none of them blank; no quotes, no marks of comments

A text that is not so plain is left to ``csv_table``, whose errors name lines; a column with
anything but numbers to ``cell_numbers``. The table is the same, to the last bit.
"""

import string
from dataclasses import dataclass
from functools import cache
from importlib import import_module
from typing import Any

import numpy as np

from equipoise.io.columns.column_map import Layout
from equipoise.io.columns.table import Numbers, Table
from equipoise.io.formats.cell_numbers import numbers_of
from equipoise.io.formats.header_rows import Header, header_of, place_of
from equipoise.io.formats.text_rows import HEAD_LINES, text_rows
from equipoise.model.arrays import Series1
from equipoise.model.errors import InputError

LONG = 8_000_000  # characters, chosen: pyarrow saves as long of so many as its import takes
FIRST_LINES = 3 * HEAD_LINES  # that hold the header and what it is judged by (chosen)
BLOCK = 1 << 20  # bytes: no row is longer, as no cell is in ``text_rows``
# Neither quotes nor marks of comments, nor what ends a line for Python alone.
PLAIN = (string.ascii_letters + string.digits + "!$&'()*+,-./:;<=>?@[]^_`{|}~ \t\n").encode()


@dataclass(frozen=True, slots=True)
class Head:
    """What the first lines say of a text."""

    header: Header
    separator: str
    decimal: str
    line: int  # on which the body begins, from 1
    begin: int  # the character at which it does


def plain_table(text: str, source: str, layout: Layout) -> Table | None:
    """Return the table in a plain text; None where it is not plain, or pyarrow is missing."""
    head = _head(text, source, layout)
    cells = None if head is None else _cells(text, head)
    return None if head is None or cells is None else _table(cells, head, source)


def _head(text: str, source: str, layout: Layout) -> Head | None:
    """Return what the first lines say; None where more of them would say something else."""
    lines = _first_lines(text)
    if not lines:
        return None
    try:
        found = text_rows("".join(lines), source, layout)
        header = header_of(found.rows, found.lines, source, layout)
    except InputError:
        return None
    known = header.end + HEAD_LINES <= len(found.rows) and not found.notes
    if not known or found.separator == " " or len(header.names) < 2:
        return None
    line = found.lines[header.end]
    begin = sum(map(len, lines[: line - 1]))
    return Head(header, found.separator, found.decimal, line, begin)


def _first_lines(text: str) -> list[str]:
    """Return the first lines with their ends; none where there are fewer, or no LF ends them."""
    end = 0
    for _ in range(FIRST_LINES):
        end = text.find("\n", end) + 1
        if not end:
            return []
    return text[:end].splitlines(keepends=True)


def _cells(text: str, head: Head) -> Any:
    """Return the body as a table of texts, null for blank; None if it is not plain."""
    body = text[head.begin :].replace("\r\n", "\n").rstrip("\n")
    content = body.encode(errors="surrogatepass")
    if content.translate(None, PLAIN):
        return None
    try:
        cells = _read(content, head)
    except (ImportError, ValueError):  # pyarrow is missing, or a row has another width
        return None
    spaced = b" " in content or (b"\t" in content and head.separator != "\t")
    return None if cells.column(0).null_count and (spaced or _blank(cells)) else cells


def _read(content: bytes, head: Head) -> Any:
    arrow = import_module("pyarrow.csv")
    names = [str(k) for k in range(len(head.header.names))]
    return arrow.read_csv(
        import_module("pyarrow").BufferReader(content),
        arrow.ReadOptions(column_names=names, block_size=BLOCK, use_threads=False),
        arrow.ParseOptions(delimiter=head.separator, quote_char=False, ignore_empty_lines=False),
        arrow.ConvertOptions(
            column_types=dict.fromkeys(names, "string"), null_values=[""], strings_can_be_null=True
        ),
    )


def _blank(cells: Any) -> bool:
    """Say whether some row has no cell with anything in it."""
    blank = [np.asarray(column.is_null()) for column in cells.columns]
    return bool(np.logical_and.reduce(blank).any())


def _table(cells: Any, head: Head, source: str) -> Table:
    header = head.header

    @cache
    def numbers(name: str) -> Numbers:
        return _numbers(cells.column(place_of(header, name, source)), head.decimal)

    return Table(
        source,
        header.names,
        cells.num_rows,
        lambda _, name: numbers(name),
        tuple(range(head.line, head.line + cells.num_rows)),
        header.notes,
        (),
        lambda name, row: cells.column(header.names.index(name))[row].as_py() or "",
        header.units,
    )


def _numbers(column: Any, decimal: str) -> Numbers:
    """Return a column of texts as numbers: as ours where a cell is neither finite nor blank."""
    values = _doubles(column)
    if values is None:
        return numbers_of([cell or "" for cell in column.to_pylist()], decimal)
    return Numbers(values)


def _doubles(column: Any) -> Series1 | None:
    try:
        values = np.array(column.cast("float64").to_numpy(), dtype=np.float64)
    except ValueError:
        return None
    missing = int(np.count_nonzero(~np.isfinite(values)))
    return values if missing == column.null_count else None
