"""The torque and momentum that wheels and gyros can give in every direction.

A set of boxes along axes a_k reaches sum_k |a_k.d| b_k in direction d. The least over d is
available in every direction:

    wheel    a_k its axis,             b_k greatest torque, and inertia times greatest speed
    gyro     a_k = g x s at angle 0,   b_k momentum times greatest rate
             momentum (E - g g^T) d, of length sqrt(1 - (g.d)^2) times the rotor's

For boxes the least is at right angles to two of the axes; directions about three degrees apart are
evaluated beside these, for the momentum of gyros. A gyro's torque is that at its initial angle;
gyros in a singularity give less.
"""

from itertools import combinations
from typing import NamedTuple

import numpy as np

from equipoise.model.arrays import Series1, Series3
from equipoise.model.testbed import Testbed

POINTS = 2000  # chosen: over half a sphere they are about three degrees apart
FLAT = 1e-3  # chosen: axes whose least singular value is smaller lie in a plane


class Capacity(NamedTuple):
    """The torque and momentum available in every direction."""

    torque: float  # N m
    momentum: float  # N m s


def directions() -> Series3:
    """Return unit vectors spread evenly over half the sphere (a Fibonacci spiral)."""
    k = np.arange(POINTS) + 0.5
    z, heading = k / POINTS, np.pi * (1.0 + 5.0**0.5) * k
    across = np.sqrt(1.0 - z**2)
    return np.column_stack([across * np.cos(heading), across * np.sin(heading), z])


def capacity(testbed: Testbed) -> Capacity:
    """Return the torque and momentum of a testbed's wheels and gyros; zero if an axis lacks."""
    turned = [np.cross(g.gimbal_axis, g.spin_axis) for g in testbed.cmgs]
    axes = np.array([*(w.axis for w in testbed.wheels), *turned]).reshape(-1, 3)
    if len(axes) < 3 or np.linalg.svd(axes)[1][2] < FLAT:
        return Capacity(0.0, 0.0)
    crossed = [np.cross(a, b) for a, b in combinations(axes, 2)]
    square = [c / np.linalg.norm(c) for c in crossed if np.linalg.norm(c) > FLAT]
    d = np.vstack([directions(), *square])
    torque: Series1 = np.zeros(len(d))
    momentum: Series1 = np.zeros(len(d))
    for wheel in testbed.wheels:
        along = np.abs(d @ wheel.axis)
        torque += wheel.max_torque * along
        momentum += wheel.inertia * wheel.max_speed * along
    for gyro, push in zip(testbed.cmgs, turned, strict=True):
        torque += gyro.momentum * gyro.max_rate * np.abs(d @ push)
        momentum += gyro.momentum * np.sqrt(1.0 - np.minimum((d @ gyro.gimbal_axis) ** 2, 1.0))
    return Capacity(float(torque.min()), float(momentum.min()))
