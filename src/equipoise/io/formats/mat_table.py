"""MAT files of MATLAB and Octave, of every version: variables are columns of a table.

A file that we write has the native column names as variables, each a column vector, NaN for no
reading. Of other files the vectors and matrices of real numbers with the most common number of rows
make the table, also those in structures (``mat_variables``).
"""

import io
from collections.abc import Mapping
from functools import partial
from typing import Any, cast

import scipy

from equipoise.io.columns.table import Numbers, Table, finite
from equipoise.io.files.broken_bytes import unreadable
from equipoise.io.files.file_content import Content
from equipoise.io.formats.matlab.hdf5_process import variables_from_process
from equipoise.io.formats.matlab.mat_variables import Array, listed, table_columns
from equipoise.io.formats.matlab.mat_version_4 import is_version_4, variables_4
from equipoise.io.formats.matlab.mat_version_5 import variables_5
from equipoise.model.arrays import Series1
from equipoise.model.errors import InputError

MAGIC = b"MATLAB 5.0 MAT-file"
MAGIC_73 = b"MATLAB 7.3 MAT-file"
WANTED = (
    "a MAT file of vectors or matrices of numbers, or of a structure of them (of a table: "
    "`S = table2struct(T, 'ToScalar', true)`)"
)


def read_mat(content: Content, source: str) -> Table:
    """Return the table in a MAT file's bytes."""
    try:
        variables = _variables(content, source)
    except ValueError as error:
        raise unreadable(source, "MAT file", WANTED, error) from error
    columns, notes = table_columns(variables)
    if not columns:
        beside = f", only {listed(variables, variables)}" if variables else ""
        raise InputError(source, f"no variable with rows of numbers{beside}", WANTED)
    count = len(next(iter(columns.values())))
    return Table(
        source,
        tuple(columns),
        count,
        partial(_column, columns=columns),
        notes=notes,
        cell=lambda name, row: str(columns[name][row]),
        blank="NaN",
    )


def _variables(content: Content, source: str) -> dict[str, Array]:
    """Return the arrays of a file by name; ValueError if it is broken."""
    if content.startswith(MAGIC_73):
        return variables_from_process(content, source)
    data = content.whole()
    read = variables_4 if is_version_4(data) else variables_5
    return read(data, content.meter)


def mat_bytes(columns: Mapping[str, Series1]) -> bytes:
    """Return columns as a MAT file's bytes (version 5, which MATLAB and Octave read)."""
    stream = io.BytesIO()
    scipy.io.savemat(cast(Any, stream), dict(columns), oned_as="column")
    return stream.getvalue()


def _column(_table: Table, name: str, columns: Mapping[str, Series1]) -> Numbers:
    """Return a column; NaN says that there is no reading."""
    return finite(columns[name])
