"""Bytes that are a text in some encoding, and bytes that are not: named by what they are."""

import bz2
import gzip
import io
import lzma
import sqlite3
import struct
import sys
import tarfile
import zipfile
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
import pytest
from scipy.io import savemat

from equipoise.io.columns.column_map_file import read_column_map
from equipoise.io.files.source_file import text_of
from equipoise.io.recording.recording_file import read_recording, write_recording
from equipoise.model.errors import InputError
from tests.support.byte_captures import pcap, pcapng, telemetry
from tests.support.mat_files import mat_73
from tests.support.sample_logs import IMU, bag_1, record, ulog

TABLE = "time_s,omega_x_rad_s,omega_y_rad_s,omega_z_rad_s\n" + "".join(
    f"{k / 7},{k / 3},{0.1 + k},1e-17\n" for k in range(6)
)
FRAME = b"\xfd\x00" + bytes(10)  # of MAVLink 2, without a payload


# --- Text ----------------------------------------------------------------------------------------


@pytest.mark.parametrize("encoding", ["utf-8", "utf-8-sig", "utf-16", "utf-16-le", "utf-16-be"])
def test_a_table_is_read_in_every_encoding(tmp_path, encoding):
    """UTF-16 with its mark and without one."""
    (tmp_path / "run.csv").write_bytes(TABLE.encode(encoding))
    rate = read_recording(tmp_path / "run.csv").rate
    np.testing.assert_array_equal(rate.t, np.arange(6) / 7)


@pytest.mark.parametrize("encoding", ["utf-16", "utf-16-le", "utf-16-be"])
def test_a_text_that_ends_within_a_letter_is_read_up_to_it(encoding):
    assert text_of("a,b\n1,2\n".encode(encoding)[:-1], "a", "b")[:-1] == "a,b\n1,2"


def test_an_old_code_page_is_read():
    assert text_of("tilt in °\n".encode("latin-1"), "a", "b") == "tilt in °\n"


# --- What is no text -----------------------------------------------------------------------------


def zipped() -> bytes:
    stream = io.BytesIO()
    with zipfile.ZipFile(stream, "w") as file:
        file.writestr("a.txt", "a")
    return stream.getvalue()


def tarred() -> bytes:
    stream = io.BytesIO()
    with tarfile.open(fileobj=stream, mode="w") as file:
        file.addfile(tarfile.TarInfo("a.txt"))
    return stream.getvalue()


def picture(kind: str) -> bytes:
    stream = io.BytesIO()
    plt.imsave(stream, np.zeros((2, 2)), format=kind)
    return stream.getvalue()


def page() -> bytes:
    stream, figure = io.BytesIO(), plt.figure()
    figure.savefig(stream, format="pdf")
    plt.close(figure)
    return stream.getvalue()


def database(folder) -> bytes:
    connection = sqlite3.connect(folder / "a.db")
    connection.execute("create table a (b)")
    connection.commit()
    connection.close()
    return (folder / "a.db").read_bytes()


def of_ours(suffix: str):
    def made(folder) -> bytes:
        write_recording(record(), folder / f"a{suffix}")
        return (folder / f"a{suffix}").read_bytes()

    return made


def mat(_folder) -> bytes:
    stream = io.BytesIO()
    savemat(stream, {"a": np.eye(3)})
    return stream.getvalue()


# Made by the programs whose they are where these are at hand, else their published marks.
KINDS = {
    "a gzip file": lambda _: gzip.compress(b"a"),
    "a zip archive": lambda _: zipped(),
    "an empty zip archive": lambda _: b"PK\x05\x06" + bytes(18),
    "a 7z archive": lambda _: bytes.fromhex("377abcaf271c0004"),
    "a rar archive": lambda _: b"Rar!\x1a\x07\x01\x00",
    "an xz file": lambda _: lzma.compress(b"a"),
    "a bzip2 file": lambda _: bz2.compress(b"a"),
    "a tar archive": lambda _: tarred(),
    "a PDF": lambda _: page(),
    "a PNG picture": lambda _: picture("png"),
    "a JPEG picture": lambda _: picture("jpeg"),
    "an old Excel file": lambda _: bytes.fromhex("d0cf11e0a1b11ae1") + bytes(504),
    "an HDF5 file": lambda _: mat_73({"a": np.eye(3)})[512:],
    "an SQLite database": database,
    r"a program \(ELF\)": lambda _: b"\x7fELF\x02\x01\x01" + bytes(9),
    r"a program \(Windows\)": lambda _: b"MZ\x90\x00\x03" + bytes(9),
    r"captured network traffic \(pcap;": lambda _: pcap([(1.7e9, b"abc")]),
    r"captured network traffic \(pcapng;": lambda _: pcapng([(1.7e9, b"abc")]),
    "a bag of ROS 1": lambda folder: bag_1(folder / "a.bag", {"/imu": IMU}).read_bytes(),
    "a Parquet table": of_ours(".parquet"),
    "an MCAP log": of_ours(".mcap"),
    "a MAT file": mat,
    r"a log of PX4 \(ULog\)": lambda _: ulog("sensor_combined"),
    "a dataflash log of ArduPilot": lambda _: bytes.fromhex("a3958080594642484e00"),
    "a stream of MAVLink": lambda _: FRAME,
    "a telemetry log of MAVLink": lambda _: telemetry([(1.7e9, FRAME)]),
}


@pytest.mark.parametrize("name", KINDS)
def test_what_is_no_text_is_named(tmp_path, name):
    path = tmp_path / "map.toml"
    path.write_bytes(KINDS[name](tmp_path))
    with pytest.raises(InputError, match=f"found binary content: {name}.*; wanted a column map"):
        read_column_map(path)


def test_a_stream_of_the_first_mavlink_is_named():
    with pytest.raises(InputError, match="a stream of MAVLink"):
        text_of(b"\xfe\x00\x01\x02\x03\x04", "a", "b")


def test_this_program_is_no_recording(tmp_path):
    """The interpreter that runs the tests, whatever it is made for."""
    (tmp_path / "run.csv").write_bytes(Path(sys.executable).read_bytes()[:1000])
    with pytest.raises(InputError, match=r"found binary content(: a program| that begins with 0x)"):
        read_recording(tmp_path / "run.csv")


def test_unknown_bytes_are_shown():
    with pytest.raises(
        InputError, match="binary content that begins with 0x01 00 ff 41 42 43 44 45;"
    ):
        text_of(b"\x01\x00\xffABCDEFG", "a", "b")


@pytest.mark.parametrize("order", ["<", ">"])
def test_small_numbers_are_no_text(order):
    """Every second byte of them is zero, as in UTF-16, but control characters are among them."""
    content = struct.pack(f"{order}50h", *range(50))
    with pytest.raises(InputError, match="binary content that begins with 0x00 00"):
        text_of(content, "a", "b")
