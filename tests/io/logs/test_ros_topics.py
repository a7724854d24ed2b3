"""Topics of ROS bags and of MCAP files of ROS: every type, which is taken, and which is refused."""

import io

import numpy as np
import pytest
from mcap.writer import Writer
from rosbags.rosbag1 import Writer as Writer1

from equipoise.io.columns.read_options import ReadOptions
from equipoise.io.recording.recording_file import read_recording, write_recording
from equipoise.model.errors import InputError
from tests.support.sample_logs import (
    ESTIMATE,
    IMU,
    ODOMETRY,
    OLD_TREE,
    POSE,
    ROS1,
    ROS2,
    TRANSFORM,
    TREE,
    TURN,
    TURNED,
    TWIST,
    VECTOR,
    bag_1,
    bag_2,
    bag_2_file,
    bag_2_mcap,
    bag_2_mcap_file,
    message,
    record,
)

BAGS = {
    "ros1": bag_1, "ros2": bag_2, "db3": bag_2_file,
    "ros2 mcap": bag_2_mcap, "mcap of ros2": bag_2_mcap_file,
}  # fmt: skip
every_bag = pytest.mark.parametrize("bag", BAGS.values(), ids=BAGS.keys())
STRING = "std_msgs/msg/String"


def mcap(topics: dict[str, str], ros2: bool, rows: int = 4, **said: str) -> bytes:
    """Return an MCAP file of messages, types named as ROS 1 or as ROS 2 names them."""
    stream = io.BytesIO()
    writer = Writer(stream)
    writer.start()
    for name, kind in topics.items():
        named = kind if ros2 else kind.replace("/msg/", "/")
        schema = writer.register_schema(named, "ros2msg" if ros2 else "ros1msg", b"")
        channel = writer.register_channel(name, "cdr" if ros2 else "ros1", schema)
        for k in range(rows):
            made = message(ROS2 if ros2 else ROS1, kind, k, **said)
            data = ROS2.serialize_cdr(made, kind) if ros2 else ROS1.serialize_ros1(made, kind)
            writer.add_message(channel, 77, bytes(data), 77)
    writer.finish()
    return stream.getvalue()


def read(path, *topics):
    return read_recording(path, ReadOptions(topics=topics))


def refused(path, *topics) -> str:
    with pytest.raises(InputError) as error:
        read(path, *topics)
    return str(error.value)


# --- Types -------------------------------------------------------------------------------------


@every_bag
@pytest.mark.parametrize("kind", [TRANSFORM, ESTIMATE, TREE])
def test_attitudes_of_every_type_are_read(tmp_path, bag, kind):
    observed = read_recording(bag(tmp_path / "run.bag", {"/tf": kind}))
    np.testing.assert_array_equal(observed.attitude.t, [0.0, 0.25, 0.5, 0.75])
    np.testing.assert_allclose(observed.attitude.values, [TURN] * 4, atol=1e-15)
    assert observed.rate is None


@every_bag
@pytest.mark.parametrize("kind", [TWIST, VECTOR])
def test_rates_of_every_type_are_read(tmp_path, bag, kind):
    observed = read_recording(bag(tmp_path / "run.bag", {"/gyro": kind}))
    np.testing.assert_array_equal(observed.rate.t, [0.0, 0.25, 0.5, 0.75])
    np.testing.assert_array_equal(observed.rate.values[:, 0], 0.1 * np.arange(4))
    np.testing.assert_array_equal(observed.rate.values[:, 1:], [(0.2, -0.3)] * 4)
    assert observed.attitude is None


@pytest.mark.parametrize("ros2", [False, True], ids=["ros1", "ros2"])
@pytest.mark.parametrize("kind", [TRANSFORM, ESTIMATE, TREE, OLD_TREE, ODOMETRY, TWIST, VECTOR])
def test_types_go_by_their_names_of_ros_1_too(tmp_path, kind, ros2):
    if kind == OLD_TREE and ros2:
        kind = TREE
    (tmp_path / "run.mcap").write_bytes(mcap({"/rates": kind}, ros2))
    observed = read_recording(tmp_path / "run.mcap")
    if kind in (TWIST, VECTOR, ODOMETRY):
        np.testing.assert_array_equal(observed.rate.values[:, 0], 0.1 * np.arange(4))
    if kind not in (TWIST, VECTOR):
        np.testing.assert_allclose(observed.attitude.values, [TURN] * 4, atol=1e-15)


