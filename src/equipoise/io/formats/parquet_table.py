"""A Parquet table: the same columns as in a text, with nulls for blank cells.

pyarrow is an extra and heavy, so it is imported when a Parquet file is met and not before.
"""

import io
from collections.abc import Mapping, Sequence
from functools import partial
from importlib import import_module
from typing import Any

import numpy as np

from equipoise.io.columns.table import Numbers, Table, finite
from equipoise.io.files.file_content import Content
from equipoise.model.arrays import Series1
from equipoise.model.errors import InputError

MAGIC = b"PAR1"  # a Parquet file begins and ends with it


def read_parquet(content: Content, source: str) -> Table:
    """Return the table in a Parquet file's bytes."""
    parquet = _pyarrow("pyarrow.parquet", source)
    try:
        arrow = parquet.read_table(content.from_start())
        names = tuple(arrow.column_names)
    except (OSError, ValueError) as error:
        raise InputError(source, "broken Parquet", "a whole Parquet file") from error
    column = partial(_numbers, arrow=arrow)
    cell = partial(_cell, arrow=arrow)
    return Table(source, names, arrow.num_rows, column, cell=cell, blank="null")


def _numbers(table: Table, name: str, arrow: Any) -> Numbers:
    """Return a column; null says that there is no reading."""
    column = arrow.column(table.names.index(name))
    try:
        values = np.array(column.cast("float64").to_numpy(), dtype=np.float64)
    except (ValueError, NotImplementedError) as error:
        where = f"{table.source}, column '{name}'"
        raise InputError(where, f"values of type {column.type}", "numbers") from error
    return finite(values, np.array(column.is_null().to_numpy(), dtype=bool))


def _cell(name: str, row: int, arrow: Any) -> str:
    return str(arrow.column(arrow.column_names.index(name))[row].as_py())


def parquet_bytes(columns: Mapping[str, Series1], source: str) -> bytes:
    """Return columns as a Parquet file's bytes; NaN becomes null."""
    stream = io.BytesIO()
    _pyarrow("pyarrow.parquet", source).write_table(arrow_columns(columns, source), stream)
    return stream.getvalue()


def arrow_columns(columns: Mapping[str, Series1], source: str) -> Any:
    """Return columns as a table of pyarrow; NaN becomes null."""
    pyarrow = _pyarrow("pyarrow", source)
    arrays = {name: pyarrow.array(v, mask=np.isnan(v)) for name, v in columns.items()}
    return pyarrow.table(arrays)


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
