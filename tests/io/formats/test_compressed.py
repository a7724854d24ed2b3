"""Compressed recordings: of every format, by gzip, zip and Zstandard, whole, cut and garbled."""

import gzip
import hashlib
import io
import sys
import zipfile

import numpy as np
import pytest
import zstandard

from equipoise.io.columns.read_options import ReadOptions
from equipoise.io.recording.recording_file import read_recording, write_recording
from equipoise.model.errors import InputError
from tests.support.broken_files import times_refused
from tests.support.excel_files import RATE_SHEET, archive, workbook
from tests.support.sample_logs import IMU, bag_1, bag_2_file, record, ulog

CSV = "\n".join(",".join(map(str, row)) for row in RATE_SHEET).encode()


def zipped(content: bytes, name: str = "inner.csv") -> bytes:
    return archive({name: content})


def zstd(content: bytes) -> bytes:
    return zstandard.compress(content)


WAYS = {"gz": gzip.compress, "zip": zipped, "zst": zstd}


def read(tmp_path, content: bytes, name: str = "run.dat"):
    (tmp_path / name).write_bytes(content)
    return read_recording(tmp_path / name)


@pytest.fixture(scope="module")
def recordings(tmp_path_factory) -> dict[str, bytes]:
    """One file of every format."""
    folder = tmp_path_factory.mktemp("whole")
    for suffix in ("csv", "parquet", "mcap", "mat"):
        write_recording(record(), folder / f"run.{suffix}")
    made = [*folder.iterdir(), bag_1(folder / "run.bag", {"/imu": IMU})]
    files = {path.suffix[1:]: path.read_bytes() for path in made}
    files["db3"] = bag_2_file(folder / "two", {"/imu": IMU}).read_bytes()
    return files | {"ulg": ulog("sensor_combined"), "xlsx": workbook({"run": RATE_SHEET})}


FORMATS = ("csv", "parquet", "mcap", "mat", "bag", "db3", "ulg", "xlsx")


@pytest.mark.parametrize("way", WAYS)
@pytest.mark.parametrize("kind", FORMATS)
def test_every_format_is_read_from_inside(tmp_path, recordings, kind, way):
    """The same rows as from the file itself, and the hash of the file as it is."""
    plain = read(tmp_path, recordings[kind], f"run.{kind}")
    inside = zipped(recordings[kind], f"day/run.{kind}") if way == "zip" else None
    packed = inside or WAYS[way](recordings[kind])
    found = read(tmp_path, packed, f"run.{kind}.{way}")
    np.testing.assert_array_equal(found.rate.t, plain.rate.t)
    np.testing.assert_array_equal(found.rate.values, plain.rate.values)
    assert found.sha256 == hashlib.sha256(packed).hexdigest()


@pytest.mark.parametrize("way", WAYS)
def test_the_name_of_a_compressed_file_says_nothing(tmp_path, recordings, way):
    """Not that it is compressed, nor what is inside."""
    assert len(read(tmp_path, WAYS[way](recordings["csv"]), "run.txt").rate) == 4
    assert len(read(tmp_path, WAYS[way](recordings["mcap"]), "run.csv").rate) == 4


def test_a_text_under_the_name_of_a_compressed_file_is_read(tmp_path):
    """Browsers unpack what they fetch, and keep its name."""
    assert len(read(tmp_path, CSV, "run.csv.gz").rate) == 6


def test_a_folder_of_the_same_name_is_no_bag(tmp_path):
    (tmp_path / "run").mkdir()
    assert len(read(tmp_path, gzip.compress(CSV), "run.gz").rate) == 6


def test_pieces_that_stand_one_behind_the_other_are_one_file(tmp_path):
    """As parallel compressors write them."""
    for way in (gzip.compress, zstd):
        assert len(read(tmp_path, way(CSV[:50]) + way(CSV[50:])).rate) == 6


def test_several_recordings_in_an_archive_are_listed(tmp_path):
    packed = archive({"b/run2.csv": CSV, "run1.csv": CSV})
    with pytest.raises(InputError, match=r"2 files .*: b/run2\.csv, run1\.csv; .*the one you want"):
        read(tmp_path, packed)


def test_a_long_list_is_cut_short(tmp_path):
    packed = archive({f"{k}.csv": CSV for k in range(15)})
    with pytest.raises(InputError, match=r"15 files .* 11\.csv and 3 more;"):
        read(tmp_path, packed)


def test_what_stands_beside_a_recording_is_left_aside(tmp_path):
    """Folders, what macOS adds, and files that are no recordings by their names."""
    beside = {"day/": b"", "__MACOSX/._run.csv": b"\0", ".DS_Store": b"\0", "photo.jpg": b"\xff"}
    assert len(read(tmp_path, archive(beside | {"day/run.csv": CSV})).rate) == 6


def test_an_archive_without_files_is_refused(tmp_path):
    with pytest.raises(InputError, match="a zip archive without a file in it"):
        read(tmp_path, archive({"day/": b""}))


@pytest.mark.parametrize("outer", WAYS)
@pytest.mark.parametrize("inner", WAYS)
def test_a_compressed_file_in_a_compressed_file_is_refused(tmp_path, outer, inner):
    with pytest.raises(InputError, match="compressed once: unpack it"):
        read(tmp_path, WAYS[outer](WAYS[inner](CSV)))


@pytest.mark.parametrize("way", WAYS)
def test_what_unpacks_to_too_much_is_refused(tmp_path, way):
    """A file of some kB that holds 300 MB; a person who states more memory has it read."""
    path = tmp_path / "run.csv.gz"
    path.write_bytes(WAYS[way](CSV + b"\n" * 300_000_000))
    with pytest.raises(InputError, match=r"more than 256 MB once it is read.*--max-memory-mb 512"):
        read_recording(path)


@pytest.mark.parametrize("way", WAYS)
def test_a_person_may_state_more_memory_or_less(tmp_path, way):
    path = tmp_path / "run.csv.gz"
    path.write_bytes(WAYS[way](CSV + b"\n" * 500_000))
    with pytest.raises(InputError, match=r"more than 0\.4 MB once it is read"):
        read_recording(path, ReadOptions(max_memory=400_000))
    assert len(read_recording(path, ReadOptions(max_memory=100_000_000)).rate) == 6


@pytest.mark.parametrize("way", WAYS)
@pytest.mark.parametrize("share", [0.3, 0.7, 0.99])
def test_a_file_that_is_cut_short_is_refused(tmp_path, way, share):
    packed = WAYS[way](CSV)
    with pytest.raises(InputError, match="file that cannot be read"):
        read(tmp_path, packed[: int(share * len(packed))])


@pytest.mark.parametrize("way", WAYS)
def test_a_broken_file_is_refused_or_read(tmp_path, way):
    assert times_refused(WAYS[way](CSV), tmp_path / "run.dat", 200) > 100


def test_an_archive_with_a_password_is_refused(tmp_path):
    """The lowest bit of a member's flags says so, in both of its headers."""
    packed = bytearray(zipped(CSV))
    with zipfile.ZipFile(io.BytesIO(packed)) as file:
        central = file.start_dir
    packed[6] |= 1
    packed[central + 8] |= 1
    with pytest.raises(InputError, match="encrypted"):
        read(tmp_path, bytes(packed))


def test_without_zstandard_the_sentence_names_the_extra(tmp_path, monkeypatch):
    monkeypatch.setitem(sys.modules, "zstandard", None)
    with pytest.raises(InputError, match=r'pip install "equipoise\[logs\]"`, or unpack it'):
        read(tmp_path, zstd(CSV), "run.csv.zst")
