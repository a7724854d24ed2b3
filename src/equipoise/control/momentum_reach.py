"""How much torque and momentum wheels and gyros can give in the direction where they have least.

Along a unit vector n, wheels of torque t_i and momentum I_i s_i on axes a_i, and gyros of momentum
h_i, gimbal axes c_i and rates r_i reach

    torque    sum t_i |a_i.n| + SHARE sum h_i r_i |n - c_i (c_i.n)|
    momentum  sum (I_i s_i - |stored|) |a_i.n| + SHARE sum h_i |n - c_i (c_i.n)|

SHARE is what singular directions leave of a pyramid of gyros; where they are is not seen here.
"""

from typing import NamedTuple

import numpy as np

from equipoise.model.arrays import Floats
from equipoise.model.errors import InputError
from equipoise.model.testbed import Testbed

DIRECTIONS = 400  # chosen: of half a sphere, 7 deg apart
SHARE = 0.5  # chosen: of gyros
FLAT = 1e-9  # N m, N m s, chosen: none


class MomentumReach(NamedTuple):
    """What can be counted on in any direction."""

    torque: float  # N m
    momentum: float  # N m s


def directions(n: int = DIRECTIONS) -> Floats:
    """Return unit vectors (n, 3) evenly over half a sphere (Fibonacci)."""
    z = (np.arange(n) + 0.5) / n
    angle = np.pi * (3 - 5**0.5) * np.arange(n)
    r = np.sqrt(1 - z**2)
    return np.column_stack([r * np.cos(angle), r * np.sin(angle), z])


def momentum_reach(testbed: Testbed) -> MomentumReach:
    """Return what wheels and gyros can do; InputError if not along all three axes."""
    n = directions()
    torque, momentum = np.zeros(len(n)), np.zeros(len(n))
    for wheel in testbed.wheels:
        along = np.abs(n @ wheel.axis)
        torque += wheel.max_torque * along
        momentum += wheel.inertia * (wheel.max_speed - abs(wheel.speed)) * along
    for gyro in testbed.cmgs:
        beside = SHARE * gyro.momentum * np.sqrt(1 - np.minimum((n @ gyro.gimbal_axis) ** 2, 1))
        torque += gyro.max_rate * beside
        momentum += beside
    reach = MomentumReach(float(torque.min()), float(momentum.min()))
    if min(reach) < FLAT:
        raise InputError(testbed.name, "no wheels or gyros that turn it about all three axes",
                         "three reaction wheels or two control moment gyros")  # fmt: skip
    return reach
