"""A text cut into rows of cells: its separator, its decimal point, what a terminal put in front."""

import csv
import re
from collections.abc import Callable
from dataclasses import dataclass

from equipoise.io.columns.column_map import Layout
from equipoise.io.formats.labelled_lines import NOTE, labelled
from equipoise.model.errors import InputError

SEPARATORS = (";", "\t")  # sought before the comma, which may be a decimal comma
HEAD_LINES = 50  # lines; chosen: more than any header has
# What a serial terminal puts before each line: the clock of the day, and an arrow or a bracket.
PREFIX = re.compile(r"\[?\d{1,2}:\d{2}:\d{2}([.,]\d+)?(\] ?| ?-> ?|\s+)")
# As NumPy and MATLAB begin a header; a column %time is one of ROS.
COMMENT = re.compile(r"\s*(#+\s*|%+\s+)")
csv.field_size_limit(1 << 20)  # characters; a cell beyond this is not a table's


@dataclass(frozen=True, slots=True)
class TextRows:
    """Rows that are not blank, the lines that they end on, and how they are written."""

    rows: list[list[str]]
    lines: list[int]
    decimal: str = "."
    notes: tuple[str, ...] = ()
    separator: str = ","


def text_rows(text: str, source: str, layout: Layout) -> TextRows:
    """Return the rows of a text; InputError for a line that cannot be cut."""
    all_lines, notes = _without_prefix(text.splitlines())
    all_lines = [_without_comment(line) for line in all_lines]
    said = labelled(all_lines, HEAD_LINES) if layout.separator is None else None
    if said is not None:
        decimal = layout.decimal or "."
        return TextRows(said.rows, said.lines, decimal, (*notes, NOTE), " ")
    separator = layout.separator or separator_of(all_lines)
    cut = _by_spaces if separator == " " else _by_separator
    rows, lines = cut(all_lines, source, separator)
    decimal = layout.decimal or ("," if separator != "," else ".")
    return TextRows(rows, lines, decimal, notes, separator)


def separator_of(lines: list[str]) -> str:
    """Return the separator that stands in most of the first lines; a space if nothing does."""
    some = [line for line in lines[:HEAD_LINES] if line.strip()]
    often: Callable[[str], bool] = lambda s: sum(s in line for line in some) * 2 > len(some)  # noqa: E731
    found = next(filter(often, (*SEPARATORS, ",")), None)
    if found is None and sum(len(line.split()) > 1 for line in some) * 2 > len(some):
        return " "
    return found or ","


def _without_prefix(lines: list[str]) -> tuple[list[str], tuple[str, ...]]:
    """Return lines without the clock that a terminal put in front, if most have one."""
    some = [line for line in lines[:HEAD_LINES] if line.strip()]
    if sum(PREFIX.match(line) is not None for line in some) * 2 <= len(some):
        return lines, ()
    note = "A terminal's clock stands before each line; it was left aside."
    return [PREFIX.sub("", line, count=1) for line in lines], (note,)


def _without_comment(line: str) -> str:
    """Return a line without the mark of a comment at its beginning."""
    mark = COMMENT.match(line)
    return line[mark.end() :] if mark else line


def _by_spaces(lines: list[str], _source: str, _: str) -> tuple[list[list[str]], list[int]]:
    """Return rows whose cells are parted by any number of spaces."""
    numbered = [(k, line.split()) for k, line in enumerate(lines, 1) if line.strip()]
    return [row for _, row in numbered], [k for k, _ in numbered]


def _by_separator(
    text: list[str], source: str, separator: str
) -> tuple[list[list[str]], list[int]]:
    """Return the rows that are not blank, and their lines."""
    rows: list[list[str]] = []
    lines: list[int] = []
    reader = csv.reader(text, delimiter=separator)
    try:
        for row in reader:
            if row and (row[0] or any(map(str.strip, row))):
                rows.append(row)
                lines.append(reader.line_num)
    except csv.Error as error:
        where = f"{source}, line {reader.line_num}"
        raise InputError(where, str(error), "a row of separated cells") from error
    return rows, lines
