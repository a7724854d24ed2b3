"""A live recording survives a kill and a full disk, and says what it holds."""

import errno
import json
import os
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import numpy as np
import pytest
from mcap.reader import make_reader

from equipoise import __version__
from equipoise.io.mcap.live_recording import EVERY, LiveRecording, Opening, RecordingStopped
from equipoise.io.recording.recording_file import read_recording
from equipoise.model.errors import InputError
from equipoise.model.recording import Recording, Samples
from tests.support import thorough
from tests.support.recorded_events import events_of
from verification.killed_recordings import LOSS, killed

NOON = 1_750_000_000_123_456_789  # ns since 1970
OPENING = Opening(zero_ns=NOON, testbed='name = "mine"\n', drivers={"imu": "xsens", "deck": "grbl"})


def rows(start: int, count: int, names: tuple[str, ...] = ("x1", "y1")) -> Recording:
    """Rows at 100 Hz; every number follows from its time."""
    t = np.arange(start, start + count) / 100
    q = np.stack([np.cos(t / 9), np.sin(t / 9), 0 * t, 0 * t], axis=1)
    masses = Samples(t, np.stack([t / 3] * len(names), axis=1))
    return Recording(Samples(t, q), Samples(t, np.stack([t, -t, t / 7], axis=1)), names, masses)


def test_a_killed_recording_loses_less_than_a_second():
    """Rows, each with its own numbers, up to one second before the kill; events to the last.

    A few programs killed at random moments; 200 in ``verification``.
    """
    programs = thorough.count(6, 3)
    with ThreadPoolExecutor(3) as pool:
        runs = list(pool.map(killed, range(programs)))
    assert min(run.rows for run in runs) > 50
    assert max(run.lost for run in runs) < LOSS
    assert [run.missing for run in runs] == [0] * programs
    assert [run.events_lost for run in runs] == [0] * programs


def test_an_event_is_in_the_file_at_once(tmp_path):
    """Read while the recording goes on, and nobody has flushed it."""
    path = tmp_path / "run.mcap"
    with LiveRecording(path, OPENING) as file:
        file.rows(rows(0, 10))
        file.event(0.125, "interlock", "Tilt 31 deg; stopped.", {"tilt_deg": 31.0, "of": ["x1"]})
        (event,) = events_of(path)
        observed = read_recording(path)
    assert (event.t, event.kind, event.sentence) == (0.125, "interlock", "Tilt 31 deg; stopped.")
    assert event.data == {"tilt_deg": 31.0, "of": ["x1"]}
    assert observed.rate is not None
    assert len(observed.rate) == 10
    assert "no end" in " ".join(observed.notes)


def test_a_torque_that_is_fed_forward_is_recorded_beside_the_rows(tmp_path):
    """In a topic of its own, no event among those for people; it ends no chunk early."""
    path = tmp_path / "run.mcap"
    with LiveRecording(path, OPENING) as file:
        file.rows(rows(0, 1))
        file.event(0.0, "gravity_torque", "", {"torque_N_m": [0.0, 0.0, 0.0]})  # opens the topic
        size = path.stat().st_size
        for k in range(1, 4):
            file.rows(rows(k, 1))
            file.event(k / 100, "gravity_torque", "", {"torque_N_m": [k * 1e-4, 0.0, -1e-5]})
        assert path.stat().st_size == size
    with path.open("rb") as stream:
        found = [
            (message.log_time - NOON, json.loads(message.data)["torque_N_m"])
            for _, _, message in make_reader(stream).iter_messages(topics="/gravity_torque")
        ]
    expected = [(k * 10_000_000, [k * 1e-4, 0.0, -1e-5 if k else 0.0]) for k in range(4)]
    assert found == expected
    assert events_of(path) == ()
    assert len(read_recording(path).rate) == 4


def test_rows_are_in_the_file_after_half_a_second(tmp_path):
    """Not at a turn before, so that chunks are not of one row."""
    path = tmp_path / "run.mcap"
    with LiveRecording(path, OPENING) as file:
        file.rows(rows(0, 1))  # topics stand in the file from when they are opened
        file.turn(0.0)
        size = path.stat().st_size
        file.rows(rows(1, 9))
        file.turn(EVERY - 0.01)
        assert path.stat().st_size == size
        file.turn(EVERY)
        assert len(read_recording(path).rate) == 10


