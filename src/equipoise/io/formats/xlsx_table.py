"""An Excel workbook: the first of its sheets that holds rows of numbers, cell by cell as text.

Format (public: ECMA-376, Office Open XML): a zip archive of XML, read by openpyxl. It is an extra,
imported when a workbook is met and not before.
"""

import itertools
import warnings
import zipfile
from collections.abc import Iterator
from dataclasses import replace
from typing import Any

from equipoise.io.columns.column_map import Layout
from equipoise.io.columns.table import Table
from equipoise.io.files.broken_bytes import as_broken, each_unbroken
from equipoise.io.files.file_content import Content
from equipoise.io.files.reading_budget import CELL, Meter
from equipoise.io.formats.compressed import ZIP
from equipoise.io.formats.csv_table import table_of
from equipoise.io.formats.header_rows import is_number
from equipoise.model.errors import InputError
from equipoise.model.optional_libraries import extra_library

WORKBOOK = "xl/workbook.xml"  # the file of an archive that makes it a workbook
WANTED = "an Excel workbook with a sheet of a header and rows of numbers"
INSTEAD = ", or save the sheet as CSV"
BROKEN = "workbook", f"{WANTED}; save it again in Excel{INSTEAD}"
ROWS = 1 << 20  # of a sheet, at most (Excel's limit)
CELLS = 1 << 24  # of a sheet, at most (chosen: 16 columns of all rows)
TEXTS, TEXT = "sharedStrings.xml", 8  # bytes in memory for one there (chosen)
FEWEST = 2  # rows of two numbers that make a sheet a table (chosen)
Rows = list[list[str]]


def is_workbook(content: Content) -> bool:
    """Say whether a file's bytes are those of a workbook, whole or cut."""
    if not content.startswith(ZIP):
        return False
    try:
        with zipfile.ZipFile(content.from_start()) as archive:
            return WORKBOOK in archive.namelist()
    except Exception:  # a broken archive has no list, but the names stand before its members
        return content.find(WORKBOOK.encode()) >= 0


def read_xlsx(content: Content, source: str, layout: Layout) -> Table:
    """Return the table in a workbook's bytes; InputError if it is broken or holds none."""
    library = extra_library("openpyxl", source, "an Excel workbook", "excel", INSTEAD)
    with warnings.catch_warnings():  # of what openpyxl leaves aside: styles, pictures
        warnings.simplefilter("ignore")
        with as_broken(source, *BROKEN):
            _check_size(content)
            book = library.load_workbook(content.from_start(), read_only=True, data_only=True)
        name, rows, lines = _sheet(book, source, content.meter)
    table = table_of(rows, lines, source, layout)
    others = ", ".join(f"'{sheet.title}'" for sheet in book.worksheets if sheet.title != name)
    note = f"Taken from sheet '{name}'; sheets ignored: {others}."
    return replace(table, notes=(*table.notes, note)) if others else table


def _check_size(content: Content) -> None:
    """Raise InputError if a workbook is too large once it is unpacked; its texts are kept."""
    with zipfile.ZipFile(content.from_start()) as archive:
        for member in archive.infolist():
            kept = TEXT if member.filename.endswith(TEXTS) else 1
            content.meter.check(kept * member.file_size)


def _sheet(book: Any, source: str, meter: Meter) -> tuple[str, Rows, list[int]]:
    """Return name, rows and their numbers of the first sheet that holds rows of numbers."""
    for sheet in book.worksheets:
        numbered = list(_rows(sheet, f"{source}, sheet '{sheet.title}'", meter))
        if sum(map(_holds_numbers, (row for _, row in numbered))) >= FEWEST:
            rows = _without_blank_columns([row for _, row in numbered])
            return sheet.title, rows, [line for line, _ in numbered]
    names = ", ".join(f"'{sheet.title}'" for sheet in book.worksheets)
    raise InputError(source, f"no rows of numbers in sheets {names or '(none)'}", WANTED)


def _rows(sheet: Any, where: str, meter: Meter) -> Iterator[tuple[int, list[str]]]:
    """Yield the rows that are not blank, each with its number in the sheet."""
    sheet.reset_dimensions()  # what a file states of its size may be wrong
    cells, found = 0, each_unbroken(sheet.iter_rows(values_only=True), where, *BROKEN)
    for line, row in enumerate(found, 1):
        cells += len(row)
        if line > ROWS or cells > CELLS:
            wanted = f"at most {ROWS} rows and {CELLS} cells; clear what is empty, or save as CSV"
            raise InputError(where, "too many cells", wanted)
        texts = [_text(value) for value in row]
        if any(map(str.strip, texts)):
            meter.take(CELL * (1 + len(texts)))
            yield line, texts


def _text(value: object) -> str:
    """Return a cell as text; a number has all its digits, a date is that of ISO 8601."""
    if value is None:
        return ""
    if isinstance(value, bool):
        return str(int(value))
    return repr(value) if isinstance(value, int | float) else str(value)


def _holds_numbers(row: list[str]) -> bool:
    return sum(map(is_number, row)) > 1


def _without_blank_columns(rows: Rows) -> Rows:
    """Return rows of one width; a table may begin in any column of a sheet."""
    columns = itertools.zip_longest(*rows, fillvalue="")
    kept = [column for column in columns if any(map(str.strip, column))]
    return [list(row) for row in zip(*kept, strict=True)]
