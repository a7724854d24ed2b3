"""Logs of a few kilobytes that stand for gigabytes, or for ever: refused in a sentence."""

import functools
import sqlite3
from contextlib import closing
from pathlib import Path

import pytest

from equipoise.io.columns.read_options import ReadOptions
from equipoise.io.files.file_content import Content
from equipoise.io.files.reading_budget import Meter, ReadingBudget
from equipoise.io.logs.dataflash_log import messages_of
from equipoise.io.logs.log_topics import Sample, Topics
from equipoise.io.logs.ros.ros2_database import connected
from equipoise.io.logs.ulog_layout import MOST, flat_layout
from equipoise.io.logs.vectornav_log import LONGEST, Lines, lines_of
from equipoise.io.recording.recording_file import read_recording
from equipoise.model.errors import InputError
from tests.support import hostile_logs
from tests.support.flight_logs import TURNED_LINE, dataflash, flown, logged, said, terminal
from tests.support.hostile_logs import ENDLESS, TABLE, database, folders
from tests.support.peak_memory import reading_of
from tests.support.sample_logs import IMU, bag_1, bag_2, ulog

PEAK = 600  # MB: the program with its libraries, and the 256 MB that a small file may take
REMEDY = "--max-memory-mb 512 lets it take more"
OTHER_SIZE = "a chunk of another size than it says"


def refused(path: Path, **stated) -> str:
    with pytest.raises(InputError) as error:
        read_recording(path, ReadOptions(**stated))
    return str(error.value)


@pytest.mark.parametrize(
    ("made", "suffix", "wanted"),
    [
        (hostile_logs.bag_of_bz2, ".bag", REMEDY),
        (hostile_logs.bag_of_streams, ".bag", OTHER_SIZE),
        (hostile_logs.bag_of_lz4, ".bag", OTHER_SIZE),
        (hostile_logs.bag_of_indexes, ".bag", REMEDY),
        (hostile_logs.ulog_of_arrays, ".ulg", "'vehicle_attitude' (3 rows)"),
    ],
)
def test_a_log_that_makes_much_of_little_is_refused(tmp_path, made, suffix, wanted):
    path = tmp_path / f"run{suffix}"
    path.write_bytes(made())
    done = reading_of(path)
    assert wanted in done.said
    assert done.peak_mb < PEAK


# --- ROS ---------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("messages", "wanted"),
    [
        (ENDLESS, "no tables of topics and messages"),
        ("CREATE VIRTUAL TABLE messages USING fts5(topic_id);", "no tables of topics"),
        (hostile_logs.COMPUTED, "too big"),
    ],
)
def test_a_database_that_makes_rows_of_nothing_is_refused(tmp_path, messages, wanted):
    assert wanted in refused(database(tmp_path / "run.db3", messages))


def test_a_database_that_sqlite_speaks_of_in_broken_letters_is_refused(tmp_path):
    """It names what it cannot read, in the bytes that the file has there."""
    path = database(tmp_path / "run.db3", f"{TABLE} BLOB);")
    broken = path.read_bytes().replace(b"TABLE messages(", b"TABLE messages ")
    path.write_bytes(broken.replace(b"messages", b"messag\xe5s"))
    assert "a bag that cannot be read" in refused(path)


def test_a_query_without_end_is_stopped(tmp_path):
    path = database(tmp_path / "run.db3", f"{TABLE} BLOB);")
    over = Meter("log", 0, 1_000_000, -1.0)  # its time is over
    endless = "WITH RECURSIVE n(id) AS (SELECT 1 UNION ALL SELECT id + 1 FROM n) SELECT * FROM n"
    with (
        closing(connected(path, over)) as found,
        pytest.raises(sqlite3.OperationalError, match="interrupted"),
    ):
        found.execute(f"SELECT count(*) FROM ({endless})").fetchone()


FOLDERS = {
    "laughs": "references (*name)",
    "depth": "more than 20 levels",
    "pipe": "a pipe",
    "packed file": REMEDY,
    "packed message": REMEDY,
}


@functools.cache
def made_folders(place: Path) -> dict[str, Path]:
    return folders(place)


@pytest.mark.parametrize("name", FOLDERS)
def test_a_folder_that_makes_much_of_little_is_refused(tmp_path_factory, name):
    place = tmp_path_factory.getbasetemp()
    done = reading_of(made_folders(place)[name])
    assert FOLDERS[name] in done.said
    assert done.peak_mb < PEAK


def test_what_a_folder_may_take_goes_by_its_files(tmp_path):
    """The file that marks it is small; a stated memory counts for all."""
    folder = bag_2(tmp_path / "run", {"/imu": IMU})
    assert len(read_recording(folder).rate) == 4
    assert "more than 0.0001 MB" in refused(folder, max_memory=100)


