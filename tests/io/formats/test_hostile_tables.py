"""Small files that stand for gigabytes: refused in a sentence, before they are there."""

import io
import os
import struct
import zlib
from collections.abc import Callable

import h5py
import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq
import pytest

from equipoise.io.recording.recording_file import read_recording
from equipoise.model.errors import InputError
from tests.support.excel_files import RATE_SHEET, archive, parts, sheet_xml
from tests.support.peak_memory import reading_of

PEAK = 600  # MB: the program with its libraries, and the 256 MB that a small file may take
REMEDY = "--max-memory-mb 512 lets it take more"


def parquet(**columns: pa.Array) -> bytes:
    stream = io.BytesIO()
    pq.write_table(pa.table(columns), stream, compression="zstd", store_schema=False)
    return stream.getvalue()


def many_rows() -> bytes:
    """60 million equal numbers, and a number for each."""
    same = pa.DictionaryArray.from_arrays(np.zeros(20_000_000, np.int8), pa.array([1.0]))
    return parquet(time_s=same, a=same, b=same)


def long_text_in_many_rows() -> bytes:
    """A text of 1 MB that 4000 rows share."""
    long = pa.array(["x" * 1_000_000])
    return parquet(name=pa.DictionaryArray.from_arrays(np.zeros(4000, np.int32), long))


def element(kind: int, data: bytes) -> bytes:
    return struct.pack("<II", kind, len(data)) + data + b"\0" * (-len(data) % 8)


def mat_5(*elements: bytes) -> bytes:
    packed = (zlib.compress(each, 1) for each in elements)
    whole = b"".join(struct.pack("<II", 15, len(each)) + each for each in packed)
    return b"MATLAB 5.0 MAT-file".ljust(124) + b"\x00\x01IM" + whole


def matrix(name: bytes, count: int) -> bytes:
    """A column of zeros of one byte each."""
    flags, shape = struct.pack("<II", 9, 0), struct.pack("<ii", count, 1)
    inner = element(6, flags) + element(5, shape) + element(1, name) + element(2, bytes(count))
    return element(14, inner)


def wide_numbers() -> bytes:
    """Bytes that become doubles: eight for each."""
    return mat_5(*(matrix(name, 30_000_000) for name in (b"time_s", b"a")))


def many_elements() -> bytes:
    return mat_5(element(14, bytes(100_000_000)))


def mat_73(fill: Callable[[h5py.File], None]) -> bytes:
    stream = io.BytesIO()
    with h5py.File(stream, "w", userblock_size=512) as file:
        fill(file)
        for name in file:
            if file.get(name, getlink=True).__class__ is h5py.HardLink:
                file[name].attrs["MATLAB_class"] = np.bytes_("double")
    return b"MATLAB 7.3 MAT-file".ljust(512, b"\0") + stream.getvalue()[512:]


def never_written() -> bytes:
    """A data set of 80 GB of which no byte is there."""
    return mat_73(lambda file: file.create_dataset("t", (1, 10**10), "f8", chunks=(1, 10**6)))


def large_piece() -> bytes:
    """Ten numbers in a piece with room for 2 GB."""
    return mat_73(
        lambda file: file.create_dataset(
            "t", (1, 10), "f8", maxshape=(1, None), chunks=(1, 250_000_000)
        )
    )


def texts_of_a_workbook() -> bytes:
    inside = parts({"run": sheet_xml(RATE_SHEET)})
    return archive({**inside, "xl/sharedStrings.xml": "<si><t>a</t></si>" * 3_000_000})


HOSTILE = {
    "many_rows.parquet": many_rows,
    "long_text_in_many_rows.parquet": long_text_in_many_rows,
    "wide_numbers.mat": wide_numbers,
    "many_elements.mat": many_elements,
    "never_written.mat": never_written,
    "large_piece.mat": large_piece,
    "texts.xlsx": texts_of_a_workbook,
}


@pytest.mark.parametrize("name", HOSTILE)
def test_a_small_file_that_stands_for_much_is_refused_before_it_is_there(tmp_path, name):
    path = tmp_path / name
    path.write_bytes(HOSTILE[name]())
    assert path.stat().st_size < 4_000_000
    said, peak_mb = reading_of(path)
    assert peak_mb < PEAK
    if name.startswith("long_text"):  # what rows share is held once, so that it does fit
        assert "name" in said
    else:
        assert REMEDY in said


def test_a_matlab_file_does_not_reach_into_others(tmp_path):
    """A link to another file and numbers that stand in one are left out."""
    (tmp_path / "other.bin").write_bytes(bytes(80))
    (tmp_path / "other.h5").write_bytes(mat_73(lambda file: file.create_dataset("x", data=[[1.0]])))

    def fill(file: h5py.File) -> None:
        file.create_dataset("stolen", (1, 10), "f8", external=[(tmp_path / "other.bin", 0, 80)])
        file["linked"] = h5py.ExternalLink(tmp_path / "other.h5", "/x")

    path = tmp_path / "run.mat"
    path.write_bytes(mat_73(fill))
    with pytest.raises(InputError, match="no variable with rows of numbers; wanted"):
        read_recording(path)


def test_two_columns_of_one_name_are_named(tmp_path):
    names = ["time_s", "time_s", "omega_x_rad_s", "omega_y_rad_s", "omega_z_rad_s"]
    table = pa.table([pa.array([0.0, 1.0])] * len(names), names=names)
    pq.write_table(table, tmp_path / "run.parquet")
    with pytest.raises(InputError, match="two columns 'time_s'"):
        read_recording(tmp_path / "run.parquet")


@pytest.mark.parametrize("make", [os.mkfifo, os.mkdir], ids=["pipe", "directory"])
def test_only_a_file_is_read(tmp_path, make):
    """A pipe that nobody writes to is not waited for."""
    path = tmp_path / "run.csv"
    make(path)
    with pytest.raises(InputError, match=r"found a (pipe|directory); wanted a recording"):
        read_recording(path)


def test_a_device_that_never_ends_is_refused():
    with pytest.raises(InputError, match="found a device; wanted a recording"):
        read_recording("/dev/zero")


def test_a_file_with_holes_is_as_large_as_it_says(tmp_path):
    """A terabyte that takes no place on the disk."""
    with (tmp_path / "run.csv").open("wb") as file:
        file.truncate(1 << 40)
    with pytest.raises(InputError, match="binary content that begins with 0x00"):
        read_recording(tmp_path / "run.csv")
