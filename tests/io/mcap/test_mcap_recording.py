"""MCAP both ways; a cut or garbled file gives what is whole, and never a wrong number."""

import contextlib
import functools
import io
import json
import os
import struct
import tempfile
from pathlib import Path

import foxglove
import numpy as np
import pytest
from foxglove.channels import FrameTransformChannel, PoseInFrameChannel
from foxglove.messages import FrameTransform, Pose, PoseInFrame, Quaternion, Timestamp, Vector3
from hypothesis import given, settings
from hypothesis import strategies as st
from mcap.writer import Writer

from equipoise.io.files.file_content import Content
from equipoise.io.mcap.live_recording import LiveRecording, Opening
from equipoise.io.mcap.mcap_salvage import salvaged
from equipoise.io.mcap.protobuf_fields import double, fields, whole
from equipoise.io.recording.recording_file import read_recording, write_recording
from equipoise.model.errors import InputError
from equipoise.model.recording import CHANNELS, Recording, Samples
from tests.support import thorough
from tests.support.recorded_events import events_of

EXAMPLES = int(os.environ.get("EQUIPOISE_FUZZ", thorough.count(300, 90)))


def record(chunks: int = 6, each: int = 4) -> Recording:
    """Rows at 10 Hz whose numbers follow from their times."""
    t = np.arange(chunks * each) / 10
    q = np.stack([np.cos(t / 9), np.sin(t / 9), 0 * t, 0 * t], axis=1)
    return Recording(Samples(t, q), Samples(t, np.stack([t, 1 - t, t / 7], axis=1)))


def part(whole_record: Recording, rows: slice) -> Recording:
    return Recording(
        *(Samples(c.t[rows], c.values[rows]) for c in (whole_record.attitude, whole_record.rate))
    )


