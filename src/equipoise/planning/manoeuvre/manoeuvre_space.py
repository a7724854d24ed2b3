"""The manoeuvres that there are to choose from, as numbers between 0 and 1.

    lean of the start x, y     within a circle of the tilt limit
    rate of the start          spin about the axis that points up, sway about the level ones
    a time for each move       in order, the last early enough to arrive and to swing afterwards
    where masses go            one share of the travel, or of what is in time, for each kind of
                               rail and each move
    waves                      amplitude and period for each wheel or gyro

Masses of one kind (rail of one direction, same mass, travel, accuracy and speed) go together: more
of them average their errors. What a hand sets and a person reads is rounded: tilt and its
direction, rates and times, masses to their steps.
"""

from dataclasses import dataclass

import numpy as np

from equipoise.maths.axes_across import axes_across
from equipoise.model.arrays import Floats, Vector3
from equipoise.model.bench_requests import in_steps
from equipoise.model.devices import ControlMomentGyro, ReactionWheel
from equipoise.model.manoeuvre import Manoeuvre, SquareWave
from equipoise.model.testbed import SlidingMass, Testbed
from equipoise.model.units import DEG

TILT_STEP, SIDE_STEP, RATE_STEP = 0.5 * DEG, 5 * DEG, 0.1 * DEG  # chosen: what a person reads
SWAY = 1.0 * DEG  # rad/s, chosen: a greater push sideways does what a greater tilt does
EARLY, LATE = 2.0, 0.9  # s, share of the time, chosen: a swing is recorded before and after
MOST_MOMENTUM = 0.8  # of a wheel's, chosen: leaves room for what it holds against
MOST_GIMBAL = 60 * DEG  # chosen: a gyro that has turned further gives less and less torque
SHORTEST = 8.0  # s, of a wave, chosen: ten times the lag of a slow wheel
SAME = 1e-9
LEVEL = 0.5  # sine of a slope, chosen: rails that are less steep count as level


@dataclass(frozen=True, slots=True, eq=False)
class Space:
    """The testbed, and the limits of a choice."""

    testbed: Testbed
    duration: float  # s
    moves: int
    tilt_limit: float  # rad
    rate_limit: float  # rad/s
    standing: dict[str, float]  # m, where masses stand before

    @property
    def limits(self) -> Floats:
        """Return the limits of tilt (rad) and rate (rad/s), (2,)."""
        return np.array([self.tilt_limit, self.rate_limit])

    @property
    def kinds(self) -> list[list[SlidingMass]]:
        """Return the masses that go together."""
        found: list[list[SlidingMass]] = []
        for mass in self.testbed.masses:
            for kind in found:
                if alike(kind[0], mass):
                    kind.append(mass)
                    break
            else:
                found.append([mass])
        return found

    @property
    def driven(self) -> tuple[ReactionWheel | ControlMomentGyro, ...]:
        """Return the devices that waves may drive."""
        return (*self.testbed.wheels, *self.testbed.cmgs)

    @property
    def size(self) -> int:
        """Return how many numbers a choice is."""
        moves = self.moves if self.testbed.masses else 0
        return 5 + moves * (1 + len(self.kinds)) + 2 * len(self.driven)


def alike(a: SlidingMass, b: SlidingMass) -> bool:
    """Say whether two masses do the same to the centre of mass, and as well."""
    same = a.mass == b.mass and a.accuracy == b.accuracy and a.speed == b.speed
    return same and a.travel == b.travel and float(a.axis @ b.axis) > 1 - SAME


