"""Variables of MAT files of version 7.3: HDF5 as MATLAB writes it, read by h5py.

A variable is a data set, or for a structure a group of them, with its class in the attribute
``MATLAB_class``; dimensions stand the other way round; ``MATLAB_empty`` marks a data set that
holds but the size of something empty; what begins with # is MATLAB's own. h5py is an extra,
imported when such a file is met and not before.
"""

import io
from collections.abc import Iterator
from typing import Any

import numpy as np

from equipoise.io.formats.matlab.mat_variables import DEEPEST, Array
from equipoise.io.formats.optional_libraries import extra_library
from equipoise.model.errors import EquipoiseError

CLASS, EMPTY = "MATLAB_class", "MATLAB_empty"
STRUCTURE = "struct"
NUMBERS = {
    "double", "single", "logical", "int8", "int16", "int32", "int64", "uint8", "uint16", "uint32",
    "uint64",
}  # fmt: skip
REAL = "fiu"  # kinds of NumPy's types
DENSEST = 1032  # bytes that one of deflate's can stand for (zlib's manual)
INSTEAD = ", or in MATLAB `save(file, '-v7')`"


def variables_73(content: bytes, source: str) -> dict[str, Array]:
    """Return the real arrays by name, fields as 'name.field'; ValueError if the file is broken."""
    h5py = extra_library("h5py", source, "a MAT file of version 7.3", "matlab", INSTEAD)
    try:
        with h5py.File(io.BytesIO(content), "r") as file:
            return dict(_arrays(file, "", DEEPEST, DENSEST * len(content)))
    except EquipoiseError:
        raise
    except Exception as error:  # a parser of broken bytes raises anything
        raise ValueError(str(error)) from error


def _arrays(group: Any, prefix: str, deep: int, most: int) -> Iterator[tuple[str, Array]]:
    """Yield the arrays of a group and of the structures in it, of ``most`` bytes each."""
    for name in group:
        if name.startswith("#"):
            continue
        item = group[name]
        kind = _class(item)
        if kind == STRUCTURE and deep and hasattr(item, "keys"):
            yield from _arrays(item, f"{prefix}{name}.", deep - 1, most)
        elif kind in NUMBERS and _is_real(item):
            if item.nbytes > most:
                raise ValueError(f"'{prefix}{name}' is larger than the file can hold")
            yield f"{prefix}{name}", np.asarray(item[()], dtype=np.float64).T


def _class(item: Any) -> str:
    found = item.attrs.get(CLASS, b"")
    return found.decode("ascii", errors="replace") if isinstance(found, bytes) else str(found)


def _is_real(item: Any) -> bool:
    """Say whether something is a data set of real numbers."""
    return hasattr(item, "dtype") and item.dtype.kind in REAL and not item.attrs.get(EMPTY, 0)
