"""The header of a table among its first rows: names, a row of units, or none at all."""

from dataclasses import dataclass

import numpy as np

from equipoise.io.columns.column_map import Layout
from equipoise.io.columns.table import Lines
from equipoise.io.formats.cell_numbers import number_in
from equipoise.io.formats.text_rows import HEAD_LINES
from equipoise.io.toml.units import TO_SI
from equipoise.model.errors import InputError

SHARE = 0.5  # of a row's filled cells that must be numbers for it to hold data (chosen)
ABOVE = 3  # filled cells that a line above the header needs to belong to it (chosen)
# Units as others write them, and what says that there is none.
UNITS = frozenset({*TO_SI, "", "-", "1", "none", "°", "°/s", "deg/sec", "rad/sec", "sec", "µs"})


@dataclass(frozen=True, slots=True)
class Header:
    """What the columns are called."""

    names: tuple[str, ...]  # empty where the header has none
    end: int  # the row in which the data begin
    units: tuple[str, ...] = ()  # as a row below the names has them
    notes: tuple[str, ...] = ()


def header_of(rows: list[list[str]], lines: Lines, source: str, layout: Layout) -> Header:
    """Return the header; without one columns are called 1, 2 and so on."""
    skipped = layout.skip_rows
    before = None if skipped is None else int(np.sum(np.asarray(lines) <= skipped))
    last = _row_before_data(rows) if before is None else before
    if last >= len(rows):
        raise InputError(source, f"only {len(rows)} rows", "a header and rows of numbers")
    if last < 0 or not layout.header:
        return _no_header(rows, last + 1 if before is None else before)
    at = last - 1 if before is None else last  # where the names are, if units follow
    if at >= 0 and at + 1 < len(rows) and _units_follow(rows[at], rows[at + 1], layout):
        units = tuple(_bare(cell) for cell in rows[at + 1])
        note = f"Line {lines[at + 1]} holds units; it was ignored."
        return Header(_column_names(rows, at, at + 2), at + 2, units, (note,))
    return Header(_column_names(rows, last, last + 1), last + 1)


def place_of(header: Header, name: str, source: str) -> int:
    """Return the column of a name; InputError if two have it."""
    if header.names.count(name) > 1:
        raise InputError(f"{source}, header", f"two columns '{name}'", "one")
    return header.names.index(name)


def _no_header(rows: list[list[str]], begin: int) -> Header:
    count = max(map(len, rows[begin : begin + HEAD_LINES]), default=0)
    note = f"There is no header; the columns are called 1 to {count}."
    return Header(tuple(str(k + 1) for k in range(count)), begin, (), (note,))


def _units_follow(names: list[str], below: list[str], layout: Layout) -> bool:
    if layout.units_row is not None:
        return layout.units_row
    return _holds_units(below, names)


def filled(row: list[str]) -> int:
    """Return how many cells of a row hold something."""
    return sum(bool(cell.strip()) for cell in row)


def _row_before_data(rows: list[list[str]]) -> int:
    """Return the row before the first that holds data, as the next does; the first if none does.

    Motive's line of identities is all numbers as well, but more header follows it. -1 is returned
    where the first row is data already.
    """
    data = [_holds_data(row) for row in rows[:HEAD_LINES]]
    pairs = zip(data, [*data[1:], True], strict=True)
    return next((i for i, (this, after) in enumerate(pairs) if this and after), 1) - 1


def _holds_units(row: list[str], above: list[str]) -> bool:
    """Say whether a row below names holds their units."""
    units = [_bare(cell) for cell in row]
    names = [name.strip() for name in above if name.strip()]
    if not any(units) or len(row) > len(above) or len(set(names)) < len(names):
        return False
    return all(unit in UNITS for unit in units) and not all(_bare(n) in UNITS for n in names)


def _bare(cell: str) -> str:
    """Return a unit without its brackets."""
    bare = cell.strip()
    bare = bare[1:].lstrip() if bare.startswith(("[", "(")) else bare
    return bare[:-1].rstrip() if bare.endswith(("]", ")")) else bare


def _column_names(rows: list[list[str]], head: int, end: int) -> tuple[str, ...]:
    """Return a name for each column; it is empty where the header has none."""
    names = [name.strip() for name in rows[head]]
    below = rows[end : end + HEAD_LINES]
    while names and not names[-1] and not any(map(str.strip, _column(below, len(names) - 1))):
        names.pop()  # a separator too many at the end of the header
    named = [name for name in names if name]
    if len(set(named)) == len(named):
        return tuple(names)
    # Motive leaves the first cell of these lines blank; its line of settings begins with text.
    above = [row for row in rows[:head] if not row[0].strip() and filled(row) >= ABOVE]
    return tuple(_full_name(name, i, above) for i, name in enumerate(names))


def _column(rows: list[list[str]], column: int) -> list[str]:
    """Return the cells of a column; rows that end before it have none."""
    return [row[column] for row in rows if column < len(row)]


def _full_name(name: str, column: int, above: list[list[str]]) -> str:
    """Return a name with what stands above it, as kind/name/rotation/X."""
    parents = map(str.strip, _column(above, column))
    return "/".join([*filter(None, parents), name])


def _holds_data(row: list[str]) -> bool:
    cells = [cell for cell in row if cell.strip()]
    return len(cells) > 1 and sum(map(is_number, cells)) > SHARE * len(cells)


def is_number(cell: str) -> bool:
    """Say whether a cell is a number, with a point or a comma."""
    return number_in(cell, ",") is not None
