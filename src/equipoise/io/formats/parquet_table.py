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
from equipoise.io.files.broken_bytes import as_broken
from equipoise.io.files.file_content import Content
from equipoise.model.arrays import Series1
from equipoise.model.errors import InputError
from equipoise.model.optional_libraries import extra_library

MAGIC = b"PAR1"  # a Parquet file begins and ends with it
BATCH = 65536  # rows that are read at once (chosen)


def read_parquet(content: Content, source: str) -> Table:
    """Return the table in a Parquet file's bytes; lists and structures in it are not read."""
    parquet = pyarrow_library("pyarrow.parquet", source)
    with as_broken(source, "Parquet file", "a whole Parquet file"):
        names, arrow = _table(parquet, content)
    column = partial(_numbers, arrow=arrow)
    cell = partial(_cell, arrow=arrow)
    return Table(source, names, arrow.num_rows, column, cell=cell, blank="null")


def _table(parquet: Any, content: Content) -> tuple[tuple[str, ...], Any]:
    """Return the names of all columns, and those of single values, batch by batch as they fit.

    A text that many rows share is held once: else some bytes of a file stand for gigabytes.
    """
    stated = parquet.read_metadata(content.from_start())
    content.meter.check(_stated_size(stated))
    texts = [each.name for each in stated.schema.to_arrow_schema() if _is_text(each.type)]
    file = parquet.ParquetFile(content.from_start(), metadata=stated, read_dictionary=texts)
    schema = file.schema_arrow
    flat = [each.name for each in schema if each.type.num_fields == 0]
    batches: list[Any] = []
    for batch in file.iter_batches(BATCH, columns=flat):
        content.meter.take(batch.nbytes)
        batches.append(batch)
    arrow = import_module("pyarrow")
    kept = arrow.schema([each for each in schema if each.name in flat])
    return tuple(schema.names), arrow.Table.from_batches(batches, kept)


def _is_text(kind: Any) -> bool:
    types = import_module("pyarrow.types")
    return bool(types.is_string(kind) or types.is_binary(kind))


def _stated_size(metadata: Any) -> int:
    """Return the bytes that the largest group of rows takes, by what the file says of itself."""
    groups = (metadata.row_group(k) for k in range(metadata.num_row_groups))
    return max((int(group.total_byte_size) for group in groups), default=0)


def _numbers(table: Table, name: str, arrow: Any) -> Numbers:
    """Return a column; null says that there is no reading."""
    where = f"{table.source}, column '{name}'"
    if table.names.count(name) > 1:
        raise InputError(f"{table.source}, schema", f"two columns '{name}'", "one")
    if name not in arrow.column_names:
        raise InputError(where, "lists or structures", "numbers")
    column = arrow.column(name)
    try:
        values = np.concatenate([_doubles(chunk) for chunk in column.chunks] or [np.zeros(0)])
    except (ValueError, NotImplementedError) as error:
        raise InputError(where, f"values of type {column.type}", "numbers") from error
    return finite(values, np.array(column.is_null().to_numpy(), dtype=bool))


def _doubles(chunk: Any) -> Series1:
    """Return a column's rows as numbers; of texts each different one is read once."""
    if not hasattr(chunk, "dictionary"):
        return np.array(chunk.cast("float64").to_numpy(zero_copy_only=False), dtype=np.float64)
    different = _doubles(chunk.dictionary)
    rows = chunk.indices.fill_null(0).to_numpy(zero_copy_only=False)
    found = different[rows] if len(different) else np.full(len(rows), np.nan)
    return np.where(np.array(chunk.is_null(), dtype=bool), np.nan, found)


def _cell(name: str, row: int, arrow: Any) -> str:
    return str(arrow.column(name)[row].as_py())


def parquet_bytes(columns: Mapping[str, Series1], source: str) -> bytes:
    """Return columns as a Parquet file's bytes; NaN becomes null."""
    stream = io.BytesIO()
    pyarrow_library("pyarrow.parquet", source).write_table(arrow_columns(columns, source), stream)
    return stream.getvalue()


def arrow_columns(columns: Mapping[str, Series1], source: str) -> Any:
    """Return columns as a table of pyarrow; NaN becomes null."""
    pyarrow = pyarrow_library("pyarrow", source)
    arrays = {name: pyarrow.array(v, mask=np.isnan(v)) for name, v in columns.items()}
    return pyarrow.table(arrays)


def parquet_of_cells(columns: Mapping[str, Sequence[Any]], source: str) -> bytes:
    """Return columns of texts or numbers as a Parquet file's bytes; None becomes null."""
    pyarrow = pyarrow_library("pyarrow", source)
    return _written({name: pyarrow.array(cells) for name, cells in columns.items()}, source)


def _written(arrays: Mapping[str, Any], source: str) -> bytes:
    pyarrow = pyarrow_library("pyarrow", source)
    parquet = pyarrow_library("pyarrow.parquet", source)
    stream = io.BytesIO()
    parquet.write_table(pyarrow.table(arrays), stream)
    return stream.getvalue()


def pyarrow_library(name: str, source: str) -> Any:
    """Return a module of pyarrow; InputError names the extra where it is missing."""
    return extra_library(name, source, "a Parquet file", "parquet", ", or use a CSV file")
