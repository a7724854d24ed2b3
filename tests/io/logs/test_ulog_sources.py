"""Topics and instances of PX4's logs, written by hand from their public description."""

import struct
from math import cos, radians, sin

import numpy as np
import pytest

from equipoise.io.columns.read_options import ReadOptions
from equipoise.io.recording.recording_file import read_recording
from equipoise.model.errors import InputError
from tests.support.sample_logs import reported

TIMED = "uint64_t timestamp;uint64_t timestamp_sample;"
TURN, ODOMETRY = "float[4] q;", "uint8_t pose_frame;float[3] position;float[4] q;"
GYRO = "uint32_t device_id;float x;float y;float z;float temperature;"
# What stands behind the times: its layout, its bytes, and what is in front of the numbers.
ROWS = {
    "vehicle_attitude": (TURN, "4f", ()),
    "vehicle_attitude_groundtruth": (TURN, "4f", ()),
    "vehicle_visual_odometry": (ODOMETRY, "B7f", (1, 0.0, 0.0, 0.0)),
    "vehicle_odometry": (ODOMETRY, "B7f", (1, 0.0, 0.0, 0.0)),
    "sensor_gyro": (GYRO, "I3f4x", (77,)),
    "battery_status": ("float voltage_v;", "f", ()),
}
HALF = radians(30) / 2
PITCHED = (cos(HALF), 0.0, sin(HALF), 0.0)  # 30 deg about y, the right: nose up


def log(*subscribed: tuple[str, int, tuple[float, ...], int]) -> bytes:
    """Return a log of topics: name, instance, the numbers of every row, how many rows."""
    out = b"ULog\x01\x12\x35\x01" + struct.pack("<Q", 0) + reported(b"B", bytes(40))
    for name in dict.fromkeys(name for name, *_ in subscribed):
        out += reported(b"F", f"{name}:{TIMED}{ROWS[name][0]}".encode())
    for number, (name, instance, _, _) in enumerate(subscribed):
        out += reported(b"A", struct.pack("<BH", instance, number) + name.encode())
    for number, (name, _, values, rows) in enumerate(subscribed):
        _, codes, front = ROWS[name]
        for us in range(3_000_000, 3_000_000 + 10_000 * rows, 10_000):
            row = struct.pack(f"<HQQ{codes}", number, us + 500, us, *front, *values)
            out += reported(b"D", row)
    return out


def read(tmp_path, content, *topics, instance=None):
    (tmp_path / "run.ulg").write_bytes(content)
    return read_recording(tmp_path / "run.ulg", ReadOptions(topics=topics, instance=instance))


GYROS = (
    ("sensor_gyro", 0, (0.1, 0.2, 0.3), 4),
    ("sensor_gyro", 1, (0.4, 0.5, 0.6), 5),
    ("sensor_gyro", 2, (0.7, 0.8, 0.9), 0),
)


@pytest.mark.parametrize(
    "topic", ["vehicle_attitude_groundtruth", "vehicle_visual_odometry", "vehicle_odometry"]
)
def test_attitudes_of_other_topics_are_read(tmp_path, topic):
    """Nose up by 30 deg about the right is -30 deg about the left."""
    observed = read(tmp_path, log((topic, 0, PITCHED, 4), GYROS[0]))
    np.testing.assert_allclose(observed.attitude.t, 0.01 * np.arange(4), atol=1e-12)
    wanted = [cos(HALF), 0, -sin(HALF), 0]
    np.testing.assert_allclose(np.abs(observed.attitude.values @ wanted), 1, atol=1e-6)
    np.testing.assert_allclose(observed.rate.values, [(0.1, -0.2, -0.3)] * 4, atol=1e-7)
    assert f"attitude: taken from topic '{topic}'." in observed.notes


