"""MAT files of MATLAB and Octave (version 5 to 7): each variable is a column of a table.

A file that we write has the native column names as variables, each a column vector, NaN for no
reading. Of other files the variables that are real vectors of the same length make the table.
Version 7.3 is another format (HDF5), which is not read. SciPy writes and ``mat_elements`` reads:
SciPy's reader ends the whole program on some broken files.
"""

import io
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, cast

import numpy as np
from scipy.io import savemat

from equipoise.io.formats.mat_elements import vectors
from equipoise.model.arrays import Series1
from equipoise.model.errors import InputError

MAGIC = b"MATLAB 5.0 MAT-file"
MAGIC_73 = b"MATLAB 7.3 MAT-file"
WANTED = "a MAT file of vectors of the same length"


@dataclass(frozen=True, slots=True, eq=False)
class MatTable:
    """A table of numbers, all columns of the same length."""

    source: str
    columns: Mapping[str, Series1]
    notes: tuple[str, ...] = ()

    @property
    def names(self) -> tuple[str, ...]:
        """Return the columns' names."""
        return tuple(self.columns)

    def __len__(self) -> int:
        """Return the number of rows."""
        return len(next(iter(self.columns.values())))

    def place(self, row: int) -> str:
        """Return a row's number, counted from 1 as MATLAB does."""
        return f"row {row + 1}"

    def numbers(self, name: str) -> Series1:
        """Return a column, NaN where there is no reading."""
        values = self.columns[name]
        for row in np.flatnonzero(np.isinf(values)):
            place = f"{self.source}, {self.place(int(row))}, column '{name}'"
            raise InputError(place, f"'{values[row]}'", "a finite number, or NaN for no reading")
        return values


def read_mat(content: bytes, source: str) -> MatTable:
    """Return the table in a MAT file's bytes."""
    if content.startswith(MAGIC_73):
        wanted = "one of version 7: save with `save(file, '-v7')` in MATLAB"
        raise InputError(source, "a MAT file of version 7.3", wanted)
    try:
        columns = vectors(content)
    except ValueError as error:
        raise InputError(source, f"a broken MAT file ({error})", WANTED) from error
    if not columns:
        raise InputError(source, "no variable that is a vector of numbers", WANTED)
    lengths = {len(vector) for vector in columns.values()}
    if len(lengths) > 1:
        raise InputError(source, f"vectors of {min(lengths)} to {max(lengths)} numbers", WANTED)
    return MatTable(source, columns)


def mat_bytes(columns: Mapping[str, Series1]) -> bytes:
    """Return columns as a MAT file's bytes (version 5, which MATLAB and Octave read)."""
    stream = io.BytesIO()
    savemat(cast(Any, stream), dict(columns), oned_as="column")
    return stream.getvalue()