def test_the_tree_of_old_ros_1_is_read(tmp_path):
    observed = read_recording(bag_1(tmp_path / "run.bag", {"/tf": OLD_TREE}))
    np.testing.assert_allclose(observed.attitude.values, [TURN] * 4, atol=1e-15)


def test_a_vicons_bag_is_read(tmp_path):
    """TransformStamped on a topic of its own, and its name needs no child frame."""
    observed = read_recording(bag_2(tmp_path / "run", {"/vicon/platform/platform": TRANSFORM}))
    (note,) = observed.notes
    assert note == f"attitude: taken from topic '/vicon/platform/platform' ({TRANSFORM})."


# --- Trees of frames ---------------------------------------------------------------------------


@every_bag
def test_each_child_frame_is_a_source_and_a_fixed_one_is_no_motion(tmp_path, bag):
    path = bag(tmp_path / "run.bag", {"/tf": TREE}, child="platform,arm")
    text = refused(path)
    assert f"2 topics of {TREE}: /tf:arm (4 rows), /tf:platform (4 rows)" in text
    assert "--topic /tf:arm" in text
    observed = read(path, "/tf:platform")
    assert f"attitude: taken from topic '/tf:platform' ({TREE})." in observed.notes
    left = next(note for note in observed.notes if note.startswith("Topics ignored"))
    assert "'/tf:arm'" in left
    assert "'/tf:mount' (tf2_msgs/msg/TFMessage, 4 rows: one stamp, so no motion)" in left
    assert "one stamp, so no motion" in refused(path, "/tf:mount")


def test_children_of_one_topic_of_transforms_are_sources_too(tmp_path):
    with Writer1(tmp_path / "run.bag") as writer:
        connection = writer.add_connection("/vicon", TRANSFORM, typestore=ROS1)
        for k in range(4):
            for child in ("/base", "/platform"):
                data = ROS1.serialize_ros1(message(ROS1, TRANSFORM, k, child=child), TRANSFORM)
                writer.write(connection, k, data)
    assert "/vicon:base (4 rows), /vicon:platform (4 rows)" in refused(tmp_path / "run.bag")
    assert len(read(tmp_path / "run.bag", "/vicon:base").attitude) == 4


# --- What may be a rate ------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("name", "says"),
    [
        ("/imu/gyro_raw", True), ("/angular_velocity", True), ("/body_rate", True),
        ("/bodyRates", True), ("/omega", True), ("/force", False), ("/mag/calibrated", False),
        ("/accelerated", False),
    ],
)  # fmt: skip
def test_a_vector_is_the_rate_if_its_topics_name_says_so(tmp_path, name, says):
    path = bag_1(tmp_path / "run.bag", {"/camera": POSE, name: VECTOR}, frame="")
    assert (read_recording(path).rate is not None) == says
    assert read(path, "/camera", name).rate is not None


def test_two_vectors_that_may_be_the_rate_are_listed(tmp_path):
    path = bag_1(tmp_path / "run.bag", {"/gyro/a": VECTOR, "/gyro/b": VECTOR, "/force": VECTOR})
    assert "/gyro/a (4 rows), /gyro/b (4 rows)" in refused(path)


def test_a_vector_that_may_be_anything_is_named_where_nothing_else_is_there(tmp_path):
    text = refused(bag_1(tmp_path / "run.bag", {"/force": VECTOR}))
    assert f"'/force' ({VECTOR}, 4 rows: of what, it does not say; --topic" in text


def test_an_inertial_units_rate_goes_before_a_vectors(tmp_path):
    path = bag_1(tmp_path / "run.bag", {"/gyro": VECTOR, "/imu": IMU})
    assert f"rate: taken from topic '/imu' ({IMU})." in read_recording(path).notes


def test_a_twist_in_the_axes_of_the_laboratory_is_no_rate_unless_it_is_stated(tmp_path):
    """As the pose beside it, which is stated in frame 'x' too; or by the name of the frame."""
    path = bag_1(tmp_path / "run.bag", {"/camera": POSE, "/speed": TWIST})
    observed = read_recording(path)
    assert observed.rate is None
    assert "'/speed' (geometry_msgs/msg/TwistStamped, 4 rows: in the axes of 'x'" in " ".join(
        observed.notes
    )
    assert read(path, "/camera", "/speed").rate is not None
    alone = bag_1(tmp_path / "map.bag", {"/speed": TWIST}, frame="/map")
    assert "in the axes of 'map'; --topic takes them for the body's" in refused(alone)