def test_the_estimate_goes_before_the_truth_unless_it_is_stated(tmp_path):
    level = ("vehicle_attitude", 0, (1.0, 0.0, 0.0, 0.0), 4)
    content = log(level, ("vehicle_attitude_groundtruth", 0, PITCHED, 4), GYROS[0])
    observed = read(tmp_path, content)
    assert "attitude: taken from topic 'vehicle_attitude'." in observed.notes
    assert "Topics ignored: 'vehicle_attitude_groundtruth' (4 rows)." in observed.notes
    stated = read(tmp_path, content, "vehicle_attitude_groundtruth")
    np.testing.assert_allclose(stated.attitude.values[0, 2], -sin(HALF), atol=1e-6)
    assert stated.rate is None


def test_a_topic_that_is_all_nan_is_none(tmp_path):
    """PX4 writes NaN for an attitude that nobody gave."""
    nan = ("vehicle_attitude", 0, (np.nan,) * 4, 4)
    observed = read(tmp_path, log(nan, ("vehicle_odometry", 0, PITCHED, 4)))
    assert "attitude: taken from topic 'vehicle_odometry'." in observed.notes


def test_the_lowest_instance_that_has_rows_is_taken_and_the_others_are_named(tmp_path):
    observed = read(tmp_path, log(*GYROS))
    np.testing.assert_allclose(observed.rate.values, [(0.1, -0.2, -0.3)] * 4, atol=1e-7)
    assert "rate: taken from topic 'sensor_gyro', instance 0 of 0, 1." in observed.notes
    without = read(tmp_path, log(GYROS[1]))
    np.testing.assert_allclose(without.rate.values[0], (0.4, -0.5, -0.6), atol=1e-7)


def test_an_instance_is_chosen_where_there_are_several(tmp_path):
    """The attitude has but one."""
    content = log(("vehicle_attitude", 0, PITCHED, 4), *GYROS)
    observed = read(tmp_path, content, instance=1)
    np.testing.assert_allclose(observed.rate.values, [(0.4, -0.5, -0.6)] * 5, atol=1e-7)
    assert len(observed.attitude) == 4
    assert "rate: taken from topic 'sensor_gyro', instance 1 of 0, 1." in observed.notes


def test_an_instance_that_is_not_there_is_refused_with_those_that_are(tmp_path):
    with pytest.raises(InputError, match="'sensor_gyro': found no instance 2; wanted one of 0, 1"):
        read(tmp_path, log(*GYROS), instance=2)
    content = log(("vehicle_attitude", 0, PITCHED, 4), ("battery_status", 1, (12.0,), 3))
    with pytest.raises(
        InputError, match=r"no instance 1 of 'vehicle_attitude'.*vehicle_attitude: 0"
    ):
        read(tmp_path, content, instance=1)


def test_a_log_without_motion_lists_its_topics_with_their_rows(tmp_path):
    with pytest.raises(InputError, match=r"its topics: 'battery_status' \(3 rows\).*sensor_gyro"):
        read(tmp_path, log(("battery_status", 0, (12.0,), 3)))


def test_an_unknown_topic_is_refused_with_the_nearest(tmp_path):
    content = log(("vehicle_odometry", 0, PITCHED, 4), ("battery_status", 0, (12.0,), 3))
    with pytest.raises(InputError, match="did you mean 'vehicle_odometry'"):
        read(tmp_path, content, "vehicle_odometri")
    with pytest.raises(
        InputError, match=r"no row of attitude or rate in 'battery_status' \(3 rows"
    ):
        read(tmp_path, content, "battery_status")


def test_broken_bytes_end_with_the_declared_error_or_a_table(tmp_path):
    content, rng = log(("vehicle_odometry", 0, PITCHED, 30), *GYROS), np.random.default_rng(2)
    ends = []
    for k in range(200):
        at = int(rng.integers(len(content)))
        garbled = content[:at] + bytes([content[at] ^ (1 << int(rng.integers(8)))])
        try:
            whole = garbled + content[at + 1 :] if k % 2 else content[:at]
            ends.append(read(tmp_path, whole or b" ", instance=k % 3 or None).source)
        except InputError as error:
            ends.append(error.where)
    assert len(ends) == 200
    assert all("run.ulg" in each for each in ends)
