"""Every format in the table: round trip for those that are written, the foreign library's own file
for those that are read, and for all of them a sentence when they are broken."""

import io
import struct
from pathlib import Path

import numpy as np
import pytest
from pyulog import ULog
from rosbags.rosbag1 import Writer as Writer1
from rosbags.rosbag2 import StoragePlugin
from rosbags.rosbag2 import Writer as Writer2
from rosbags.typesys import Stores, get_typestore
from scipy.io import savemat

from equipoise.io.recording_file import read_recording, write_recording
from equipoise.io.recording_formats import FORMATS
from equipoise.io.ulog_messages import ulog_topics
from equipoise.model.errors import InputError
from equipoise.model.recording import CHANNELS, Recording, Samples

WRITTEN = [each for each in FORMATS if each.write is not None]
TURN = (0.5, 0.1, 0.2, np.sqrt(1 - 0.25 - 0.01 - 0.04))  # w x y z
START = 1_700_000_000  # s since 1970


def record() -> Recording:
    t = np.arange(8) / 4
    q = np.stack([np.cos(t), np.sin(t), 0 * t, 0 * t], axis=1)
    three = np.stack([t, 1 - t, t / 7], axis=1)
    return Recording(
        Samples(t, q), Samples(t[::2], three[::2]), ("x1", "y1"), Samples(t[:3], three[:3, :2] / 9),
        Samples(t, three / 3), Samples(t, three / 5), ("wheel:x", "gimbal:a"),
        Samples(t, three[:, :2]), Samples(t, three * 1e-5),
    )  # fmt: skip


# --- Written -----------------------------------------------------------------------------------


@pytest.mark.parametrize("kind", WRITTEN, ids=lambda kind: kind.name)
def test_what_is_written_is_read_again(tmp_path, kind):
    """To the last bit; what is not in SI in a table of ours (mm, uT, deg) to four units of it."""
    path = tmp_path / f"run{kind.suffixes[0]}"
    write_recording(record(), path)
    again = read_recording(path)
    assert (again.mass_names, again.device_names) == (("x1", "y1"), ("wheel:x", "gimbal:a"))
    for name in CHANNELS:
        ours, theirs = getattr(again, name), getattr(record(), name)
        np.testing.assert_array_equal(ours.t, theirs.t)
        rounded = 4 * (name in ("masses", "field", "devices") and kind.name != "mcap")
        np.testing.assert_array_max_ulp(ours.values, theirs.values, maxulp=rounded)
    assert len(again.sha256) == 64


@pytest.mark.parametrize("kind", WRITTEN[1:], ids=lambda kind: kind.name)
def test_a_file_is_known_by_what_is_in_it(tmp_path, kind):
    write_recording(record(), tmp_path / f"run{kind.suffixes[0]}")
    other = tmp_path / "run.dat"
    (tmp_path / f"run{kind.suffixes[0]}").rename(other)
    np.testing.assert_array_equal(read_recording(other).rate.values, record().rate.values)


# --- Read: made by other programs' own libraries ------------------------------------------------

ROS1, ROS2 = get_typestore(Stores.ROS1_NOETIC), get_typestore(Stores.ROS2_HUMBLE)
IMU, POSE = "sensor_msgs/msg/Imu", "geometry_msgs/msg/PoseStamped"
TURNED, ODOMETRY = "geometry_msgs/msg/QuaternionStamped", "nav_msgs/msg/Odometry"


