"""Accelerations of other programs' logs: at rest g upwards, in the axes of the rate."""

import struct

import numpy as np
import pytest

from equipoise.io.columns.read_options import ReadOptions
from equipoise.io.recording.recording_file import read_recording
from tests.io.columns.known_turns import T, read
from tests.io.logs import test_ulog_sources as px4
from tests.support.flight_logs import LAYOUTS, dataflash, flight
from tests.support.sample_logs import IMU, ODOMETRY, VECTOR, bag_1, bag_2

LEANING = (1.0, 2.0, 9.6)  # m/s^2: what an inertial unit of ROS reports, z up
ACCELERATION_FRD = (1.0, -2.0, -9.6)  # the same in FRD


def opened(tmp_path, content, name, **stated):
    (tmp_path / name).write_bytes(content)
    return read_recording(tmp_path / name, ReadOptions(**stated))


@pytest.mark.parametrize("bag", [bag_1, bag_2], ids=["ros1", "ros2"])
def test_an_inertial_unit_of_ros_gives_them(tmp_path, bag):
    found = read_recording(bag(tmp_path / "run.bag", {"/imu": IMU}, acceleration=LEANING))
    np.testing.assert_allclose(found.accelerometer.values, [LEANING] * len(found.rate))
    np.testing.assert_array_equal(found.accelerometer.t, found.rate.t)


def test_zeros_were_never_filled_in(tmp_path):
    assert read_recording(bag_1(tmp_path / "run.bag", {"/imu": IMU})).accelerometer is None


def test_of_two_inertial_units_beside_another_rate_none_is_taken(tmp_path):
    """They are no reason to refuse a log whose motion is stated."""
    topics = {"/odom": ODOMETRY, "/left": IMU, "/right": IMU, "/gyro": VECTOR}
    path = bag_1(tmp_path / "run.bag", topics, acceleration=LEANING)
    found = read_recording(path, ReadOptions(topics=("/odom",)))
    assert found.accelerometer is None
    one = read_recording(path, ReadOptions(topics=("/odom", "/left")))
    np.testing.assert_allclose(one.accelerometer.values, [LEANING] * len(one.accelerometer))


PX4_ROWS = {
    "vehicle_acceleration": ("float[3] xyz;", "3f", ()),
    "sensor_accel": ("uint32_t device_id;float x;float y;float z;", "I3f", (77,)),
    "sensor_combined": ("float[3] gyro_rad;float[3] accelerometer_m_s2;", "6f", (0.1, 0.2, 0.3)),
}


@pytest.mark.parametrize("topic", PX4_ROWS)
def test_px4_has_them_in_frd(tmp_path, topic, monkeypatch):
    """Turned as the gyro is: z down becomes z up."""
    monkeypatch.setattr(px4, "ROWS", px4.ROWS | PX4_ROWS)
    gyro = ("sensor_gyro", 0, (0.1, 0.2, 0.3), 4)
    found = opened(tmp_path, px4.log(gyro, (topic, 0, ACCELERATION_FRD, 4)), "run.ulg")
    np.testing.assert_allclose(found.accelerometer.values, [LEANING] * 4, rtol=1e-6)
    np.testing.assert_allclose(found.rate.values, [(0.1, -0.2, -0.3)] * 4, rtol=1e-6)


@pytest.mark.parametrize("instance", [0, 1])
def test_of_px4s_instances_the_stated_one_is_taken(tmp_path, instance, monkeypatch):
    monkeypatch.setattr(px4, "ROWS", px4.ROWS | PX4_ROWS)
    gyros = [("sensor_gyro", k, (0.1, 0.2, 0.3), 4) for k in (0, 1)]
    acceleration = [("sensor_accel", k, (1.0 + k, -2.0, -9.6), 4) for k in (0, 1)]
    found = opened(tmp_path, px4.log(*gyros, *acceleration), "run.ulg", instance=instance)
    np.testing.assert_allclose(found.accelerometer.values[:, 0], 1.0 + instance)


def test_ardupilot_has_them_beside_the_gyro(tmp_path):
    found = opened(tmp_path, flight("XKQ", "IMU"), "run.bin")
    np.testing.assert_allclose(found.accelerometer.values, [(0.0, 0.0, 9.8)] * 4, rtol=1e-6)


def test_ardupilots_message_of_its_own_counts_where_the_gyro_has_one(tmp_path, monkeypatch):
    """GYR and ACC, which are logged raw."""
    monkeypatch.setitem(LAYOUTS, "ACC", (9, "QBQfff", "TimeUS,I,SampleUS,AccX,AccY,AccZ"))
    rows = b"".join(
        bytes([0xA3, 0x95, 9]) + struct.pack("<QBQfff", us + 900, 0, us, *ACCELERATION_FRD)
        for us in range(7_000_000, 7_040_000, 10_000)
    )
    content = dataflash(rows, names=("ACC",)) + flight("GYR")
    found = opened(tmp_path, content, "run.bin")
    np.testing.assert_allclose(found.accelerometer.values, [LEANING] * 4, rtol=1e-6)


def test_a_phone_has_them_in_a_table_with_the_gyroscope(tmp_path):
    names = [f"Gyroscope {a} (rad/s)" for a in "xyz"] + [f"Acceleration {a} (m/s^2)" for a in "xyz"]
    rows = [",".join(map(repr, map(float, (t, 0.1, 0.2, 0.3 + t, *LEANING)))) for t in T]
    header = ",".join(f'"{name}"' for name in ["Time (s)", *names])
    found = read(tmp_path, "\n".join([header, *rows]) + "\n")
    np.testing.assert_allclose(found.accelerometer.values, [LEANING] * len(T))


def test_a_table_of_a_ros_topic_has_them(tmp_path):
    names = [f"/imu/angular_velocity/{a}" for a in "xyz"]
    names += [f"/imu/linear_acceleration/{a}" for a in "xyz"]
    rows = [",".join(map(repr, map(float, (t, 0.1, 0.2, 0.3 + t, *LEANING)))) for t in T]
    found = read(tmp_path, "\n".join([",".join(["__time", *names]), *rows]) + "\n")
    np.testing.assert_allclose(found.accelerometer.values, [LEANING] * len(T))