def chosen(space: Space, numbers: Floats) -> Manoeuvre:
    """Return the manoeuvre of numbers between 0 and 1."""
    start, rest = numbers[:5], numbers[5:]
    moves = space.moves if space.testbed.masses else 0
    times, rest = rest[:moves], rest[moves:]
    cut = moves * len(space.kinds)
    shares, waves = rest[:cut].reshape(moves, len(space.kinds)), rest[cut:].reshape(-1, 2)
    tilt, side = lean_of(space, start[:2])
    return Manoeuvre(
        space.duration,
        tilt,
        side,
        rate_of(space, start[2:]),
        tuple(zip(times_of(space, times), [targets_of(space, s) for s in shares], strict=True)),
        tuple(filter(None, (wave_of(space, device, wave)
                            for device, wave in zip(space.driven, waves, strict=True)))),
        space.standing,
    )  # fmt: skip


def range_of(space: Space, mass: SlidingMass) -> tuple[float, float]:
    """Return between which displacements (m) a mass may go: all moves take half the time at most.

    Half as far to either side of where it stands.
    """
    each = 0.5 * LATE * space.duration / max(space.moves, 1)
    (low, high), now = mass.travel, space.standing.get(mass.name, 0.0)
    aside = 0.5 * mass.speed * each
    return max(low, now - aside), min(high, now + aside)


def lean_of(space: Space, two: Floats) -> tuple[float, Vector3]:
    """Return tilt (rad) and low side of two numbers: a disc, so that no direction is preferred."""
    x, y = (2 * float(number) - 1 for number in two)
    tilt = min(float(np.hypot(x, y)), 1.0) * space.tilt_limit
    angle = SIDE_STEP * round(float(np.arctan2(y, x)) / SIDE_STEP)
    first, second = axes_across(space.testbed.up)
    return TILT_STEP * round(tilt / TILT_STEP), np.cos(angle) * first + np.sin(angle) * second


def rate_of(space: Space, three: Floats) -> Vector3:
    """Return the rate (rad/s) of three numbers: sway, sway, spin."""
    limits = np.array([SWAY, SWAY, space.rate_limit])
    sway_1, sway_2, spin = RATE_STEP * np.round((2 * three - 1) * limits / RATE_STEP)
    first, second = axes_across(space.testbed.up)
    return sway_1 * first + sway_2 * second + spin * space.testbed.up


def times_of(space: Space, numbers: Floats) -> list[float]:
    """Return the times of moves, in order, whole seconds and a travel apart at least."""
    masses = space.testbed.masses
    longest = max((float(np.ptp(range_of(space, m))) / m.speed for m in masses), default=0.0)
    count, last = len(numbers), LATE * space.duration - longest
    separation = min(longest, max(last - EARLY, 0.0) / max(count, 1))
    room = max(last - EARLY - (count - 1) * separation, 0.0)
    return [float(round(EARLY + k * separation + room * x)) for k, x in enumerate(np.sort(numbers))]


def targets_of(space: Space, shares: Floats) -> dict[str, float]:
    """Return displacements from home (m), in whole steps within the rails."""
    found: dict[str, float] = {}
    for kind, share in zip(space.kinds, shares, strict=True):
        for mass in kind:
            low, high = range_of(space, mass)
            goal = in_steps(mass, low + share * (high - low))
            found[mass.name] = float(np.clip(goal, *mass.travel))
    return found


def wave_of(
    space: Space, device: ReactionWheel | ControlMomentGyro, two: Floats
) -> SquareWave | None:
    """Return the wave of one device; None where it would do nothing."""
    share, period = 2 * two[0] - 1, SHORTEST * (space.duration / (2 * SHORTEST)) ** float(two[1])
    period = float(round(period))
    amplitude = share * greatest(device, period)
    return SquareWave(device.name, amplitude, period) if abs(share) > 0.02 else None


def greatest(device: ReactionWheel | ControlMomentGyro, period: float) -> float:
    """Return the greatest input that keeps a device within its limits: a quarter period of it."""
    if isinstance(device, ControlMomentGyro):
        return min(device.max_rate, 4 * MOST_GIMBAL / period)
    room = MOST_MOMENTUM * (device.max_speed - abs(device.speed)) * device.inertia
    return min(device.max_torque, 4 * room / period)
