"""MAT files of MATLAB and Octave (version 5 to 7): each variable is a column of a table.

A file that we write has the native column names as variables, each a column vector, NaN for no
reading. Of other files the variables that are real vectors of the same length make the table.
Version 7.3 is another format (HDF5), which is not read. SciPy writes; its reader ends the whole
program on some broken files, so this reads so that broken bytes cannot hurt.

Format (public: MathWorks, "MAT-File Format", version 5; versions 6 and 7 are the same, 7 with
each variable compressed by zlib): a header of 128 bytes that ends with the version and 'IM' or
'MI' for the order of bytes; then elements of a type and a length (4 bytes each; up to 4 bytes of
data stand in the second word, the length then in the upper half of the first), padded to
multiples of 8. A matrix holds elements: flags (the class in the lowest byte, 0x0800: complex),
dimensions, name, real part. Cells, structures and texts are left aside.
"""

import io
import struct
import zlib
from collections.abc import Iterator, Mapping
from functools import partial
from typing import Any, cast

import numpy as np
from scipy.io import savemat

from equipoise.io.columns.table import Numbers, Table, finite
from equipoise.model.arrays import Series1
from equipoise.model.errors import InputError

MAGIC = b"MATLAB 5.0 MAT-file"
MAGIC_73 = b"MATLAB 7.3 MAT-file"
WANTED = "a MAT file of vectors of the same length"
HEADER = 128
ORDERS = {b"IM": "<", b"MI": ">"}
COMPRESSED, MATRIX = 15, 14
NUMBERS = range(6, 16)  # classes double, single, int8 to uint64
COMPLEX = 0x0800
TYPES = {
    1: "i1", 2: "u1", 3: "i2", 4: "u2", 5: "i4", 6: "u4", 7: "f4", 9: "f8", 12: "i8", 13: "u8",
}  # fmt: skip
MOST = 1 << 31  # bytes of a variable, chosen: more is no record of a platform


def read_mat(content: bytes, source: str) -> Table:
    """Return the table in a MAT file's bytes."""
    if content.startswith(MAGIC_73):
        wanted = "one of version 7: save with `save(file, '-v7')` in MATLAB"
        raise InputError(source, "a MAT file of version 7.3", wanted)
    try:
        columns = _vectors(content)
    except ValueError as error:
        raise InputError(source, f"a broken MAT file ({error})", WANTED) from error
    if not columns:
        raise InputError(source, "no variable that is a vector of numbers", WANTED)
    lengths = {len(vector) for vector in columns.values()}
    if len(lengths) > 1:
        raise InputError(source, f"vectors of {min(lengths)} to {max(lengths)} numbers", WANTED)
    count = lengths.pop()
    column = partial(_column, columns=columns)
    return Table(
        source,
        tuple(columns),
        count,
        column,
        cell=lambda name, row: str(columns[name][row]),
        blank="NaN",
    )


def mat_bytes(columns: Mapping[str, Series1]) -> bytes:
    """Return columns as a MAT file's bytes (version 5, which MATLAB and Octave read)."""
    stream = io.BytesIO()
    savemat(cast(Any, stream), dict(columns), oned_as="column")
    return stream.getvalue()


def _column(_table: Table, name: str, columns: Mapping[str, Series1]) -> Numbers:
    """Return a column; NaN says that there is no reading."""
    return finite(columns[name])


def _vectors(content: bytes) -> dict[str, Series1]:
    """Return the real vectors of two numbers or more, by name; ValueError if the file is broken."""
    order = ORDERS.get(content[HEADER - 2 : HEADER])
    if order is None:
        raise ValueError("no order of bytes")
    found: dict[str, Series1] = {}
    for kind, data in _elements(content[HEADER:], order):
        inner = _inflated(data, order) if kind == COMPRESSED else [(kind, data)]
        for inner_kind, matrix in inner:
            named = _vector(matrix, order) if inner_kind == MATRIX else None
            if named is not None:
                found[named[0]] = named[1]
    return found


def _elements(data: bytes, order: str) -> Iterator[tuple[int, bytes]]:
    """Yield the types and contents of elements that stand one behind the other."""
    at = 0
    while at < len(data):
        if at + 8 > len(data):
            raise ValueError("an element without a length")
        kind, size = struct.unpack_from(f"{order}II", data, at)
        if kind >> 16:
            kind, size, begin, step = kind & 0xFFFF, kind >> 16, at + 4, 8
        else:
            begin = at + 8
            step = 8 + size + (0 if kind == COMPRESSED else -size % 8)
        if begin + size > len(data):
            raise ValueError("an element beyond the end")
        yield kind, data[begin : begin + size]
        at += step


def _inflated(data: bytes, order: str) -> list[tuple[int, bytes]]:
    try:
        return list(_elements(zlib.decompressobj().decompress(data, MOST), order))
    except zlib.error as error:
        raise ValueError(str(error)) from error


def _vector(matrix: bytes, order: str) -> tuple[str, Series1] | None:
    """Return name and numbers of a matrix; None if it is no real vector."""
    parts = list(_elements(matrix, order))
    if len(parts) < 4 or len(parts[0][1]) < 4:
        return None
    (flags,) = struct.unpack_from(f"{order}I", parts[0][1])
    shape = _numbers(*parts[1], order)
    kind, data = parts[3]
    if flags & 0xFF not in NUMBERS or flags & COMPLEX or kind not in TYPES:
        return None
    values = _numbers(kind, data, order)
    if len(shape) != 2 or len(values) < 2 or sorted(shape.tolist()) != [1, len(values)]:
        return None
    return parts[2][1].decode("ascii", errors="replace"), values


def _numbers(kind: int, data: bytes, order: str) -> Series1:
    """Return an element's numbers; ValueError if it is not of numbers."""
    if kind not in TYPES:
        raise ValueError(f"type {kind} where numbers belong")
    return np.frombuffer(data, dtype=f"{order}{TYPES[kind]}").astype(np.float64)
