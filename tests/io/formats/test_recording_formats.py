"""Every format in the table: round trip for those that are written, the foreign library's own file
for those that are read, and for all of them a sentence when they are broken."""

import io
import struct

import numpy as np
import pytest
from pyulog import ULog
from rosbags.rosbag1 import Writer as Writer1
from scipy.io import savemat

from equipoise.io.columns.read_options import ReadOptions
from equipoise.io.files.file_content import Content
from equipoise.io.logs.ulog_file import ulog_topics
from equipoise.io.recording.format_registry import FORMATS
from equipoise.io.recording.recording_file import read_recording, write_recording
from equipoise.model.errors import InputError
from equipoise.model.recording import CHANNELS
from tests.support.excel_files import RATE_SHEET, workbook
from tests.support.flight_logs import flight, flown, terminal
from tests.support.sample_logs import (
    IMU,
    ODOMETRY,
    POSE,
    ROS1,
    TURN,
    TURNED,
    bag_1,
    bag_2,
    bag_2_file,
    bag_2_mcap,
    bag_2_mcap_file,
    record,
    reported,
    ulog,
)

WRITTEN = [each for each in FORMATS if each.write is not None]


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
        rounded = 4 * (name in ("masses", "field", "devices", "position") and kind.name != "mcap")
        np.testing.assert_array_max_ulp(ours.values, theirs.values, maxulp=rounded)
    assert len(again.sha256) == 64


@pytest.mark.parametrize("kind", WRITTEN[1:], ids=lambda kind: kind.name)
def test_a_file_is_known_by_what_is_in_it(tmp_path, kind):
    write_recording(record(), tmp_path / f"run{kind.suffixes[0]}")
    other = tmp_path / "run.dat"
    (tmp_path / f"run{kind.suffixes[0]}").rename(other)
    np.testing.assert_array_equal(read_recording(other).rate.values, record().rate.values)


# --- Read: made by other programs' own libraries ------------------------------------------------

BAGS = {
    "ros1": bag_1, "ros2": bag_2, "db3": bag_2_file,
    "ros2 mcap": bag_2_mcap, "mcap of ros2": bag_2_mcap_file,
}  # fmt: skip


@pytest.mark.parametrize("bag", BAGS.values(), ids=BAGS.keys())
@pytest.mark.parametrize("kind", [IMU, POSE, TURNED, ODOMETRY])
def test_bags_of_every_type_are_read(tmp_path, bag, kind):
    """Attitude scalar first, rate in body axes, the stamps' times, from zero."""
    observed = read_recording(bag(tmp_path / "run.bag", {"/platform": kind}))
    np.testing.assert_array_equal(observed.attitude.t, [0.0, 0.25, 0.5, 0.75])
    np.testing.assert_allclose(observed.attitude.values, [TURN] * 4, atol=1e-15)
    if kind in (IMU, ODOMETRY):
        np.testing.assert_array_equal(observed.rate.values[:, 0], 0.1 * np.arange(4))
        np.testing.assert_array_equal(observed.rate.values[:, 1:], [(0.2, -0.3)] * 4)
    else:
        assert observed.rate is None


@pytest.mark.parametrize("bag", BAGS.values(), ids=BAGS.keys())
def test_two_topics_of_a_type_are_listed(tmp_path, bag):
    with pytest.raises(
        InputError, match=r"2 topics of sensor_msgs/msg/Imu: /a \(4 rows\), /b \(4 rows\).*--topic"
    ):
        read_recording(bag(tmp_path / "run.bag", {"/b": IMU, "/a": IMU}))


def test_a_pose_goes_before_what_an_inertial_unit_makes_up(tmp_path):
    """And the notes say which topic gave what."""
    observed = read_recording(bag_1(tmp_path / "run.bag", {"/imu": IMU, "/camera": POSE}))
    reported = " ".join(observed.notes)
    assert "attitude: taken from topic '/camera'" in reported
    assert "rate: taken from topic '/imu'" in reported


def test_a_bag_without_what_we_know_is_refused(tmp_path):
    with Writer1(tmp_path / "run.bag") as writer:
        kind = "std_msgs/msg/String"
        connection = writer.add_connection("/chat", kind, typestore=ROS1)
        writer.write(connection, 1, ROS1.serialize_ros1(ROS1.types[kind]("hello"), kind))
    with pytest.raises(InputError, match="no row of attitude or rate"):
        read_recording(tmp_path / "run.bag")


@pytest.mark.parametrize("suffix", [".csv", ".parquet", ".mat", ".mcap"])
@pytest.mark.parametrize("stated", [{"topics": ("/imu",)}, {"instance": 0}])
def test_what_has_neither_topics_nor_instances_has_none_to_choose(tmp_path, suffix, stated):
    write_recording(record(), tmp_path / f"run{suffix}")
    with pytest.raises(InputError, match=f"found --{next(iter(stated)).rstrip('s')} for a "):
        read_recording(tmp_path / f"run{suffix}", ReadOptions(**stated))


