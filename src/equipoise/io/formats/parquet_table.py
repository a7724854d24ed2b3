"""A Parquet table: the same columns as in a text, with nulls for blank cells.

pyarrow is an extra and heavy, so it is imported when a Parquet file is met and not before.
"""

import io
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from importlib import import_module
from typing import Any

import numpy as np

from equipoise.model.arrays import Series1
from equipoise.model.errors import InputError

MAGIC = b"PAR1"  # a Parquet file begins and ends with it


@dataclass(frozen=True, slots=True, eq=False)
class ParquetTable:
    """A table of typed columns."""

    source: str
    names: tuple[str, ...]
    arrow: Any
    notes: tuple[str, ...] = ()

    def __len__(self) -> int:
        """Return the number of rows."""
        return self.arrow.num_rows

    def place(self, row: int) -> str:
        """Return a row's number, counted from 1."""
        return f"row {row + 1}"

    def numbers(self, name: str) -> Series1:
        """Return a column, NaN where it is null."""
        column = self.arrow.column(self.names.index(name))
        where = f"{self.source}, column '{name}'"
        try:
            values = np.array(column.cast("float64").to_numpy(), dtype=np.float64)
        except (ValueError, NotImplementedError) as error:
            raise InputError(where, f"values of type {column.type}", "numbers") from error
        blank = np.array(column.is_null().to_numpy(), dtype=bool)
        for row in np.flatnonzero(~np.isfinite(values) & ~blank):
            place = f"{self.source}, {self.place(int(row))}, column '{name}'"
            raise InputError(place, f"'{values[row]}'", "a finite number, or null for no reading")
        return values


def read_parquet(content: bytes, source: str) -> ParquetTable:
    """Return the table in a Parquet file's bytes."""
    parquet = _pyarrow("pyarrow.parquet", source)
    try:
        arrow = parquet.read_table(io.BytesIO(content))
        names = tuple(arrow.column_names)
    except (OSError, ValueError) as error:
        raise InputError(source, "broken Parquet", "a whole Parquet file") from error
    return ParquetTable(source, names, arrow)


def parquet_bytes(columns: Mapping[str, Series1], source: str) -> bytes:
    """Return columns as a Parquet file's bytes; NaN becomes null."""
    pyarrow = _pyarrow("pyarrow", source)
    arrays = {name: pyarrow.array(v, mask=np.isnan(v)) for name, v in columns.items()}
    return _written(arrays, source)


def parquet_of_cells(columns: Mapping[str, Sequence[Any]], source: str) -> bytes:
    """Return columns of texts or numbers as a Parquet file's bytes; None becomes null."""
    pyarrow = _pyarrow("pyarrow", source)
    return _written({name: pyarrow.array(cells) for name, cells in columns.items()}, source)


def _written(arrays: Mapping[str, Any], source: str) -> bytes:
    pyarrow, parquet = _pyarrow("pyarrow", source), _pyarrow("pyarrow.parquet", source)
    stream = io.BytesIO()
    parquet.write_table(pyarrow.table(arrays), stream)
    return stream.getvalue()


def _pyarrow(name: str, source: str) -> Any:
    try:
        return import_module(name)
    except ImportError as error:
        wanted = "pyarrow: `pip install equipoise[parquet]`, or use a CSV file"
        raise InputError(source, "a Parquet file, but pyarrow is not installed", wanted) from error