def message(store, kind: str, k: int):
    """The k-th message of a topic: a quarter second after the one before."""
    types = store.types
    stamp = types["builtin_interfaces/msg/Time"](START, 250_000_000 * k)
    header_type = types["std_msgs/msg/Header"]
    numbered = {"seq": k} if "seq" in header_type.__dataclass_fields__ else {}
    header = header_type(**numbered, stamp=stamp, frame_id="x")
    w, x, y, z = TURN
    turn = types["geometry_msgs/msg/Quaternion"](x, y, z, w)
    vector = types["geometry_msgs/msg/Vector3"]
    point, none = types["geometry_msgs/msg/Point"](0.0, 0.0, 0.0), np.zeros(9)
    pose = types["geometry_msgs/msg/Pose"](point, turn)
    rate, still = vector(0.1 * k, 0.2, -0.3), vector(0.0, 0.0, 0.0)
    made = {
        IMU: (header, turn, none, rate, none, still, none),
        POSE: (header, pose),
        TURNED: (header, turn),
    }
    if kind == ODOMETRY:
        with_pose = types["geometry_msgs/msg/PoseWithCovariance"](pose, np.zeros(36))
        twist = types["geometry_msgs/msg/Twist"](still, rate)
        with_twist = types["geometry_msgs/msg/TwistWithCovariance"](twist, np.zeros(36))
        made[ODOMETRY] = (header, "base", with_pose, with_twist)
    return types[kind](*made[kind])


def bag_1(path: Path, topics: dict[str, str]) -> Path:
    with Writer1(path) as writer:
        for name, kind in topics.items():
            connection = writer.add_connection(name, kind, typestore=ROS1)
            for k in range(4):
                data = ROS1.serialize_ros1(message(ROS1, kind, k), kind)
                writer.write(connection, 77, data)
    return path


def bag_2(path: Path, topics: dict[str, str], plugin=StoragePlugin.SQLITE3) -> Path:
    path = path.with_suffix("")
    with Writer2(path, version=9, storage_plugin=plugin) as writer:
        for name, kind in topics.items():
            connection = writer.add_connection(name, kind, typestore=ROS2)
            for k in range(4):
                data = ROS2.serialize_cdr(message(ROS2, kind, k), kind)
                writer.write(connection, 77, data)
    return path


def bag_2_file(path: Path, topics: dict[str, str]) -> Path:
    return next(bag_2(path, topics).glob("*.db3"))


def bag_2_mcap(path: Path, topics: dict[str, str]) -> Path:
    return bag_2(path, topics, StoragePlugin.MCAP)


def bag_2_mcap_file(path: Path, topics: dict[str, str]) -> Path:
    return next(bag_2_mcap(path, topics).glob("*.mcap"))


BAGS = {
    "ros1": bag_1, "ros2": bag_2, "db3": bag_2_file,
    "ros2 mcap": bag_2_mcap, "mcap of ros2": bag_2_mcap_file,
}  # fmt: skip


@pytest.mark.parametrize("bag", BAGS.values(), ids=BAGS.keys())
@pytest.mark.parametrize("kind", [IMU, POSE, TURNED, ODOMETRY])
def test_bags_of_every_type_are_read(tmp_path, bag, kind):
    """Attitude scalar first, rate in body axes, the stamps' times, from zero."""
    seen = read_recording(bag(tmp_path / "run.bag", {"/platform": kind}))
    np.testing.assert_array_equal(seen.attitude.t, [0.0, 0.25, 0.5, 0.75])
    np.testing.assert_allclose(seen.attitude.values, [TURN] * 4, atol=1e-15)
    if kind in (IMU, ODOMETRY):
        np.testing.assert_array_equal(seen.rate.values[:, 0], 0.1 * np.arange(4))
        np.testing.assert_array_equal(seen.rate.values[:, 1:], [(0.2, -0.3)] * 4)
    else:
        assert seen.rate is None


@pytest.mark.parametrize("bag", BAGS.values(), ids=BAGS.keys())
def test_two_topics_of_a_type_are_listed(tmp_path, bag):
    with pytest.raises(InputError, match="2 topics of sensor_msgs/msg/Imu: /a, /b"):
        read_recording(bag(tmp_path / "run.bag", {"/b": IMU, "/a": IMU}))