# --- ULog, written by hand from its public description ------------------------------------------


@pytest.mark.parametrize("rates", ["vehicle_angular_velocity", "sensor_combined"])
def test_pyulog_finds_the_same_rows(rates):
    theirs = ULog(io.BytesIO(ulog(rates)))
    ours = ulog_topics(Content.of(ulog(rates), "log"))
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
    found = ulog_topics(Content.of(garbled, "log"))
    assert found.broken == 1
    times = found.columns("vehicle_attitude")["timestamp_sample"]
    np.testing.assert_array_equal(times, [5_000_000, 5_100_000, 5_400_000])


@pytest.mark.parametrize("rates", ["vehicle_angular_velocity", "sensor_combined"])
def test_a_log_of_px4_is_read_in_axes_whose_z_is_up(tmp_path, rates):
    """FRD in NED to ahead, left, up in north, west, up.

    Level is level; a roll right side down is about +x in both; pitch and yaw rates change sign.
    """
    (tmp_path / "run.ulg").write_bytes(ulog(rates))
    observed = read_recording(tmp_path / "run.ulg")
    np.testing.assert_allclose(observed.rate.t, np.arange(5) / 10, atol=1e-12)
    np.testing.assert_allclose(observed.rate.values, [(1.0, -0.25, 0.5)] * 5, atol=1e-7)
    np.testing.assert_allclose(observed.attitude.t, np.arange(5) / 10, atol=1e-12)
    half = 0.05 * np.arange(5)
    wanted = np.stack([np.cos(half), np.sin(half), 0 * half, 0 * half], axis=1)
    np.testing.assert_allclose(
        np.abs(np.sum(observed.attitude.values * wanted, axis=1)), 1, atol=1e-7
    )


def test_a_heading_east_turns_the_other_way_about_up(tmp_path):
    """NED yaw of +90 deg, from north to east, is -90 deg about our up."""
    east = b"".join(
        reported(b"D", struct.pack("<HQQ4f", 0, k, k, np.sqrt(0.5), 0, 0, np.sqrt(0.5)))
        for k in range(9_000_000, 9_000_004)
    )
    head = ulog("sensor_combined")
    (tmp_path / "run.ulg").write_bytes(head[: head.index(reported(b"D", b"\0\0")[2:4]) - 2] + east)
    q = read_recording(tmp_path / "run.ulg").attitude.values[-1]
    np.testing.assert_allclose(np.abs(q @ [np.sqrt(0.5), 0, 0, -np.sqrt(0.5)]), 1, atol=1e-6)


# --- MAT ---------------------------------------------------------------------------------------


def test_invalid_numbers_are_reported_without_runtime_warnings(tmp_path):
    """A NaN that processors take note of, and a number beyond what a bench has: no warning."""
    noted = np.frombuffer(bytes.fromhex("000000000000f47f"))[0]
    t, q = np.arange(6) * 0.25, np.tile([1.0, 0, 0, 0], (6, 1))
    t[3] = noted
    turn = {f"q_{k}": q[:, i] for i, k in enumerate("wxyz")}
    savemat(tmp_path / "run.mat", {"time_s": t, **turn})
    with pytest.raises(InputError, match="row 4, column 'time_s'"):
        read_recording(tmp_path / "run.mat")
    turn["q_x"] = np.full(6, 1e200)
    savemat(tmp_path / "long.mat", {"time_s": np.arange(6.0), **turn})
    with pytest.raises(
        InputError, match=r"1e\+200, beyond 1e\+09 in SI, more than any bench reaches"
    ):
        read_recording(tmp_path / "long.mat")


def test_a_mat_file_with_rows_texts_and_numbers_beside_is_read(tmp_path):
    """As MATLAB saves a workspace."""
    t = np.arange(5.0)
    reported_ = {"time_s": t, "omega_x_rad_s": t, "omega_y_rad_s": t + 1, "omega_z_rad_s": t + 2}
    savemat(tmp_path / "run.mat", reported_ | {"name": "platform", "mass": 4.0, "J": np.eye(3)})
    observed = read_recording(tmp_path / "run.mat")
    np.testing.assert_array_equal(observed.rate.values, np.stack([t, t + 1, t + 2], axis=1))


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
    logs = {"ulog": ulog("sensor_combined"), "dataflash": flight("ATT", "IMU")}
    logs |= {"tlog": flown("turned"), "vectornav": terminal("VNQMR").encode()}
    return found | logs | {"xlsx": workbook({"run": RATE_SHEET})}


@pytest.mark.parametrize("kind", FORMATS, ids=lambda kind: kind.name)
def test_a_broken_file_ends_with_the_declared_error(tmp_path, samples, kind):
    """Cut at forty places, and with forty places garbled."""
    content, rng = samples[kind.name], np.random.default_rng(1)
    path = tmp_path / f"run{next(iter(kind.suffixes), '.log')}"
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
