"""A table that grows block by block: of each cell no more is kept than its number.

A cell that holds no number is kept as text, for who asks what it is.
"""

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np

from equipoise.io.columns.column_store import NUMBER, Store
from equipoise.io.columns.row_faults import FaultyRows, RowFault
from equipoise.io.columns.table import Lines, Numbers, Table, no_rows, rows_between
from equipoise.io.files.reading_budget import Meter
from equipoise.io.formats.cell_numbers import numbers_of
from equipoise.io.formats.cell_texts import CellTexts
from equipoise.io.formats.header_rows import Header, filled, place_of
from equipoise.model.arrays import Ints
from equipoise.model.errors import InputError

JOINED = "Each number is cut in two by a decimal comma; the parts were joined."
WHOLE = 1e15  # below which a whole number prints without a point


class NotInPairs(Exception):
    """A row speaks against joining cells in pairs, which the first rows seemed to need."""


@dataclass(frozen=True, slots=True, eq=False)
class Column:
    """A column's numbers in a block, and the texts of the cells, where some are none."""

    numbers: Numbers  # rows are counted in the block
    cells: tuple[str, ...] = ()


class TableParts:
    """The blocks of a table so far."""

    def __init__(
        self, header: Header, decimal: str, meter: Meter, in_pairs: bool, store: Store
    ) -> None:
        """Take whether cells may be joined ``in_pairs``: a decimal comma may have cut numbers."""
        width = len(header.names)
        self.header, self.decimal, self.count = header, decimal, 0
        self._meter, self._in_pairs, self._ended = meter, in_pairs and decimal != ",", False
        self._width, self._store = width, store
        self._nan: list[list[Ints]] = [[] for _ in range(width)]
        self._garbage: list[list[Ints]] = [[] for _ in range(width)]
        self._texts = [CellTexts() for _ in range(width)]
        self._lines: list[Lines] = []
        self._uneven: dict[RowFault, list[Ints]] = {}
        self._cells: dict[RowFault, int] = {}  # of the first row with such a fault

    def add_rows(self, rows: list[list[str]], lines: Lines) -> None:
        """Add rows of cells; NotInPairs if cells are joined and a row cannot be."""
        if not rows:
            return
        if not self.count:
            self._in_pairs &= len(rows[0]) == 2 * self._width
        even = self._even(self._joined(rows) if self._in_pairs else rows)
        columns = (Column(numbers_of(cells, self.decimal), cells) for cells in zip(*even))  # noqa: B905
        self.add_columns(columns, lines)

    def add_columns(self, columns: Iterable[Column], lines: Lines) -> None:
        """Add rows of as many columns as the header has."""
        if self._store.in_memory:
            self._meter.take(NUMBER * self._width * len(lines))
        for place, column in enumerate(columns):
            self._add(place, column)
        self._lines.append(lines)
        self.count += len(lines)

    def table(self, source: str) -> Table:
        """Return the table; InputError if it has no rows."""
        if not self.count:
            raise InputError(source, "a header but no rows", "rows of numbers")
        lines = _together(self._lines)
        short = self._without_cut_end(lines)
        lines, header = lines[: self.count], self.header
        return Table(
            source,
            header.names,
            self.count,
            lambda _, name: self._numbers(name, source, 0, self.count),
            lines,
            (*header.notes, *[JOINED] * self._in_pairs, *short),
            self._faulty(lines, source),
            lambda name, row: self._cell(header.names.index(name), row),
            header.units,
            rows=lambda name, start, stop: self._numbers(name, source, start, stop),
        )

    def _add(self, place: int, column: Column) -> None:
        numbers = column.numbers
        self._store.add(place, self.count, numbers.values)
        if not len(numbers.nan) and not len(numbers.garbage):
            return
        self._nan[place].append(numbers.nan + self.count)
        self._garbage[place].append(numbers.garbage + self.count)
        rows = np.union1d(numbers.nan, numbers.garbage)
        texts = [column.cells[int(row)] for row in rows.tolist()]
        self._meter.take(self._texts[place].add(rows + self.count, texts))

    def _joined(self, rows: list[list[str]]) -> list[list[str]]:
        """Return rows whose numbers were cut in two as they were before; the last may be cut."""
        width = self._width
        if self._ended:
            raise NotInPairs
        self._ended = len(rows[-1]) != 2 * width
        whole = rows[:-1] if self._ended else rows
        if not all(len(row) == 2 * width for row in whole):
            raise NotInPairs
        if not all(part.strip().isdigit() for row in whole for part in row[1::2]):
            raise NotInPairs
        joined = [
            [f"{a.strip()}.{b.strip()}" for a, b in zip(row[::2], row[1::2], strict=True)]
            for row in whole
        ]
        return [*joined, *[rows[-1][: width - 1]] * self._ended]

    def _even(self, rows: list[list[str]]) -> list[list[str]]:
        """Return rows of equal width; those with cells too few or too many are blank."""
        width = self._width
        if set(map(len, rows)) == {width}:
            return rows
        few = np.array([len(row) < width for row in rows])
        # Blank cells beyond the header are a separator too many.
        many = np.array([filled(row[width:]) > 0 for row in rows])
        for kind, mask in ((RowFault.CUT_SHORT, few), (RowFault.TOO_WIDE, many)):
            if mask.any():
                which = np.flatnonzero(mask)
                self._cells.setdefault(kind, len(rows[int(which[0])]))
                self._uneven.setdefault(kind, []).append(which + self.count)
        blank = [""] * width
        bad = (few | many).tolist()
        return [blank if b else row[:width] for row, b in zip(rows, bad, strict=True)]

    def _without_cut_end(self, lines: Lines) -> tuple[str, ...]:
        """Leave out a last row that was cut short, as where a logger lost power."""
        short = self._uneven.get(RowFault.CUT_SHORT, [no_rows()])
        if self.count < 2 or not len(short[-1]) or short[-1][-1] != self.count - 1:
            return ()
        short[-1] = short[-1][:-1]
        self.count -= 1
        return (f"The last row (line {lines[-1]}) is cut short; it was left out.",)

    def _faulty(self, lines: Lines, source: str) -> tuple[FaultyRows, ...]:
        kinds = [kind for kind in (RowFault.CUT_SHORT, RowFault.TOO_WIDE) if kind in self._uneven]
        rows = {kind: np.concatenate(self._uneven[kind]) for kind in kinds}
        return tuple(
            self._fault(kind, rows[kind], f"{source}, line {lines[int(rows[kind][0])]}")
            for kind in kinds
            if len(rows[kind])
        )

    def _fault(self, kind: RowFault, rows: Ints, where: str) -> FaultyRows:
        wanted = f"{self._width}, as the header"
        if kind == RowFault.TOO_WIDE and len(rows) == self.count:
            wanted += "; are the decimal points commas? Then separate the cells by ';'"
        return FaultyRows(kind, rows, where, f"{self._cells[kind]} cells", wanted)

    def _numbers(self, name: str, source: str, start: int, stop: int) -> Numbers:
        """Return some rows of a column; InputError if two columns have its name."""
        place = place_of(self.header, name, source)
        return Numbers(
            self._store.read(place, start, stop),
            rows_between(np.concatenate([no_rows(), *self._nan[place]]), start, stop),
            rows_between(np.concatenate([no_rows(), *self._garbage[place]]), start, stop),
        )

    def _cell(self, place: int, row: int) -> str:
        text = self._texts[place].of(row)
        if text is not None:
            return text
        number = float(self._store.read(place, row, row + 1)[0])
        if np.isnan(number):
            return ""
        return str(int(number)) if number == int(number) and abs(number) < WHOLE else repr(number)


def _together(parts: list[Lines]) -> Lines:
    """Return the lines of all blocks, as a range where none between them is left out."""
    first, last = int(parts[0][0]), int(parts[-1][-1])
    if last - first + 1 == sum(map(len, parts)):
        return range(first, last + 1)
    return np.concatenate([np.array(part, dtype=np.int64) for part in parts])