def test_a_name_with_signs_of_an_address_is_a_name(tmp_path):
    """SQLite is given addresses, in which ?, # and % mean something."""
    folder = bag_2(tmp_path / "run", {"/imu": IMU})
    moved = next(folder.glob("*.db3")).rename(tmp_path / "a?b#c%41.db3")
    assert len(read_recording(moved).rate) == 4


@pytest.mark.parametrize("broken", ["data = x'00010000ff'", "timestamp = -1, data = x'00'"])
def test_a_message_of_a_bag_that_makes_no_sense_is_left_out(tmp_path, broken):
    path = next(bag_2(tmp_path / "run", {"/imu": IMU}).glob("*.db3"))
    with closing(sqlite3.connect(path)) as database, database:
        database.execute(f"UPDATE messages SET {broken} WHERE rowid = 2")
    found = read_recording(path)
    assert len(found.rate) == 3
    assert "1 messages made no sense, or had an impossible time; left out." in found.notes


def test_a_type_of_ros_1_that_only_has_a_known_name_is_left_aside(tmp_path):
    """A bag says what its types are by their digests; ours are not those."""
    path = bag_1(tmp_path / "run.bag", {"/imu": IMU})
    digest = hostile_logs.MD5.encode()
    path.write_bytes(path.read_bytes().replace(digest, digest[::-1]))
    assert f"its topics: '/imu' ({IMU}, 4 rows)" in refused(path)


def test_frames_without_number_are_counted():
    """Each child frame of a tree is a source, with arrays of its own."""
    topics, samples = (
        Topics(ReadingBudget(20_000_000).of("log", 0)),
        [Sample(1, {}, part=str(k)) for k in range(100_000)],
    )
    with pytest.raises(InputError, match="--max-memory-mb 40 lets"):
        topics.add("/tf", "tf2_msgs/msg/TFMessage", 1, samples)


# --- Flight controllers ------------------------------------------------------------------------


def test_columns_of_a_layout_are_bounded():
    """As many as there may be are there; one more, and there are none."""
    layouts = {"a": "b[64] x;", "b": "uint8_t[64] y;"}
    assert len(flat_layout(layouts, "a")) == MOST == 64 * 64
    assert flat_layout(layouts | {"a": "b[64] x;uint8_t z;"}, "a") == ()
    assert flat_layout({"a": "a[60000] x;"}, "a") == ()


def test_instruments_numbered_by_fractions_are_one(tmp_path):
    """Else each row is an instrument, and each is sought among all rows."""
    path = tmp_path / "run.bin"
    path.write_bytes(hostile_logs.dataflash_of_instances(500))
    observed = read_recording(path)
    assert len(observed.rate) == 500
    assert not any("instance" in note for note in observed.notes)


def test_rows_that_nobody_reads_are_counted_and_not_kept():
    found = messages_of(Content.of(dataflash(*[logged("BARO", 1, 2, 3)] * 9), "log"))
    assert (found.counts[8], found.rows) == (9, {})


@pytest.mark.parametrize(
    ("name", "content"),
    [
        ("run.ulg", ulog("sensor_combined")),
        ("run.bin", dataflash(*[logged("XKQ", 10_000 * k, 0, 1, 0, 0, 0) for k in range(9)])),
        ("run.tlog", flown("turned", count=9)),
        ("run.log", terminal("VNQMR", count=9).encode()),
    ],
)
def test_rows_of_every_log_are_counted(tmp_path, name, content):
    """Nine rows take more than a kilobyte, and less than fifty."""
    path = tmp_path / name
    path.write_bytes(content)
    assert len(read_recording(path, ReadOptions(max_memory=50_000)).attitude) > 4
    assert "more than 0.001 MB once it is read" in refused(path, max_memory=1000)


# --- Terminals ---------------------------------------------------------------------------------


@pytest.mark.parametrize("end", ["\r", "\n", "\r\n"])
def test_lines_are_the_same_however_they_end(end):
    """Of a text longer than a block, so that an end may be cut in two."""
    texts = [f"{k}{'x' * (k % 700)}" for k in range(5000)]
    found = [line.strip() for line in lines_of(Content.of(end.join(texts).encode(), "log"))]
    assert [line for line in found if line] == [each.encode() for each in texts]


def test_a_line_without_end_is_never_kept_whole():
    content = Content.of(b"x" * 5_000_000 + b"end", "log")
    (line,) = lines_of(content)
    assert line == b"x" * (LONGEST - 3) + b"end"


def test_a_log_of_many_days_is_put_in_order():
    """The terminal's clock restarts each midnight, a thousand times."""
    lines = Lines(ReadingBudget().of("log", 0))
    for day in range(1000):
        for hour in (0, 8, 16):
            lines.take(f"{hour:02d}:00:01 {said(TURNED_LINE)}".encode())
            assert lines.times["VNQMR"][-1] == day * 86_400 + hour * 3600 + 1