def test_a_pose_goes_before_what_an_inertial_unit_makes_up(tmp_path):
    """And the notes say which topic gave what."""
    seen = read_recording(bag_1(tmp_path / "run.bag", {"/imu": IMU, "/camera": POSE}))
    told = " ".join(seen.notes)
    assert "attitude: taken from topic '/camera'" in told
    assert "rate: taken from topic '/imu'" in told


def test_a_bag_without_what_we_know_is_refused(tmp_path):
    with Writer1(tmp_path / "run.bag") as writer:
        kind = "std_msgs/msg/String"
        connection = writer.add_connection("/chat", kind, typestore=ROS1)
        writer.write(connection, 1, ROS1.serialize_ros1(ROS1.types[kind]("hello"), kind))
    with pytest.raises(InputError, match="no row of attitude or rate"):
        read_recording(tmp_path / "run.bag")


# --- ULog, written by hand from its public description ------------------------------------------


def told(kind: bytes, body: bytes) -> bytes:
    return struct.pack("<HB", len(body), kind[0]) + body


def ulog(rates: str) -> bytes:
    """Attitude at 10 Hz and rate, microseconds from 5 s after the start of the board."""
    layout = {
        "vehicle_attitude": b"uint64_t timestamp;uint64_t timestamp_sample;float[4] q;",
        "vehicle_angular_velocity": b"uint64_t timestamp;float[3] xyz;",
        "sensor_combined": b"uint64_t timestamp;float[3] gyro_rad;",
    }
    names = ("vehicle_attitude", rates)
    out = b"ULog\x01\x12\x35\x01" + struct.pack("<Q", 5_000_000)
    out += told(b"B", bytes(40))
    out += b"".join(told(b"F", name.encode() + b":" + layout[name]) for name in names)
    out += b"".join(
        told(b"A", struct.pack("<BH", 0, number) + name.encode())
        for number, name in enumerate(names)
    )
    for k in range(5):
        us, half = 5_000_000 + 100_000 * k, 0.05 * k
        q = (np.cos(half), np.sin(half), 0.0, 0.0)  # rolls to the right, right side down
        out += told(b"D", struct.pack("<HQQ4f", 0, us + 999, us, *q))
        out += told(b"D", struct.pack("<HQ3f", 1, us, 1.0, 0.25, -0.5))
    return out


@pytest.mark.parametrize("rates", ["vehicle_angular_velocity", "sensor_combined"])
def test_pyulog_finds_the_same_rows(rates):
    theirs = ULog(io.BytesIO(ulog(rates)))
    ours = ulog_topics(ulog(rates))
    for topic in ("vehicle_attitude", rates):
        wanted = theirs.get_dataset(topic).data
        found = ours.columns(topic)
        assert found.keys() == wanted.keys()
        for name, values in wanted.items():
            np.testing.assert_array_equal(found[name], values)


def test_a_broken_place_of_a_log_costs_the_rows_up_to_the_next_sync():
    """Row 2 is garbled, a sync follows row 3: rows 0, 1 and 4 are left."""
    whole, sync = ulog("sensor_combined"), bytes.fromhex("0800532f731320250cbb12")
    at = [k for k in range(len(whole)) if whole.startswith(struct.pack("<HBH", 34, 68, 0), k)]
    garbled = whole[: at[2]] + bytes(37) + whole[at[2] + 37 : at[4]] + sync + whole[at[4] :]
    found = ulog_topics(garbled)
    assert found.broken == 1
    times = found.columns("vehicle_attitude")["timestamp_sample"]
    np.testing.assert_array_equal(times, [5_000_000, 5_100_000, 5_400_000])


