"""ROS messages to attitude and rate.

Types (public: docs.ros.org, REP 103 and REP 145): quaternions x, y, z, w turn the child frame
into the parent; frames are right-handed, the world's Z is up. An inertial unit that has no
attitude says so by -1 as the first number of the covariance, and so with the rate.
"""

from collections.abc import Callable, Mapping
from typing import Any

from equipoise.io.formats.clock_units import PER_S
from equipoise.io.formats.log_topics import IMU, ODOMETRY, POSE, TURN, Values

NONE = -1.0  # REP 145: not known


def stamp_of(message: Any) -> int:
    """Return the time that a message bears, ns."""
    stamp = message.header.stamp
    return int(stamp.sec) * PER_S + int(stamp.nanosec)


def _quaternion(turn: Any) -> Values:
    row = (float(turn.w), float(turn.x), float(turn.y), float(turn.z))
    return {"attitude": row} if any(row) else {}  # all zero: never filled in


def _vector(rate: Any) -> Values:
    return {"rate": (float(rate.x), float(rate.y), float(rate.z))}


def _imu(message: Any) -> Values:
    turns = message.orientation_covariance[0] != NONE
    spins = message.angular_velocity_covariance[0] != NONE
    return {
        **(_quaternion(message.orientation) if turns else {}),
        **(_vector(message.angular_velocity) if spins else {}),
    }


def _odometry(message: Any) -> Values:
    pose, twist = message.pose.pose, message.twist.twist  # the twist is in the child's axes
    return {**_quaternion(pose.orientation), **_vector(twist.angular)}


DECODERS: Mapping[str, Callable[[Any], Values]] = {
    IMU: _imu,
    ODOMETRY: _odometry,
    POSE: lambda message: _quaternion(message.pose.orientation),
    TURN: lambda message: _quaternion(message.quaternion),
}