@functools.cache
def written() -> bytes:
    """A file of six chunks of four rows of each sensor and one event: 60 messages."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "run.mcap"
        with LiveRecording(path, Opening(zero_ns=10**18, testbed="name = 'x'\n")) as file:
            for k in range(6):
                file.rows(part(record(), slice(4 * k, 4 * k + 4)))
                file.event(k / 10, "note", f"chunk {k}", {"k": k})
        return path.read_bytes()


def read_bytes_as(content: bytes, folder) -> Recording:
    path = folder / "cut.mcap"
    path.write_bytes(content)
    return read_recording(path)


def assert_part_of(observed: Recording, wanted: Recording) -> None:
    """Every row that is there is one of those that were written, to the last bit."""
    for name in ("attitude", "rate"):
        ours, theirs = getattr(observed, name), getattr(wanted, name)
        if ours is None:
            continue
        at = np.searchsorted(theirs.t, ours.t - 1e-12)
        np.testing.assert_array_equal(ours.t, theirs.t[at])
        np.testing.assert_array_equal(ours.values, theirs.values[at])


def test_times_and_values_come_back_to_the_last_bit(tmp_path):
    """Times of nine decimals, before zero too; numbers that have no short decimals."""
    rng = np.random.default_rng(4)
    t = np.array([-2.000000001, -0.1, 0.3, 100.005, 12345.678901234, 9.7e6 + 0.25])
    values = rng.normal(size=(6, 3)) * 10.0 ** rng.integers(-12, 3, size=(6, 3))
    first = Recording(
        rate=Samples(t, values),
        mass_names=("x1", "z 2"), masses=Samples(t[:4], values[:4, :2]),
        device_names=("wheel:x", "gimbal:a"), devices=Samples(t, values[:, 1:]),
        momentum=Samples(t, values * 2), torque=Samples(t, values * 3), field=Samples(t, -values),
        temperature=Samples(t[:3], values[:3, :1]), lamp=Samples(t[:2], values[:2, :1]),
        accelerometer=Samples(t, values * 4), sun=Samples(t[1:], values[1:]),
        position=Samples(t, values[:, :2] * 5),
        cause_names=("total_z", "total_sd_z"), torque_by_cause=Samples(t[2:], values[2:, 1:]),
    )  # fmt: skip
    write_recording(first, tmp_path / "run.mcap")
    again = read_recording(tmp_path / "run.mcap")
    assert again.mass_names == first.mass_names
    assert again.device_names == first.device_names
    assert again.cause_names == first.cause_names
    for name in CHANNELS[1:]:
        np.testing.assert_array_equal(getattr(again, name).t, getattr(first, name).t)
        np.testing.assert_array_equal(getattr(again, name).values, getattr(first, name).values)


def test_a_time_of_many_decimals_comes_back_to_the_nanosecond(tmp_path):
    t = np.array([1 / 3, 2 / 3, 1e5 + 1 / 7])
    write_recording(Recording(rate=Samples(t, np.ones((3, 3)))), tmp_path / "run.mcap")
    again = read_recording(tmp_path / "run.mcap")
    np.testing.assert_array_equal(again.rate.t, [0.333333333, 0.666666667, 100000.142857143])


def test_a_file_cut_anywhere_gives_what_is_before_the_cut(tmp_path):
    """More bytes never give fewer rows; a cut every few bytes, fewer in the index behind."""
    content, before, step = written(), 0, thorough.count(3, 8)
    data = content.rindex(b"\x0f\x04" + bytes(7))
    for end in (*range(0, data, step), *range(data, len(content), 27), len(content)):
        found = salvaged(Content.of(content[:end], "log"), "cut")
        assert found.count >= before
        assert found.whole == (end == len(content))
        before = found.count
    assert before == 6 * (4 + 4 + 2)
    for end in range(0, len(content), 211):
        try:
            assert_part_of(read_bytes_as(content[:end], tmp_path), record())
        except InputError:
            assert salvaged(Content.of(content[:end], "log"), "cut").count < 30


@settings(max_examples=EXAMPLES // 3, deadline=None)
@given(place=st.floats(0, 1, exclude_max=True), junk=st.binary(min_size=1, max_size=40))
def test_a_garbled_place_costs_two_chunks_at_most(place, junk):
    """Nothing wrong comes out; of what the junk may touch, a chunk or two, all else does."""
    content = written()
    at = int(place * len(content))
    garbled = content[:at] + junk + content[at + len(junk) :]
    assert salvaged(Content.of(garbled, "log"), "garbled").count >= 60 - 2 * 10
    with tempfile.TemporaryDirectory() as folder:
        in_the_start = at < content.index(b"zstd")  # where the zero of time stands
        with contextlib.suppress(*[InputError] * in_the_start):
            assert_part_of(read_bytes_as(garbled, Path(folder)), record())


def test_a_garbled_chunk_is_reported_with_the_number_of_lost_messages(tmp_path):
    """The third chunk holds 4 + 4 rows; the summary at the end says how many there were."""
    file_bytes = written()
    spots = [k for k in range(len(file_bytes)) if file_bytes.startswith(b"\x04\0\0\0zstd", k)]
    at = spots[2] + 60
    garbled = file_bytes[:at] + bytes(20) + file_bytes[at + 20 :]
    found = salvaged(Content.of(garbled, "log"), "garbled")
    assert (found.ended, found.whole, found.lost_places) == (True, False, 1)
    assert found.lost_messages == 60 - found.count == 10
    note = " ".join(read_bytes_as(garbled, tmp_path).notes)
    assert "10 messages are known to be lost" in note
    assert len(events_of(tmp_path / "cut.mcap")) == 5


# --- Other programs' files ---------------------------------------------------------------------

TURN = (0.5, 0.1, 0.2, np.sqrt(1 - 0.25 - 0.01 - 0.04))  # w x y z


def foxglove_file(path, channel_type, made) -> None:
    context = foxglove.Context()
    with foxglove.open_mcap(path, context=context):
        channel = channel_type("/platform", context=context)
        for k in range(4):
            channel.log(made(Timestamp(1_700_000_000 + k, 500_000_000)), log_time=7)


def turn() -> Quaternion:
    w, x, y, z = TURN
    return Quaternion(x=x, y=y, z=z, w=w)


@pytest.mark.parametrize("kind", ["FrameTransform", "PoseInFrame"])
def test_attitudes_of_other_programs_are_read(tmp_path, kind):
    """Written by Foxglove's own library; the stamps count, not the log's times."""
    made = {
        "FrameTransform": lambda stamp: FrameTransform(
            timestamp=stamp, translation=Vector3(x=1.0, y=2.0, z=3.0), rotation=turn()
        ),
        "PoseInFrame": lambda stamp: PoseInFrame(timestamp=stamp, pose=Pose(orientation=turn())),
    }[kind]
    channel = {"FrameTransform": FrameTransformChannel, "PoseInFrame": PoseInFrameChannel}[kind]
    foxglove_file(tmp_path / "run.mcap", channel, made)
    observed = read_recording(tmp_path / "run.mcap")
    np.testing.assert_array_equal(observed.attitude.t, [0.0, 1.0, 2.0, 3.0])
    np.testing.assert_allclose(observed.attitude.values, [TURN] * 4, atol=1e-15)
    assert "taken from topic '/platform'" in " ".join(observed.notes)


def imu(sec: int, rate: tuple[float, float, float], known: bool = True) -> bytes:
    """A sensor_msgs/Imu in CDR, little end first, as the public layout has it: each double at a
    multiple of eight after the header of four bytes."""
    body = struct.pack("<iI", sec, 250_000_000) + struct.pack("<I", 4) + b"imu\0"
    body += bytes(-len(body) % 8)
    w, x, y, z = TURN
    body += struct.pack("<4d", x, y, z, w) + struct.pack("<9d", *([0.0 if known else -1.0] * 9))
    body += struct.pack("<3d", *rate) + bytes(72) + bytes(24) + bytes(72)
    return b"\0\1\0\0" + body


def imu_file(topics: tuple[str, ...], known: bool = True) -> bytes:
    stream = io.BytesIO()
    writer = Writer(stream)
    writer.start(profile="ros2")
    schema = writer.register_schema("sensor_msgs/msg/Imu", "ros2msg", b"")
    for topic in topics:
        channel = writer.register_channel(topic, "cdr", schema)
        for k in range(3):
            data = imu(1_700_000_000 + k, (0.1 * k, 0.2, -0.3), known)
            writer.add_message(channel, log_time=9, data=data, publish_time=9)
    writer.finish()
    return stream.getvalue()


def test_an_inertial_unit_of_ros_2_gives_rate_and_attitude(tmp_path):
    observed = read_bytes_as(imu_file(("/imu",)), tmp_path)
    np.testing.assert_array_equal(observed.rate.t, [0, 1, 2])
    np.testing.assert_array_equal(observed.rate.values[:, 0], [0.0, 0.1, 0.2])
    np.testing.assert_allclose(observed.attitude.values, [TURN] * 3, atol=1e-15)


def test_an_attitude_that_the_unit_says_it_has_not_is_none(tmp_path):
    """REP 145: -1 in front of the covariance."""
    assert read_bytes_as(imu_file(("/imu",), known=False), tmp_path).attitude is None


def test_two_topics_of_a_type_are_listed(tmp_path):
    with pytest.raises(
        InputError, match=r"2 topics of sensor_msgs/msg/Imu: /a \(3 rows\), /b \(3 rows\).*--topic"
    ):
        read_bytes_as(imu_file(("/b", "/a")), tmp_path)


def test_attitudes_in_json_are_read(tmp_path):
    stream = io.BytesIO()
    writer = Writer(stream)
    writer.start()
    schema = writer.register_schema("foxglove.PoseInFrame", "jsonschema", b"{}")
    channel = writer.register_channel("/pose", "json", schema)
    for k in range(3):
        reported = {
            "timestamp": {"sec": k, "nsec": 5},
            "pose": {"orientation": dict(zip("wxyz", TURN, strict=True))},
        }
        writer.add_message(channel, log_time=1, data=json.dumps(reported).encode(), publish_time=1)
    writer.finish()
    observed = read_bytes_as(stream.getvalue(), tmp_path)
    np.testing.assert_array_equal(observed.attitude.t, [0, 1, 2])


def test_protobuf_by_hand():
    """Field 1 varint 300 (ac 02), field 2 the double 1.0, field 3 the bytes 'hi'."""
    data = bytes.fromhex("08ac0211000000000000f03f1a026869")
    found = fields(data)
    assert (whole(found, 1), double(found, 2), found[3]) == (300, 1.0, b"hi")
    with pytest.raises(ValueError, match="beyond"):
        fields(data[:-1])