@pytest.mark.parametrize("rates", ["vehicle_angular_velocity", "sensor_combined"])
def test_a_log_of_px4_is_read_in_axes_whose_z_is_up(tmp_path, rates):
    """FRD in NED to ahead, left, up in north, west, up.

    Level is level; a roll right side down is about +x in both; pitch and yaw rates change sign.
    """
    (tmp_path / "run.ulg").write_bytes(ulog(rates))
    seen = read_recording(tmp_path / "run.ulg")
    np.testing.assert_allclose(seen.rate.t, np.arange(5) / 10, atol=1e-12)
    np.testing.assert_allclose(seen.rate.values, [(1.0, -0.25, 0.5)] * 5, atol=1e-7)
    np.testing.assert_allclose(seen.attitude.t, np.arange(5) / 10, atol=1e-12)
    half = 0.05 * np.arange(5)
    wanted = np.stack([np.cos(half), np.sin(half), 0 * half, 0 * half], axis=1)
    np.testing.assert_allclose(np.abs(np.sum(seen.attitude.values * wanted, axis=1)), 1, atol=1e-7)


def test_a_heading_east_turns_the_other_way_about_up(tmp_path):
    """NED yaw of +90 deg, from north to east, is -90 deg about our up."""
    east = b"".join(
        told(b"D", struct.pack("<HQQ4f", 0, k, k, np.sqrt(0.5), 0, 0, np.sqrt(0.5)))
        for k in range(9_000_000, 9_000_004)
    )
    head = ulog("sensor_combined")
    (tmp_path / "run.ulg").write_bytes(head[: head.index(told(b"D", b"\0\0")[2:4]) - 2] + east)
    q = read_recording(tmp_path / "run.ulg").attitude.values[-1]
    np.testing.assert_allclose(np.abs(q @ [np.sqrt(0.5), 0, 0, -np.sqrt(0.5)]), 1, atol=1e-6)


# --- MAT ---------------------------------------------------------------------------------------


def test_a_mat_file_of_version_7_3_is_told_how_to_be_saved(tmp_path):
    (tmp_path / "run.mat").write_bytes(b"MATLAB 7.3 MAT-file, Platform: GLNXA64" + bytes(600))
    with pytest.raises(InputError, match=r"version 7\.3.*-v7"):
        read_recording(tmp_path / "run.mat")


def test_a_mat_file_with_rows_texts_and_numbers_beside_is_read(tmp_path):
    """As MATLAB saves a workspace."""
    t = np.arange(5.0)
    told_ = {"time_s": t, "omega_x_rad_s": t, "omega_y_rad_s": t + 1, "omega_z_rad_s": t + 2}
    savemat(tmp_path / "run.mat", told_ | {"name": "platform", "mass": 4.0, "J": np.eye(3)})
    seen = read_recording(tmp_path / "run.mat")
    np.testing.assert_array_equal(seen.rate.values, np.stack([t, t + 1, t + 2], axis=1))


# --- Broken ------------------------------------------------------------------------------------


@pytest.fixture(scope="module")
def samples(tmp_path_factory) -> dict[str, bytes]:
    """One file of every format."""
    folder = tmp_path_factory.mktemp("formats")
    for kind in WRITTEN:
        write_recording(record(), folder / f"{kind.name}{kind.suffixes[0]}")
    made = {kind.name: (folder / f"{kind.name}{kind.suffixes[0]}") for kind in WRITTEN}
    made["bag"] = bag_1(folder / "one.bag", {"/imu": IMU})
    found = {name: path.read_bytes() for name, path in made.items()}
    return found | {"ulog": ulog("sensor_combined")}


@pytest.mark.parametrize("kind", FORMATS, ids=lambda kind: kind.name)
def test_a_broken_file_ends_with_the_declared_error(tmp_path, samples, kind):
    """Cut at forty places, and with forty places garbled."""
    content, rng = samples[kind.name], np.random.default_rng(1)
    path = tmp_path / f"run{kind.suffixes[0]}"
    read, refused = 0, 0
    for k in range(80):
        at = int(rng.uniform(0, len(content)))
        junk = rng.bytes(8) if k % 2 else b""
        path.write_bytes(content[:at] + (junk + content[at + 8 :] if k % 2 else b""))
        try:
            read_recording(path)
            read += 1
        except InputError:
            refused += 1
    assert read + refused == 80
    assert refused