# --- Chosen by name ----------------------------------------------------------------------------


@every_bag
def test_exactly_the_topics_that_are_stated_are_taken(tmp_path, bag):
    path = bag(tmp_path / "run.bag", {"/a": IMU, "/b": IMU, "/camera": POSE, "/turn": TURNED})
    one = read(path, "/b")
    assert f"attitude: taken from topic '/b' ({IMU})." in one.notes
    assert f"rate: taken from topic '/b' ({IMU})." in one.notes
    two = read(path, "/a", "/turn")
    assert f"attitude: taken from topic '/turn' ({TURNED})." in two.notes
    assert f"rate: taken from topic '/a' ({IMU})." in two.notes


def test_a_topic_that_is_not_there_or_holds_nothing_is_refused(tmp_path):
    with Writer1(tmp_path / "run.bag") as writer:
        for name, kind in {"/chat": STRING, "/platform/pose": POSE}.items():
            connection = writer.add_connection(name, kind, typestore=ROS1)
            made = ROS1.types[STRING]("hello") if kind == STRING else message(ROS1, kind, 1)
            writer.write(connection, 1, ROS1.serialize_ros1(made, kind))
    text = refused(tmp_path / "run.bag", "/platfrom/pose")
    assert "no topic '/platfrom/pose'" in text
    assert "did you mean '/platform/pose'?" in text
    text = refused(tmp_path / "run.bag", "/chat")
    assert f"no row of attitude or rate in '/chat' ({STRING}, 1 row)" in text


def test_two_topics_for_one_thing_are_refused(tmp_path):
    path = bag_1(tmp_path / "run.bag", {"/camera": POSE, "/turn": TURNED})
    text = refused(path, "/camera", "/turn")
    assert "nothing to take from topic '/turn' beside attitude from '/camera'" in text


@pytest.mark.parametrize("kind", ["bag", "mcap"])
def test_a_log_without_a_known_type_lists_what_it_holds(tmp_path, kind):
    path = tmp_path / f"run.{kind}"
    if kind == "bag":
        with Writer1(path) as writer:
            connection = writer.add_connection("/chat", STRING, typestore=ROS1)
            for k in range(3):
                writer.write(connection, k, ROS1.serialize_ros1(ROS1.types[STRING]("a"), STRING))
    else:
        stream = io.BytesIO()
        writer = Writer(stream)
        writer.start()
        schema = writer.register_schema("std_msgs/String", "ros1msg", b"")
        channel = writer.register_channel("/chat", "ros1", schema)
        for k in range(3):
            writer.add_message(channel, k, b"\1\0\0\0a", k)
        writer.finish()
        path.write_bytes(stream.getvalue())
    text = refused(path)
    assert f"no row of attitude or rate; its topics: '/chat' ({STRING}, 3 rows)" in text
    assert TRANSFORM in text.split("read are")[1]


def test_a_recording_of_ours_has_no_topic_to_choose(tmp_path):
    write_recording(record(), tmp_path / "run.mcap")
    assert "--topic for a recording of ours" in refused(tmp_path / "run.mcap", "/rate")


# --- Broken ------------------------------------------------------------------------------------


@pytest.mark.parametrize("kind", [TREE, TRANSFORM, ESTIMATE, TWIST, VECTOR])
@pytest.mark.parametrize("form", ["bag", "mcap"])
def test_broken_messages_end_with_the_declared_error_or_a_table(tmp_path, kind, form):
    """Cut or with a byte changed, at thirty places each."""
    if form == "bag":
        content = bag_1(tmp_path / "one.bag", {"/gyro": kind}).read_bytes()
    else:
        content = mcap({"/gyro": kind}, ros2=True)
    path, rng, ends = tmp_path / f"run.{form}", np.random.default_rng(5), []
    for k in range(60):
        at = int(rng.integers(len(content)))
        garbled = content[:at] + bytes([content[at] ^ (1 << int(rng.integers(8)))])
        path.write_bytes(garbled + content[at + 1 :] if k % 2 else content[:at])
        try:
            ends.append(read_recording(path).source)
        except InputError as error:
            ends.append(error.where)
    assert len(ends) == 60
    assert all("run." in each for each in ends)
