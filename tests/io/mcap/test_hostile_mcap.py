"""MCAP files that make much of little, honest ones that are long, and what each of them costs."""

import io
import json
import tracemalloc

import numpy as np
import pytest

from equipoise.io.columns.read_options import ReadOptions
from equipoise.io.files.broken_bytes import as_broken
from equipoise.io.files.file_content import Content
from equipoise.io.files.reading_budget import ReadingBudget
from equipoise.io.mcap.mcap_repair import repair
from equipoise.io.mcap.mcap_salvage import nothing, salvaged
from equipoise.io.recording.recording_file import read_recording
from equipoise.model.errors import InputError
from tests.support import hostile_logs
from tests.support.hostile_logs import (
    POSE,
    cdr_of_a_long_tree,
    channel,
    chunk,
    logged,
    mcap,
    named_pairs,
    pose,
    poses,
    tree_of,
)
from tests.support.peak_memory import reading_of

PEAK = 600  # MB: the program with its libraries, and the 256 MB that a small file may take
REMEDY = "--max-memory-mb 512 lets it take more"
PICTURES = channel(2, "/camera", "foxglove.RawImage", "protobuf")


class Counting(io.BytesIO):
    """Bytes that count how many of them are read."""

    count = 0

    def read(self, size: int | None = -1, /) -> bytes:
        found = super().read(size)
        self.count += len(found)
        return found


def read_in(content: bytes) -> int:
    """Return how many bytes are read of a file in one walk."""
    file = Counting(content)
    salvaged(Content(file, len(content), ReadingBudget().of("log", len(content))), "log", nothing)
    return file.count


def picture(k: int) -> bytes:
    """A message of half a megabyte that no packer makes smaller."""
    return logged(2, k, np.random.default_rng(k).bytes(500_000))


def filmed(count: int) -> bytes:
    """A file of attitudes, each with a picture in the same chunk, unpacked."""
    pairs = (logged(1, k, pose(k)) + picture(k) for k in range(count))
    return mcap(POSE + PICTURES, *(chunk(pair, len(pair), "") for pair in pairs))


@pytest.mark.parametrize(
    "made",
    [
        hostile_logs.mcap_of_messages,
        hostile_logs.mcap_of_chunks,
        hostile_logs.mcap_that_lies,
        hostile_logs.mcap_of_lz4,
        hostile_logs.mcap_of_places,
        hostile_logs.mcap_of_columns,
    ],
)
def test_a_file_that_makes_much_of_little_is_refused(tmp_path, made):
    path = tmp_path / "run.mcap"
    path.write_bytes(made())
    done = reading_of(path)
    assert REMEDY in done.said
    assert done.peak_mb < PEAK


# --- Work --------------------------------------------------------------------------------------


def test_a_long_file_without_chunks_is_read_in_one_go():
    """Twice as long, twice the bytes; a block more than the file at most."""
    short, long = poses(10_000), poses(20_000)
    assert read_in(short) < len(short) + 2_000_000
    assert read_in(long) < len(long) + 2_000_000
    found = salvaged(Content.of(long, "log"), "log", nothing)
    assert (found.whole, found.count) == (True, 20_000)


def test_a_garbled_file_is_read_in_few_goes():
    """Every tenth message has lost its length, and the one before it what makes it sure."""
    parts = [logged(1, k, pose(k)) for k in range(20_000)]
    parts[::10] = [each[:1] + b"\xff" * 8 + each[9:] for each in parts[::10]]
    content = mcap(POSE, *parts)
    assert read_in(content) < 4 * len(content)
    found = salvaged(Content.of(content, "log"), "log", nothing)
    assert (found.count, found.lost_places) == (20_000 - 2000 - 1999, 2000)


def test_places_that_seem_to_be_records_are_counted():
    """Each of them says that it is as long as a block, and none is."""
    places = (b"\x03\xf0\xff\x0f" + bytes(5) + b"\xff" * 91) * 10_000
    content = Content.of(b"\x89MCAP0\r\n" + b"\xff" + places + bytes(1_100_000), "log")
    with pytest.raises(InputError, match="unpacked, or tried in vain"):
        salvaged(content, "log")


# --- Memory ------------------------------------------------------------------------------------


def test_pictures_are_counted_and_not_kept(tmp_path):
    """A file of 10 MB, of which 2 MB may be in memory."""
    path = tmp_path / "run.mcap"
    path.write_bytes(filmed(20))
    read = read_recording(path, ReadOptions(max_memory=2_000_000))
    assert len(read.attitude) == 20
    listed = salvaged(Content.of(path.read_bytes(), "log"), "log", nothing)
    assert (listed.counted(1), listed.counted(2)) == (20, 20)
    assert list(listed.messages) == []


