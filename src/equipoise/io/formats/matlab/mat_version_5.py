"""Variables of MAT files of version 5 to 7, read so that broken bytes cannot hurt.

SciPy's reader ends the whole program on some broken files.

Format (public: MathWorks, "MAT-File Format", version 5; versions 6 and 7 are the same, 7 with
each variable compressed by zlib): a header of 128 bytes that ends with the version and 'IM' or
'MI' for the order of bytes; then elements of a type and a length (4 bytes each; up to 4 bytes of
data stand in the second word, the length then in the upper half of the first), padded to
multiples of 8. A matrix holds elements: flags (the class in the lowest byte, 0x0800: complex),
dimensions, name, real part, column by column. A structure has in place of the real part the
length of a field's name, all names, and a matrix without a name for each field. Cells, texts,
objects, complex numbers and arrays of structures are ignored.
"""

import math
import struct
import zlib
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from equipoise.io.files.reading_budget import CELL, Meter
from equipoise.io.formats.matlab.mat_variables import DEEPEST, Array
from equipoise.model.arrays import Series1

HEADER = 128
ORDERS = {b"IM": "<", b"MI": ">"}
COMPRESSED, MATRIX = 15, 14
STRUCTURE = 2
NUMBERS = range(6, 16)  # classes double, single, int8 to uint64
COMPLEX = 0x0800
TYPES = {
    1: "i1", 2: "u1", 3: "i2", 4: "u2", 5: "i4", 6: "u4", 7: "f4", 9: "f8", 12: "i8", 13: "u8",
}  # fmt: skip
Element = tuple[int, memoryview]  # type and content
Named = Iterator[tuple[str, Array]]


def variables_5(content: bytes, meter: Meter) -> dict[str, Array]:
    """Return the real arrays by name, fields as 'name.field'; ValueError if the file is broken.

    InputError where they take too much.
    """
    order = ORDERS.get(content[HEADER - 2 : HEADER])
    if order is None:
        raise ValueError("no order of bytes")
    file, found = _File(order, meter), dict[str, Array]()
    for kind, data in file.elements(memoryview(content)[HEADER:]):
        inner = file.inflated(data) if kind == COMPRESSED else [(kind, data)]
        for inner_kind, matrix in inner:
            if inner_kind == MATRIX:
                found.update(file.variable(matrix))
    return found


@dataclass(frozen=True, slots=True)
class _File:
    """How a file's bytes are read, and what counts them."""

    order: str
    meter: Meter

    def elements(self, data: memoryview) -> Iterator[Element]:
        """Yield the types and contents of elements that stand one behind the other."""
        at = 0
        while at < len(data):
            if at + 8 > len(data):
                raise ValueError("an element without a length")
            kind, size = struct.unpack_from(f"{self.order}II", data, at)
            if kind >> 16:
                kind, size, begin, step = kind & 0xFFFF, kind >> 16, at + 4, 8
            else:
                begin = at + 8
                step = 8 + size + (0 if kind == COMPRESSED else -size % 8)
            if begin + size > len(data):
                raise ValueError("an element beyond the end")
            self.meter.take(CELL)
            yield kind, data[begin : begin + size]
            at += step

    def inflated(self, data: memoryview) -> Iterator[Element]:
        """Yield the elements that one unpacks to."""
        left = self.meter.left
        try:
            unpacked = zlib.decompressobj().decompress(data, max(left, 1))
        except zlib.error as error:
            raise ValueError(str(error)) from error
        self.meter.take(len(unpacked))
        self.meter.check(1)
        yield from self.elements(memoryview(unpacked))

    def variable(self, matrix: memoryview) -> Named:
        """Yield what a variable holds; one without a name is MATLAB's own."""
        parts = list(self.elements(matrix))
        if len(parts) > 2 and len(parts[2][1]):
            yield from self._arrays(_text(parts[2][1]), parts, DEEPEST)

    def _arrays(self, name: str, parts: list[Element], deep: int) -> Named:
        """Yield name and numbers of a matrix, or of each field of a structure."""
        if len(parts) < 4 or len(parts[0][1]) < 4:
            return
        (flags,) = struct.unpack_from(f"{self.order}I", parts[0][1])
        shape = tuple(map(int, self._numbers(*parts[1])))
        if flags & 0xFF == STRUCTURE and math.prod(shape) == 1 and deep:
            for field, matrix in self._fields(parts):
                inner = list(self.elements(matrix))
                yield from self._arrays(f"{name}.{field}", inner, deep - 1)
        kind, data = parts[3]
        if flags & 0xFF in NUMBERS and not flags & COMPLEX and kind in TYPES:
            values = self._numbers(kind, data)
            if min(shape, default=-1) >= 0 and math.prod(shape) == len(values):
                yield name, values.reshape(shape, order="F")

    def _fields(self, parts: list[Element]) -> Iterator[tuple[str, memoryview]]:
        """Yield name and matrix of each field of a structure."""
        size = self._numbers(*parts[3])
        width = int(size[0]) if len(size) else 0
        if width < 1 or len(parts) < 5:
            raise ValueError("a structure without names of its fields")
        names = parts[4][1]
        for k, (kind, matrix) in enumerate(parts[5:]):
            if kind == MATRIX:
                yield _text(names[k * width : (k + 1) * width]), matrix

    def _numbers(self, kind: int, data: memoryview) -> Series1:
        """Return an element's numbers; ValueError if it is not of numbers."""
        if kind not in TYPES:
            raise ValueError(f"type {kind} where numbers belong")
        numbers = np.frombuffer(data, dtype=f"{self.order}{TYPES[kind]}")
        self.meter.take(8 * len(numbers))
        return numbers.astype(np.float64)


def _text(data: memoryview) -> str:
    return bytes(data).partition(b"\0")[0].decode("ascii", errors="replace")
