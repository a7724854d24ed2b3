"""Logs to be read: ours, bags by another library, and ULog by hand from its description."""

import struct
from pathlib import Path

import numpy as np
from rosbags.rosbag1 import Writer as Writer1
from rosbags.rosbag2 import StoragePlugin
from rosbags.rosbag2 import Writer as Writer2
from rosbags.typesys import Stores, get_types_from_msg, get_typestore

from equipoise.model.recording import Recording, Samples

TURN = (0.5, 0.1, 0.2, np.sqrt(1 - 0.25 - 0.01 - 0.04))  # w x y z
START = 1_700_000_000  # s since 1970
ROS1, ROS2 = get_typestore(Stores.ROS1_NOETIC), get_typestore(Stores.ROS2_HUMBLE)
IMU, POSE = "sensor_msgs/msg/Imu", "geometry_msgs/msg/PoseStamped"
TURNED, ODOMETRY = "geometry_msgs/msg/QuaternionStamped", "nav_msgs/msg/Odometry"
TRANSFORM, TREE = "geometry_msgs/msg/TransformStamped", "tf2_msgs/msg/TFMessage"
OLD_TREE, ESTIMATE = "tf/msg/tfMessage", "geometry_msgs/msg/PoseWithCovarianceStamped"
TWIST, VECTOR = "geometry_msgs/msg/TwistStamped", "geometry_msgs/msg/Vector3Stamped"
for store, kind in ((ROS1, TREE), (ROS1, OLD_TREE)):
    store.register(get_types_from_msg("geometry_msgs/msg/TransformStamped[] transforms", kind))


def record() -> Recording:
    t = np.arange(8) / 4
    q = np.stack([np.cos(t), np.sin(t), 0 * t, 0 * t], axis=1)
    three = np.stack([t, 1 - t, t / 7], axis=1)
    return Recording(
        Samples(t, q), Samples(t[::2], three[::2]), ("x1", "y1"), Samples(t[:3], three[:3, :2] / 9),
        Samples(t, three / 3), Samples(t, three / 5), ("wheel:x", "gimbal:a"),
        Samples(t, three[:, :2]), Samples(t, three * 1e-5), Samples(t[:2], 20.0 + three[:2, :1]),
        Samples(t[:2], three[:2, :1]), Samples(t, three * 9), Samples(t[1:4], three[1:4]),
        position=Samples(t, three[:, :2] / 11),
        cause_names=("gravity_x", "gravity_sd_x"),
        torque_by_cause=Samples(t[:5], three[:5, :2] / 13),
    )  # fmt: skip


def message(store, kind: str, k: int, **said):
    """The k-th message of a topic: a quarter second after the one before.

    Said are ``frame``, ``child`` and ``acceleration``. A tree holds the child frames that are
    named, with commas between, and 'mount', which is fixed.
    """
    child, frame = said.get("child", "platform"), said.get("frame", "x")
    acceleration = said.get("acceleration", (0.0, 0.0, 0.0))
    types = store.types
    header = header_of(store, k, frame)
    w, x, y, z = TURN
    turn = types["geometry_msgs/msg/Quaternion"](x, y, z, w)
    vector = types["geometry_msgs/msg/Vector3"]
    point, none = types["geometry_msgs/msg/Point"](0.0, 0.0, 0.0), np.zeros(9)
    pose = types["geometry_msgs/msg/Pose"](point, turn)
    rate, still = vector(0.1 * k, 0.2, -0.3), vector(0.0, 0.0, 0.0)
    twist = types["geometry_msgs/msg/Twist"](still, rate)
    transform = types["geometry_msgs/msg/Transform"](still, turn)
    made = {
        IMU: (header, turn, none, rate, none, vector(*acceleration), none),
        POSE: (header, pose),
        TURNED: (header, turn),
        TRANSFORM: (header, child, transform),
        TWIST: (header, twist),
        VECTOR: (header, rate),
    }
    if kind in (TREE, OLD_TREE):
        stamped = types[TRANSFORM]
        moving = [stamped(header, each, transform) for each in child.split(",")]
        fixed = stamped(header_of(store, 0, frame), "mount", transform)
        made[kind] = (np.array([*moving, fixed]),)
    if kind in (ODOMETRY, ESTIMATE):
        with_pose = types["geometry_msgs/msg/PoseWithCovariance"](pose, np.zeros(36))
        with_twist = types["geometry_msgs/msg/TwistWithCovariance"](twist, np.zeros(36))
        made[ODOMETRY] = (header, "base", with_pose, with_twist)
        made[ESTIMATE] = (header, with_pose)
    return types[kind](*made[kind])


def header_of(store, k: int, frame: str):
    """The header of the k-th message."""
    stamp = store.types["builtin_interfaces/msg/Time"](START, 250_000_000 * k)
    header_type = store.types["std_msgs/msg/Header"]
    numbered = {"seq": k} if "seq" in header_type.__dataclass_fields__ else {}
    return header_type(**numbered, stamp=stamp, frame_id=frame)


def bag_1(path: Path, topics: dict[str, str], **said: str) -> Path:
    with Writer1(path) as writer:
        for name, kind in topics.items():
            connection = writer.add_connection(name, kind, typestore=ROS1)
            for k in range(4):
                data = ROS1.serialize_ros1(message(ROS1, kind, k, **said), kind)
                writer.write(connection, 77, data)
    return path


def bag_2(path: Path, topics: dict[str, str], plugin=StoragePlugin.SQLITE3, **said: str) -> Path:
    path = path.with_suffix("")
    with Writer2(path, version=9, storage_plugin=plugin) as writer:
        for name, kind in topics.items():
            connection = writer.add_connection(name, kind, typestore=ROS2)
            for k in range(4):
                data = ROS2.serialize_cdr(message(ROS2, kind, k, **said), kind)
                writer.write(connection, 77, data)
    return path


def bag_2_file(path: Path, topics: dict[str, str], **said: str) -> Path:
    return next(bag_2(path, topics, **said).glob("*.db3"))


def bag_2_mcap(path: Path, topics: dict[str, str], **said: str) -> Path:
    return bag_2(path, topics, StoragePlugin.MCAP, **said)


def bag_2_mcap_file(path: Path, topics: dict[str, str], **said: str) -> Path:
    return next(bag_2_mcap(path, topics, **said).glob("*.mcap"))


def reported(kind: bytes, body: bytes) -> bytes:
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
    out += reported(b"B", bytes(40))
    out += b"".join(reported(b"F", name.encode() + b":" + layout[name]) for name in names)
    out += b"".join(
        reported(b"A", struct.pack("<BH", 0, number) + name.encode())
        for number, name in enumerate(names)
    )
    for k in range(5):
        us, half = 5_000_000 + 100_000 * k, 0.05 * k
        q = (np.cos(half), np.sin(half), 0.0, 0.0)  # rolls to the right, right side down
        out += reported(b"D", struct.pack("<HQQ4f", 0, us + 999, us, *q))
        out += reported(b"D", struct.pack("<HQ3f", 1, us, 1.0, 0.25, -0.5))
    return out
