"""Variables of MAT files of version 7.3: HDF5 as MATLAB writes it, read by h5py.

A variable is a data set, or for a structure a group of them, with its class in the attribute
``MATLAB_class``; dimensions stand the other way round; ``MATLAB_empty`` marks a data set that
holds but the size of something empty; what begins with # is MATLAB's own. h5py is an extra,
imported when such a file is met and not before, in a process of its own (``hdf5_process``).
"""

import math
from collections.abc import Iterator
from typing import Any

import numpy as np

from equipoise.io.files.broken_bytes import as_value_error
from equipoise.io.files.file_content import Content
from equipoise.io.files.reading_budget import CELL, Meter
from equipoise.io.formats.matlab.mat_variables import DEEPEST, Array
from equipoise.model.optional_libraries import extra_library

CLASS, EMPTY = "MATLAB_class", "MATLAB_empty"
STRUCTURE = "struct"
NUMBERS = {
    "double", "single", "logical", "int8", "int16", "int32", "int64", "uint8", "uint16", "uint32",
    "uint64",
}  # fmt: skip
REAL = "fiu"  # kinds of NumPy's types
MATLAB_73 = "a MAT file of version 7.3", "matlab", ", or in MATLAB `save(file, '-v7')`"


def variables_73(content: Content, source: str) -> dict[str, Array]:
    """Return the real arrays by name, fields as 'name.field'; ValueError if the file is broken.

    InputError where they take too much. What stands in another file is not read.
    """
    h5py = extra_library("h5py", source, *MATLAB_73)
    with as_value_error(), h5py.File(content.from_start(), "r") as file:
        return dict(_arrays(file, "", DEEPEST, content.meter))


def _arrays(group: Any, prefix: str, deep: int, meter: Meter) -> Iterator[tuple[str, Array]]:
    """Yield the arrays of a group and of the structures in it."""
    for name in group:
        meter.take(CELL)
        item = None if name.startswith("#") else _own(group, name)
        kind = "" if item is None else _class(item)
        if kind == STRUCTURE and deep and hasattr(item, "keys"):
            yield from _arrays(item, f"{prefix}{name}.", deep - 1, meter)
        elif item is not None and kind in NUMBERS and _is_real(item):
            meter.check(_piece(item))
            meter.take(8 * item.size)
            yield f"{prefix}{name}", np.asarray(item[()], dtype=np.float64).T


def _own(group: Any, name: str) -> Any:
    """Return what a name stands for in this file; None where it leads into another."""
    if type(group.get(name, getlink=True)).__name__ != "HardLink":
        return None
    item = group[name]
    elsewhere = getattr(item, "external", None) or getattr(item, "is_virtual", False)
    return None if elsewhere else item


def _piece(item: Any) -> int:
    """Return the bytes that the library unpacks at once, beside the data set itself."""
    return math.prod(item.chunks or ()) * item.dtype.itemsize + item.nbytes


def _class(item: Any) -> str:
    found = item.attrs.get(CLASS, b"")
    return found.decode("ascii", errors="replace") if isinstance(found, bytes) else str(found)


def _is_real(item: Any) -> bool:
    """Say whether something is a data set of real numbers."""
    return hasattr(item, "dtype") and item.dtype.kind in REAL and not item.attrs.get(EMPTY, 0)
