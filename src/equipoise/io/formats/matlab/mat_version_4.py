"""Variables of MAT files of version 4, which MATLAB wrote until 1996, and ``save -v4`` still does.

Format (public: MathWorks, "MAT-File Format", version 4): for each matrix five numbers of 4 bytes
(type, rows, columns, 1 if complex, length of the name), the name and a zero, the real part column
by column, the imaginary part. The digits of the type: order of bytes (0 least first, 1 most
first), 0, type of the numbers, kind (0 full, 1 text, 2 sparse). There is no mark of the file.
"""

import struct
from typing import NamedTuple

import numpy as np

from equipoise.io.files.reading_budget import CELL, Meter
from equipoise.io.formats.matlab.mat_variables import Array

HEADER = 20  # bytes
ORDERS = {"<": 0, ">": 1}  # first digit of the type
TYPES = ("f8", "f4", "i4", "i2", "u2", "u1")
KINDS = 3  # full, text, sparse
LONGEST = 256  # bytes of a name (chosen: MATLAB's have 63)


class Header(NamedTuple):
    """What stands before a matrix."""

    dtype: str
    kind: int
    rows: int
    columns: int
    is_complex: bool
    name_size: int  # bytes, with the zero

    @property
    def size(self) -> int:
        """Return the bytes of the real part."""
        return self.rows * self.columns * np.dtype(self.dtype).itemsize


def is_version_4(content: bytes) -> bool:
    """Say whether a file begins with a header that makes sense."""
    return _header(content, 0) is not None


def variables_4(content: bytes, meter: Meter) -> dict[str, Array]:
    """Return the real full matrices by name; ValueError if the file is broken.

    InputError where they take too much.
    """
    found: dict[str, Array] = {}
    at = 0
    while at < len(content):
        head = _header(content, at)
        if head is None:
            raise ValueError(f"byte {at + 1} begins no matrix")
        begin = at + HEADER + head.name_size
        at = begin + head.size * (2 if head.is_complex else 1)
        if at > len(content):
            raise ValueError("a matrix beyond the end")
        name = content[begin - head.name_size : begin].partition(b"\0")[0]
        meter.take(CELL + 8 * head.rows * head.columns)
        if head.kind == 0 and not head.is_complex:
            values = np.frombuffer(content[begin:at], dtype=head.dtype).astype(np.float64)
            shape = (head.rows, head.columns)
            found[name.decode("ascii", errors="replace")] = values.reshape(shape, order="F")
    return found


def _header(content: bytes, at: int) -> Header | None:
    """Return the header at a place; None if there is none that makes sense."""
    if at + HEADER > len(content):
        return None
    for order, digit in ORDERS.items():
        code, rows, columns, imaginary, size = struct.unpack_from(f"{order}5i", content, at)
        first, type_, kind = code // 1000, code % 1000 // 10, code % 10
        typed = first == digit and 0 <= type_ < len(TYPES) and kind < KINDS
        if typed and min(rows, columns) >= 0 and imaginary in (0, 1) and 0 < size <= LONGEST:
            return Header(f"{order}{TYPES[type_]}", kind, rows, columns, imaginary == 1, size)
    return None
