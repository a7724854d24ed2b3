"""A manoeuvre: how a platform is let go, and what masses and devices do while it swings.

The start is what a person's hand can do: hold the platform with one side low, and let go with a
push. Its heading is the person's choice and has no effect.

    input of a device = amplitude   in the first half of each period
                      = -amplitude  in the second

of t / period + phase. With phase 1/4 a wheel's momentum then swings evenly about where it was.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field
from math import radians

from equipoise.model.arrays import Vector3, Vector6

HAND_TILT = radians(1.0)  # rad, chosen: one sd of a tilt about each level axis, set by hand
HAND_RATE = radians(0.5)  # rad/s, chosen: one sd of each component of a rate given by a push


@dataclass(frozen=True, slots=True)
class SquareWave:
    """What one device is driven by (``model.devices``)."""

    device: str
    amplitude: float  # N m on a wheel's rotor, rad/s of a gimbal
    period: float  # s
    phase: float = 0.25  # of a period, at time zero


@dataclass(frozen=True, slots=True, eq=False)
class Manoeuvre:
    """What is done from time zero on. Masses travel at their own speed, one move after another."""

    duration: float  # s
    tilt: float  # rad, at the start
    low_side: Vector3  # unit vector, body, level with the platform: the side that is lowest
    rate: Vector3  # rad/s, body axes, at the start
    moves: tuple[tuple[float, Mapping[str, float]], ...] = ()  # s, and m from home by mass
    waves: tuple[SquareWave, ...] = ()
    standing: Mapping[str, float] = field(default_factory=dict[str, float])  # m, before time zero
    tilt_sd: float = HAND_TILT  # rad, how well the start is met
    rate_sd: float = HAND_RATE  # rad/s


@dataclass(frozen=True, slots=True, eq=False)
class Plan:
    """A manoeuvre as it is written down, with what it promises."""

    testbed: str  # name
    manoeuvre: Manoeuvre
    inertia_sd: Vector6 | None = None  # kg m^2, xx yy zz xy xz yz; None: part is unobservable
    com_sd: Vector3 | None = None  # m
    source: str = ""  # the file
