"""A text cut into rows of cells, block by block.

The first lines show its separator, its decimal point, what a terminal put in front of each.
"""

import csv
import re
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from itertools import chain, islice
from operator import itemgetter

import numpy as np

from equipoise.io.columns.column_map import Layout
from equipoise.io.columns.table import Lines
from equipoise.io.formats.labelled_lines import NOTE, labels_of, row_of
from equipoise.model.errors import InputError

SEPARATORS = (";", "\t")  # sought before the comma, which may be a decimal comma
HEAD_LINES = 50  # lines; chosen: more than any header has
CELLS = 10_000  # of a row (chosen: ten times the columns of any export)
# What a serial terminal puts before each line: the clock of the day, and an arrow or a bracket.
PREFIX = re.compile(r"\[?\d{1,2}:\d{2}:\d{2}([.,]\d+)?(\] ?| ?-> ?|\s+)")
# As NumPy and MATLAB begin a header; a column %time is one of ROS.
COMMENT = re.compile(r"\s*(#+\s*|%+\s+)")
PREFIXED = "Each line starts with the terminal's clock, which was ignored."
FIRST_CELL = itemgetter(0)
WANTED = "a row of separated cells"
csv.field_size_limit(1 << 20)  # characters; a cell beyond this is not a table's


@dataclass(frozen=True, slots=True)
class Writing:
    """How a text is written."""

    separator: str = ","
    decimal: str = "."
    prefixed: bool = False  # a terminal's clock stands before each line
    labels: tuple[str, ...] = ()  # the names before the numbers of each line

    @property
    def notes(self) -> tuple[str, ...]:
        """Return what was ignored."""
        return (*[PREFIXED] * self.prefixed, *[NOTE] * bool(self.labels))

    def cleaned(self, lines: list[str]) -> list[str]:
        """Return lines without what stands in front of their cells."""
        if self.prefixed:
            lines = [PREFIX.sub("", line, count=1) for line in lines]
        return [_without_comment(line) for line in lines]


@dataclass(frozen=True, slots=True, eq=False)
class TextRows:
    """Rows that are not blank, and the lines that they end on."""

    rows: list[list[str]]
    lines: Lines


def writing_of(lines: list[str], layout: Layout) -> Writing:
    """Return how a text is written, by its first lines and what is stated."""
    prefixed = _is_prefixed(lines)
    cleaned = Writing(prefixed=prefixed).cleaned(lines)
    labels = labels_of(cleaned, HEAD_LINES) if layout.separator is None else ()
    if labels:
        return Writing(" ", layout.decimal or ".", prefixed, labels)
    separator = layout.separator or separator_of(cleaned)
    decimal = layout.decimal or ("," if separator != "," else ".")
    return Writing(separator, decimal, prefixed)


def separator_of(lines: list[str]) -> str:
    """Return the separator that stands in most of the first lines; a space if nothing does."""
    some = [line for line in lines[:HEAD_LINES] if line.strip()]
    often: Callable[[str], bool] = lambda s: sum(s in line for line in some) * 2 > len(some)  # noqa: E731
    found = next(filter(often, (*SEPARATORS, ",")), None)
    if found is None and sum(len(line.split()) > 1 for line in some) * 2 > len(some):
        return " "
    return found or ","


def _is_prefixed(lines: list[str]) -> bool:
    """Say whether most lines have the clock that a terminal puts in front."""
    some = [line for line in lines[:HEAD_LINES] if line.strip()]
    return sum(PREFIX.match(line) is not None for line in some) * 2 > len(some)


def _without_comment(line: str) -> str:
    """Return a line without the mark of a comment at its beginning."""
    mark = COMMENT.match(line)
    return line[mark.end() :] if mark else line


class RowCutter:
    """Cuts the lines of a text, block after block; a row in quotes may go on into the next."""

    def __init__(self, blocks: Iterator[str], writing: Writing, source: str) -> None:
        self.line = 0  # lines so far
        self._blocks, self._writing, self._source = blocks, writing, source
        self._fed: list[str] = []  # lines that the reader takes next
        self._passed = 0  # lines that it never saw
        lines = chain.from_iterable(self._lines())
        self._reader = csv.reader(lines, delimiter=writing.separator)

    def passed(self, lines: int) -> None:
        """Count lines that were cut in another way."""
        self._passed += lines
        self.line += lines

    def rows(self, block: str) -> TextRows:
        """Return the rows that begin in a block; InputError for a line that cannot be cut."""
        lines = self._cleaned(block)
        if self._writing.labels or self._writing.separator == " ":
            found = self._by_spaces(lines)
        else:
            found = self._by_separator(lines, '"' in block)
        self._check_widths(found)
        return found

    def _cleaned(self, block: str) -> list[str]:
        lines = block.splitlines()
        marked = self._writing.prefixed or "#" in block or "%" in block
        return self._writing.cleaned(lines) if marked else lines

    def _lines(self) -> Iterator[list[str]]:
        """Yield the lines that the reader is given; a row that goes on takes the next block."""
        while True:
            lines, self._fed = self._fed, []
            while not lines:
                block = next(self._blocks, None)
                if block is None:
                    return
                lines = self._cleaned(block)
            self.line += len(lines)
            yield lines

    def _by_separator(self, lines: list[str], quoted: bool) -> TextRows:
        self._fed = lines
        try:
            return self._in_quotes() if quoted else self._plain(len(lines))
        except csv.Error as error:
            where = f"{self._source}, line {self._passed + self._reader.line_num}"
            raise InputError(where, str(error), WANTED) from error

    def _plain(self, count: int) -> TextRows:
        """Return the rows of lines without quotes."""
        first = self.line + 1
        rows = list(islice(self._reader, count))
        return _without_blank(rows, range(first, first + len(rows)))

    def _in_quotes(self) -> TextRows:
        """Return rows some of which may go on over several lines."""
        rows: list[list[str]] = []
        lines: list[int] = []
        for row in self._reader:
            rows.append(row)
            lines.append(self._passed + self._reader.line_num)
            if lines[-1] == self.line:
                break
        return _without_blank(rows, np.array(lines, dtype=np.int64))

    def _by_spaces(self, lines: list[str]) -> TextRows:
        """Return rows whose cells are parted by any number of spaces, or have names before them."""
        names = self._writing.labels
        filled = [(k, line) for k, line in enumerate(lines, self.line + 1) if line.strip()]
        self.line += len(lines)
        rows = [row_of(line, names) if names else line.split() for _, line in filled]
        return TextRows(rows, np.array([k for k, _ in filled], dtype=np.int64))

    def _check_widths(self, found: TextRows) -> None:
        widest = max(map(len, found.rows), default=0)
        if widest > CELLS:
            row = next(k for k, row in enumerate(found.rows) if len(row) == widest)
            where = f"{self._source}, line {found.lines[row]}"
            raise InputError(where, f"{widest} cells", f"{CELLS} at most in a row")


def _without_blank(rows: list[list[str]], lines: Lines) -> TextRows:
    """Return rows without those that hold nothing."""
    if all(rows) and all(map(FIRST_CELL, rows)):
        return TextRows(rows, lines)
    kept = [bool(row) and (bool(row[0]) or any(map(str.strip, row))) for row in rows]
    places = np.array(lines, dtype=np.int64)[np.array(kept, dtype=bool)]
    return TextRows([row for row, k in zip(rows, kept, strict=True) if k], places)
