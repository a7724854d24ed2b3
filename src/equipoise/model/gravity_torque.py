"""The torque of gravity that a controller is to expect, and how well it is known."""

from dataclasses import dataclass
from enum import IntEnum

from equipoise.model.arrays import Vector3


class TorqueStatus(IntEnum):
    """Whether a controller should act on it."""

    NOT_USABLE = 0  # there is no estimate, or the torque is not known well enough
    USABLE = 1
    STALE = 2  # sensors have been silent; the numbers are those of their last rows


@dataclass(frozen=True, slots=True, eq=False)
class GravityTorque:
    """The torque at bench time ``t + lead``; vectors in body axes.

    With the first moment a controller forms the torque at its own rate, from its own attitude:
    ``first_moment x g_B``.
    """

    t: float  # s, bench time of the newest row that it rests on
    lead: float  # s
    torque: Vector3  # N m
    torque_sd: Vector3  # N m
    first_moment: Vector3  # kg m, m (r + s + C n), about P, masses as they stand
    first_moment_sd: Vector3  # kg m
    gravity: Vector3  # m/s^2, g_B
    status: TorqueStatus
