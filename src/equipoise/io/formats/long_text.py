"""Blocks of a long text cut into columns by pyarrow, where none of our rules has a say.

A block is plain if its lines are as wide as the header and none is blank, and if it has neither
quotes nor marks of comments. Any other is left to ``text_rows``, whose errors name lines; a column
with anything but numbers to ``cell_numbers``. The table is the same, to the last bit.
"""

import string
from importlib import import_module
from importlib.util import find_spec
from typing import Any

import numpy as np

from equipoise.io.columns.table import Numbers
from equipoise.io.formats.cell_numbers import numbers_of
from equipoise.io.formats.table_parts import Column
from equipoise.io.formats.text_rows import Writing
from equipoise.model.arrays import Bools, Series1

LONG = 8_000_000  # bytes, chosen: pyarrow saves as long of so many as its import takes
# Neither quotes nor marks of comments, nor what ends a line for Python alone.
PLAIN = (string.ascii_letters + string.digits + "!$&'()*+,-./:;<=>?@[]^_`{|}~ \t\n").encode()


def is_for_arrow(size: int, width: int, writing: Writing) -> bool:
    """Say whether pyarrow cuts the plain blocks of a text of so many bytes and columns."""
    known = writing.separator != " " and not writing.notes and width > 1
    return size > LONG and known and find_spec("pyarrow") is not None


class PlainBlocks:
    """Cuts blocks of a text with so many columns."""

    def __init__(self, width: int, writing: Writing) -> None:
        self._names = [str(k) for k in range(width)]
        self._separator, self._decimal = writing.separator, writing.decimal
        self._kinds: dict[str, str] = dict.fromkeys(self._names, "float64")

    def columns(self, block: str) -> list[Column] | None:
        """Return a block's columns; None if it is not plain."""
        body = block.replace("\r\n", "\n").rstrip("\n")
        content = body.encode(errors="surrogatepass")
        if content.translate(None, PLAIN):
            return None
        found = self._found(content, self._kinds)
        if found is None:  # a cell of a column of numbers is none, or a row has another width
            found = self._found(content, dict.fromkeys(self._names, "string"))
        return found

    def _found(self, content: bytes, kinds: dict[str, str]) -> list[Column] | None:
        """Return columns of some kinds; None if they are not of these, or a row is blank."""
        cells = self._read(content, kinds)
        spaced = b" " in content or (b"\t" in content and self._separator != "\t")
        if cells is None or (cells.column(0).null_count and (spaced or _blank(cells))):
            return None
        found = [self._column(cells.column(name), name) for name in self._names]
        whole = [column for column in found if column is not None]
        return whole if len(whole) == len(found) else None

    def _read(self, content: bytes, kinds: dict[str, str]) -> Any:
        """Return the cells as columns of some kinds; None if they cannot be."""
        arrow = import_module("pyarrow.csv")
        size = len(content) + 1  # all in one piece
        try:
            return arrow.read_csv(
                import_module("pyarrow").BufferReader(content),
                arrow.ReadOptions(column_names=self._names, block_size=size, use_threads=False),
                arrow.ParseOptions(
                    delimiter=self._separator, quote_char=False, ignore_empty_lines=False
                ),
                arrow.ConvertOptions(
                    column_types=kinds, null_values=[""], strings_can_be_null=True
                ),
                memory_pool=import_module("pyarrow").system_memory_pool(),
            )
        except ValueError:
            return None

    def _column(self, column: Any, name: str) -> Column | None:
        """Return a column; as ours reads it where a cell is neither finite nor blank.

        None where such a cell's text is no longer known.
        """
        values = _doubles(column)
        if values is not None:
            return Column(Numbers(values))
        if str(column.type) != "string":
            return None
        self._kinds[name] = "string"
        texts = tuple(cell or "" for cell in column.to_pylist())
        return Column(numbers_of(texts, self._decimal), texts)


def _blank(cells: Any) -> bool:
    """Say whether some row has no cell with anything in it."""
    there = [_there(column.chunk(0)) for column in cells.columns]
    return not bool(np.logical_or.reduce(there).all())


def _doubles(column: Any) -> Series1 | None:
    """Return a column's numbers; None if a cell is neither finite nor blank."""
    try:
        chunk = column.cast("float64").chunk(0)
    except ValueError:
        return None
    # The way by ``to_numpy`` imports pandas, where that is installed: 0.3 s and 40 MB.
    begin, end = chunk.offset, chunk.offset + len(chunk)
    values = np.frombuffer(chunk.buffers()[1], np.float64)[begin:end].copy()
    values[~_there(chunk)] = np.nan
    missing = int(np.count_nonzero(~np.isfinite(values)))
    return values if missing == chunk.null_count else None


def _there(chunk: Any) -> Bools:
    """Say of each cell whether it is not blank."""
    bits = chunk.buffers()[0]
    if bits is None:
        return np.ones(len(chunk), dtype=bool)
    unpacked = np.unpackbits(np.frombuffer(bits, np.uint8), bitorder="little")
    return unpacked[chunk.offset : chunk.offset + len(chunk)].astype(bool)
