"""The cone round which gravity is led: how fast an offset fades on it, and which one is chosen.

With e the error of momentum and x the offset, as ``laws.fully_actuated`` has them, and gravity's
direction n at the angle A from level, going round at the speed W, in axes that go round with it
(y = m g x / w_a, u = up):

    e' = -K e - W u x e - w_a n x y
    y' =      - W u x y + w_a [n x]^T e,        K = 2 zeta w_a

The slowest of its six modes is mostly y along u. Its rate d(A, W, w_a, zeta) is the real part
nearest to zero; for small A it is

    d = sin^2 A  w_a^2 K W^2 / ((w_a^2 - W^2)^2 + K^2 W^2)

which is greatest where w_a is W: sin^2 A W / (2 zeta).

A wrong inertia dJ turns with the cone just as a wrong height, and leaves -dJ W^2 / (m g) along up:
W is at most that which leaves BIAS for one inertia_sd. Wheels and gyros limit the angle: their
momentum is (J W + m g h / W) A, with h the height that is not known, beside m g |r| 2 zeta / w_a
for ever; their torque (J W^2 + m g h) A once masses have met r. A slower cone may therefore be a
wider one. Of all speeds that one is taken with which an offset of one sd fades soonest:

    T = OPENING 2 pi / W + ln(sd / NEAR) / d + CONFIRMING 2 pi / W + ln(A / LEVELLED) / k

the time in which the cone opens (``sweep``), that of fading, the turns that show it, and the way
back to level with the gain k = HOLD w_a.
"""

from typing import NamedTuple

import numpy as np

from equipoise.control.elements.sweep import OPENS
from equipoise.control.plant import offset_bounds as offsets
from equipoise.control.plant.actuator_limits import greatest_slew
from equipoise.control.plant.wheel_capacity import Capacity, capacity
from equipoise.maths.linalg import skew
from equipoise.model.errors import InputError
from equipoise.model.testbed import Testbed
from equipoise.model.units import UM

ZETA = 0.4  # chosen: the less the faster; below it rows and drives that are late tell
RATIO = 1.1  # chosen: w_a over the speed of the cone, the best for ZETA
SPEED = 1.0  # chosen: w_a |r| / v
BIAS = 4e-6  # m, chosen: what a wrong inertia may leave along up
FIRM = 0.01  # chosen: inertia is not taken to be known better, as to the speed
NEAR = 0.2 * BIAS  # m, chosen: beside that it counts for a fiftieth, in squares
CONE = 0.6  # of the tilt limit, chosen: the cone
STRAY = 0.5  # of the tilt limit, chosen: what an offset may add, at first, while the cone is small
NARROWEST = np.radians(1.0)  # chosen
SPARE = 0.8  # chosen: of momentum and torque, what is used
SHARE = 0.5  # chosen: of a set of gyros, what singular directions leave
SLOWEST, SPEEDS = 0.05, 25  # chosen: of the greatest speed, the least; and how many between
OPENING = 2.75 * OPENS  # turns: int 1 - (1 - (1 + x) e^-x)^2 dx
HOLD = 0.3  # of w_a, chosen: k
LEVELLED = np.radians(0.5)  # chosen: level enough to let go
CONFIRMING = 1.5  # turns: two show the rest, and the first ends half a turn late in the mean


class Cone(NamedTuple):
    """A cone, the loop on it, and how long it takes."""

    speed: float  # rad/s, W
    angle: float  # rad, A
    frequency: float  # rad/s, w_a
    decay: float  # 1/s, d
    expected: float  # s, until an offset of one sd counts no longer

    @property
    def turn(self) -> float:
        """Return how long it takes to go round, s."""
        return 2 * np.pi / self.speed

    @property
    def fading(self) -> float:
        """Return how fast (1/s) an offset fades per share of time that it is across gravity."""
        return self.decay / float(np.sin(self.angle)) ** 2


def decay(angle: float, speed: float, frequency: float, damping: float) -> float:
    """Return the rate (1/s) of the slowest mode on a cone; zero at rest."""
    n = np.array([np.sin(angle), 0.0, -np.cos(angle)])
    turning, pull = speed * skew(np.array([0.0, 0.0, 1.0])), frequency * skew(n)
    loop = np.block(
        [[-2 * damping * frequency * np.eye(3) - turning, -pull], [pull.T, -turning]],
    )
    return max(-float(np.linalg.eigvals(loop).real.max()), 0.0)


