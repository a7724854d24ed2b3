"""MAT files of every version, made by SciPy, by hand, and by h5py in the way of MATLAB."""

import io
import struct
from collections.abc import Mapping
from typing import Any

import h5py
import numpy as np
from scipy.io import savemat

USER_BLOCK = 512  # bytes before the HDF5 of MATLAB
TEXT = b"MATLAB 7.3 MAT-file, Platform: GLNXA64, Created on: Mon Mar  2 12:00:00 2026 HDF5 schema 1"
CLASSES = {"f8": "double", "f4": "single", "i4": "int32", "u1": "uint8"}


def mat_4(variables: Mapping[str, Any]) -> bytes:
    stream = io.BytesIO()
    savemat(stream, dict(variables), format="4")
    return stream.getvalue()


def mat_4_of(order: str, dtype: str, code: int, name: str, matrix: Any) -> bytes:
    """Return one matrix by hand, of a type by its digits."""
    values = np.asarray(matrix)
    head = struct.pack(f"{order}5i", code, *values.shape, 0, len(name) + 1)
    return head + name.encode() + b"\0" + values.astype(order + dtype).tobytes(order="F")


def mat_5(variables: Mapping[str, Any], packed: bool = False) -> bytes:
    stream = io.BytesIO()
    savemat(stream, dict(variables), do_compression=packed)
    return stream.getvalue()


def mat_73(variables: Mapping[str, Any]) -> bytes:
    """Return a file as MATLAB writes it: each matrix lies on its side, structures are groups."""
    stream = io.BytesIO()
    with h5py.File(stream, "w", userblock_size=USER_BLOCK) as file:
        _filled(file, variables)
        cells = file.create_group("#refs#")
        cells.create_dataset("a", data=np.ones((2401, 3)))
    return _headed(stream)


def mat_73_without_end() -> bytes:
    """Return a text of no length in a heap of HDF5: its library seeks the next one for ever."""
    stream = io.BytesIO()
    with h5py.File(stream, "w", userblock_size=USER_BLOCK) as file:
        file.create_dataset("time_s", data=np.arange(6.0)).attrs["MATLAB_class"] = "double"
    content = _headed(stream)
    size = content.index(b"GCOL") + 24
    return content[:size] + bytes(8) + content[size + 8 :]


def _headed(stream: io.BytesIO) -> bytes:
    head = TEXT.ljust(116) + bytes(8) + struct.pack("<H", 0x0200) + b"IM"
    return head.ljust(USER_BLOCK, b"\0") + stream.getvalue()[USER_BLOCK:]


def _filled(group: Any, variables: Mapping[str, Any]) -> None:
    for name, value in variables.items():
        if isinstance(value, dict):
            inner = group.create_group(name)
            inner.attrs["MATLAB_class"] = np.bytes_("struct")
            _filled(inner, value)
        elif isinstance(value, str):
            codes = np.array([[ord(letter)] for letter in value], dtype=np.uint16)
            _set(group, name, codes, "char")
        else:
            values = np.atleast_2d(np.asarray(value))
            flat = values.size == 0
            stored = np.array(values.shape, dtype=np.uint64) if flat else values.T
            kind = "logical" if values.dtype == bool else CLASSES[values.dtype.str[1:]]
            _set(group, name, stored.astype(np.uint8) if kind == "logical" else stored, kind)
            if flat:
                group[name].attrs["MATLAB_empty"] = np.uint8(1)


def _set(group: Any, name: str, values: Any, kind: str) -> None:
    chunks = values.shape if values.size > 1 else None
    group.create_dataset(name, data=values, chunks=chunks, compression="gzip" if chunks else None)
    group[name].attrs["MATLAB_class"] = np.bytes_(kind)