def test_a_whole_file_is_read_by_others_and_says_what_it_is(tmp_path):
    """By mcap's own indexed reader: topics, schemas, times on the world's clock, what it is of."""
    path = tmp_path / "run.mcap"
    with LiveRecording(path, OPENING) as file:
        file.rows(rows(0, 5))
        file.event(0.5, "command", "x1 to 3 mm", {"x1": 0.003})
    with path.open("rb") as stream:
        reader = make_reader(stream, validate_crcs=True)
        summary = reader.get_summary()
        schemas = {
            c.topic: (summary.schemas[c.schema_id].name, c.message_encoding)
            for c in summary.channels.values()
        }
        first = next(reader.iter_messages(topics="/rate"))[2]
        (metadata,) = reader.iter_metadata()
        (attachment,) = reader.iter_attachments()
    assert schemas["/attitude"] == ("foxglove.FrameTransform", "protobuf")
    assert schemas["/log"] == ("foxglove.Log", "protobuf")
    assert schemas["/masses"] == ("equipoise.masses", "json")
    assert first.log_time == NOON
    stamp = b'{"timestamp": {"sec": %d, "nsec": %d}, ' % (NOON // 10**9, NOON % 10**9)
    assert first.data == stamp + b'"x_rad_s": 0.0, "y_rad_s": -0.0, "z_rad_s": 0.0}'
    assert metadata.metadata["equipoise"] == __version__
    assert metadata.metadata["driver imu"] == "xsens"
    assert metadata.metadata["start_utc"].startswith("2025-06-15T15:06:40.123456")
    assert attachment.data.decode() == OPENING.testbed


def test_a_record_is_never_written_over(tmp_path):
    path = tmp_path / "run.mcap"
    path.write_bytes(b"precious")
    with pytest.raises(InputError, match="a file that exists"):
        LiveRecording(path, OPENING)
    assert path.read_bytes() == b"precious"


def test_masses_that_change_their_names_are_refused(tmp_path):
    with LiveRecording(tmp_path / "run.mcap", OPENING) as file:
        file.rows(rows(0, 5))
        with pytest.raises(InputError, match="masses called a, b"):
            file.rows(rows(5, 5, ("a", "b")))


FULL = """
import resource, signal, sys
from tests.io.mcap.test_live_recording import OPENING, LiveRecording, RecordingStopped, rows
signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
resource.setrlimit(resource.RLIMIT_FSIZE, (30_000, 30_000))
file = LiveRecording(sys.argv[1], OPENING)
for k in range(0, 100_000, 10):
    try:
        file.rows(rows(k, 10))
        file.turn(k / 100)
    except RecordingStopped as error:
        print(error)
        break
for again in (lambda: file.rows(rows(k, 10)), lambda: file.event(9.0, "note", "", {}),
              lambda: file.turn(1e6), file.close):
    try:
        again()
    except RecordingStopped:
        print("stopped")
"""


def test_a_full_disk_stops_with_one_sentence_and_an_intact_file(tmp_path):
    """A file that may not grow beyond 30 kB, in a process of its own."""
    path = tmp_path / "run.mcap"
    root = Path(__file__).parents[3]
    done = subprocess.run(
        [sys.executable, "-c", FULL, str(path)],
        capture_output=True,
        text=True,
        cwd=root,
        check=True,
    )
    sentence, *again = done.stdout.splitlines()
    assert again == ["stopped"] * 4  # rows, event, turn, close
    assert sentence.startswith(f"{path}: recording stopped ({os.strerror(errno.EFBIG)})")
    observed = read_recording(path)
    wanted = rows(0, len(observed.rate))
    assert len(observed.rate) > 100
    kept_by = float(sentence.partition("what had come by ")[2].partition(" s is kept")[0])
    assert kept_by <= observed.rate.t[-1] < kept_by + 0.1  # s: ten rows came at that time
    np.testing.assert_array_equal(observed.rate.values, wanted.rate.values)
    np.testing.assert_array_equal(observed.attitude.values, wanted.attitude.values)
    assert 20_000 < path.stat().st_size <= 30_000


def test_no_space_at_all_is_the_same_error():
    """/dev/full answers every write with ENOSPC."""
    with pytest.raises(RecordingStopped, match=os.strerror(errno.ENOSPC)) as caught:
        LiveRecording("/dev/full", OPENING)
    assert "no row is kept" in str(caught.value)