def cone_for(testbed: Testbed, period: float) -> Cone:
    """Return the cone that takes least time; InputError where none can be."""
    least = least_frequency(testbed)
    most = offsets.greatest_frequency(testbed, least, SPEED, period)
    fastest = min(greatest_speed(testbed), most / RATIO)
    speeds = fastest * np.geomspace(SLOWEST, 1.0, SPEEDS)
    cones = [cone_at(testbed, float(speed), least) for speed in speeds]
    wide = [cone for cone in cones if cone.angle >= NARROWEST]
    if not wide or spare(testbed).torque < testbed.weight * offsets.likely_offset(testbed):
        raise too_weak(testbed, max(cone.angle for cone in cones))
    return min(wide, key=lambda cone: cone.expected)


def cone_at(testbed: Testbed, speed: float, least: float) -> Cone:
    """Return the widest cone of a speed (rad/s), with a loop no slower than ``least`` (rad/s)."""
    w = max(RATIO * speed, least)
    angle = widest(testbed, w, speed)
    rate = decay(angle, speed, w, ZETA) if angle > 0 else 0.0
    if rate <= 0:
        return Cone(speed, angle, w, rate, np.inf)
    fades = max(float(np.log(offsets.height_sd(testbed) / NEAR)), 0.0)
    levels = float(np.log(max(angle / LEVELLED, 1.0))) / (HOLD * w)
    turns = (OPENING + CONFIRMING) * 2 * np.pi / speed
    return Cone(speed, angle, w, rate, turns + fades / rate + levels)


def greatest_speed(testbed: Testbed) -> float:
    """Return the speed W (rad/s) of the cone at which a wrong inertia leaves BIAS."""
    return float((BIAS / height_of_inertia(testbed, 1.0)) ** 0.5)


def height_of_inertia(testbed: Testbed, speed: float) -> float:
    """Return what one sd of the inertia leaves along up on a cone of a speed (rad/s), m."""
    off = max(testbed.inertia_sd, FIRM) * offsets.level_inertia(testbed)
    return off * speed**2 / testbed.weight


def least_frequency(testbed: Testbed) -> float:
    """Return the w_a (rad/s) with which a likely offset tilts by STRAY: m g |r| / (J w_a^2)."""
    weight = testbed.weight / offsets.level_inertia(testbed)
    return float((weight * offsets.likely_offset(testbed) / (STRAY * testbed.tilt_limit)) ** 0.5)


def spare(testbed: Testbed) -> Capacity:
    """Return the usable torque and momentum."""
    most = capacity(testbed)
    share = SPARE * (SHARE if testbed.cmgs else 1.0)
    stored = sum(abs(wheel.inertia * wheel.speed) for wheel in testbed.wheels)
    return Capacity(share * most.torque, share * most.momentum - stored)


def unmet_height(testbed: Testbed, speed: float) -> float:
    """Return what torque has to hold up along up on the cone, m.

    Masses take the nominal centre of mass to P while the cone opens, a turn or longer.
    """
    way = abs(float(testbed.up @ testbed.body.com))
    late = max(way - greatest_slew(testbed) * 2 * np.pi / speed, 0.0)
    return late + offsets.LIKELY * offsets.height_sd(testbed)


def widest(testbed: Testbed, w: float, W: float) -> float:
    """Return the half-angle (rad) that tilt limit, torque and momentum allow; none: 0 or less."""
    J, weight, have = offsets.level_inertia(testbed), testbed.weight, spare(testbed)
    height = unmet_height(testbed, W)
    momentum = have.momentum - weight * offsets.likely_offset(testbed) * 2 * ZETA / w
    return min(
        CONE * testbed.tilt_limit,
        momentum / (J * W + weight * height / W),
        have.torque / (J * W**2 + weight * height),
    )


def too_weak(testbed: Testbed, angle: float) -> InputError:
    """Return what to raise where wheels or gyros allow no cone."""
    have, offset = spare(testbed), offsets.likely_offset(testbed)
    height = offsets.LIKELY * offsets.height_sd(testbed)
    return InputError(
        testbed.name,
        (
            f"{have.torque:.3g} N m and {have.momentum:.3g} N m s of wheels or gyros "
            f"available, and a centre of mass that may be {offset / UM:.3g} um off "
            f"sideways and {height / UM:.3g} um along up: a cone of "
            f"{np.degrees(max(angle, 0.0)):.2g} deg"
        ),
        f"{np.degrees(NARROWEST):.2g} deg: a coarse balance first, or stronger devices",
    )