def test_messages_whose_channel_stands_behind_them_are_read(tmp_path):
    """As where the start is garbled: the summary at the end says what they are."""
    path = tmp_path / "run.mcap"
    path.write_bytes(mcap(*(logged(1, k, pose(k)) for k in range(4)), POSE))
    assert len(read_recording(path).attitude) == 4


def test_a_long_recording_is_repaired_in_little_memory(tmp_path):
    """Of 15 MB without an end never more than a few chunks are in memory."""
    path, out = tmp_path / "run.mcap", tmp_path / "out.mcap"
    path.write_bytes(filmed(30)[:-40])
    repair(path, out)
    tracemalloc.start()
    try:
        done = repair(path, out)
        _, peak = tracemalloc.get_traced_memory()
    finally:
        tracemalloc.stop()
    assert done.found.count == 60
    assert peak < 9_000_000
    assert read_recording(out).attitude.t.tolist() == read_recording(path).attitude.t.tolist()


def test_a_repair_that_takes_too_much_leaves_no_file(tmp_path):
    path, out = tmp_path / "run.mcap", tmp_path / "out.mcap"
    path.write_bytes(hostile_logs.mcap_that_lies())
    with pytest.raises(InputError, match=REMEDY):
        repair(path, out)
    assert [each.name for each in tmp_path.iterdir()] == ["run.mcap"]


# --- Depth -------------------------------------------------------------------------------------

DEEP = "[" * 100_000
LEFT_OUT = "1 messages made no sense, or had an impossible time; left out."
RATE = b'{"x_rad_s": 0.5, "y_rad_s": 0, "z_rad_s": 0}'


def ours(names: str, first: bytes = RATE, zero: str = "0") -> bytes:
    """A file of ours of four rates, the first of them as given, and an event."""
    said = {"equipoise.channel": "rate", "equipoise.names": names}
    return mcap(
        named_pairs("equipoise", zero_ns=zero),
        channel(1, "/rate", "equipoise.rate", "json", **said),
        channel(2, "/masses", "equipoise.masses", "json", **said),
        channel(3, "/events", "equipoise.event", "json"),
        logged(3, 0, DEEP.encode()),
        logged(2, 0, b"{}"),
        logged(1, 1, first),
        *(logged(1, 10_000_000 * k, RATE) for k in range(1, 5)),
    )


@pytest.mark.parametrize("names", [DEEP, "7", "null", '"ab"', "[" + "9" * 5000 + "]", "{"])
def test_names_that_are_none_are_left_out(tmp_path, names):
    (tmp_path / "run.mcap").write_bytes(ours(names))
    assert len(read_recording(tmp_path / "run.mcap").rate) == 5


@pytest.mark.parametrize(
    "first",
    [
        DEEP.encode(),
        b'{"a":' * 100_000,
        json.dumps({"x_rad_s": 10**400, "y_rad_s": 0, "z_rad_s": 0}).encode(),
        b'{"x_rad_s": ' + b"9" * 5000 + b"}",
        b"\xff\xfe",
        b"[]",
    ],
)
def test_a_message_that_holds_no_numbers_is_left_out(tmp_path, first):
    (tmp_path / "run.mcap").write_bytes(ours("[]", first))
    found = read_recording(tmp_path / "run.mcap")
    assert len(found.rate) == 4
    assert LEFT_OUT in found.notes


@pytest.mark.parametrize("zero", ["9" * 5000, "\u0663", "-1", "1e3", ""])
def test_a_zero_of_time_that_is_no_number_is_not_taken(tmp_path, zero):
    """The first row is then."""
    (tmp_path / "run.mcap").write_bytes(ours("[]", zero=zero))
    assert read_recording(tmp_path / "run.mcap").rate.t[0] == 1e-9


@pytest.mark.parametrize("data", [cdr_of_a_long_tree(), b"\0\1\0\0" + b"\xff" * 80, b""])
def test_lengths_of_a_message_that_do_not_fit_it_leave_it_out(tmp_path, data):
    (tmp_path / "run.mcap").write_bytes(tree_of(data))
    found = read_recording(tmp_path / "run.mcap")
    assert len(found.rate) == 4
    assert LEFT_OUT in found.notes


@pytest.mark.parametrize("error", [RecursionError("deep"), MemoryError(), OverflowError("int")])
def test_whatever_a_parser_raises_is_one_sentence(error):
    with (
        pytest.raises(InputError, match="a log that cannot be read"),
        as_broken("a.bin", "log", "another"),
    ):
        raise error


def test_who_stops_the_program_stops_it():
    with pytest.raises(KeyboardInterrupt), as_broken("a.bin", "log", "another"):
        raise KeyboardInterrupt
