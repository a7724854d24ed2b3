"""ROS messages to attitude, rate and acceleration.

Types (public: docs.ros.org, REP 103 and REP 145): quaternions x, y, z, w turn the child frame
into the parent; frames are right-handed, the world's Z is up. An inertial unit that has no
attitude says so by -1 as the first number of the covariance, and so with rate and acceleration.
At rest it reports g upwards, m/s^2.
"""

from collections.abc import Callable, Mapping, Sequence
from typing import Any

from equipoise.io.formats.clock_units import PER_S
from equipoise.io.logs.log_topics import (
    IMU,
    ODOMETRY,
    OLD_TREE,
    POSE,
    POSE_ESTIMATE,
    TRANSFORM,
    TREE,
    TURN,
    TWIST,
    VECTOR,
    Sample,
    Values,
)

NONE = -1.0  # REP 145: not known


def samples_of(kind: str, message: Any) -> Sequence[Sample]:
    """Return what a message of a known type holds; a tree of frames has several."""
    if kind in (TREE, OLD_TREE):
        return [_transform(each) for each in message.transforms]
    if kind == TRANSFORM:
        return [_transform(message)]
    header = message.header
    return [Sample(_stamp_of(header), DECODERS[kind](message), header.frame_id.lstrip("/"))]


def is_known(kind: str) -> bool:
    """Say whether messages of a type are read."""
    return kind in DECODERS or kind in (TREE, OLD_TREE, TRANSFORM)


def _stamp_of(header: Any) -> int:
    """Return the time that a header bears, ns."""
    return int(header.stamp.sec) * PER_S + int(header.stamp.nanosec)


def _transform(stamped: Any) -> Sample:
    values = _quaternion(stamped.transform.rotation)
    parent, child = stamped.header.frame_id.lstrip("/"), stamped.child_frame_id.lstrip("/")
    return Sample(_stamp_of(stamped.header), values, parent, child)


def _quaternion(turn: Any) -> Values:
    row = (float(turn.w), float(turn.x), float(turn.y), float(turn.z))
    return {"attitude": row} if any(row) else {}  # all zero: never filled in


def _vector(rate: Any) -> Values:
    return {"rate": (float(rate.x), float(rate.y), float(rate.z))}


def _acceleration(acceleration: Any) -> Values:
    row = (float(acceleration.x), float(acceleration.y), float(acceleration.z))
    return {"accelerometer": row} if any(row) else {}  # all zero: never filled in


def _imu(message: Any) -> Values:
    turns = message.orientation_covariance[0] != NONE
    spins = message.angular_velocity_covariance[0] != NONE
    accelerates = message.linear_acceleration_covariance[0] != NONE
    return {
        **(_quaternion(message.orientation) if turns else {}),
        **(_vector(message.angular_velocity) if spins else {}),
        **(_acceleration(message.linear_acceleration) if accelerates else {}),
    }


def _odometry(message: Any) -> Values:
    pose, twist = message.pose.pose, message.twist.twist  # the twist is in the child's axes
    return {**_quaternion(pose.orientation), **_vector(twist.angular)}


DECODERS: Mapping[str, Callable[[Any], Values]] = {
    IMU: _imu,
    ODOMETRY: _odometry,
    POSE: lambda message: _quaternion(message.pose.orientation),
    POSE_ESTIMATE: lambda message: _quaternion(message.pose.pose.orientation),
    TURN: lambda message: _quaternion(message.quaternion),
    TWIST: lambda message: _vector(message.twist.angular),
    VECTOR: lambda message: _vector(message.vector),
}
