"""Between levelling and levelling: see how deep the platform hangs, and raise it.

A level platform at rest shows nothing of its height r.u. Masses move its centre of mass sideways by
SWING of its depth, which sets it swinging, and a look follows, over the record from BEFORE that
move on. The move is a known change, and gives the scale that free motion leaves open. Then the
platform is raised to SURE sds below the target and levelled again; the next look, from there, sees
the height so much better. When the sd is small enough, or after MOST_LOOKS, it is levelled once
more at SHALLOW below the target, and raised by that: it is still then, and a camera that is off
plumb by an angle leaves no more than the angle times SHALLOW.

    shift along u = target.u - r_home.u - depth,       r_home of the last look

A law that levels the platform keeps a ``HeightSearch`` in its state. It asks ``gone_on`` at each
step before its own feedback, and says ``levelled_at`` when the platform is level and quiet.

Masses are sent first, and the look or the end follows when they have arrived. What the looks do not
see (an estimate that is not usable, or does not hold the centre of mass) is left, and said.
"""

from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np

from equipoise.control.law import Sample
from equipoise.control.plant.pendulum import Hanging, shift_for
from equipoise.model.arrays import Vector3
from equipoise.model.command import Command, Measurement
from equipoise.model.estimate import COM, Estimate
from equipoise.model.reasons.law_reasons import LawReason
from equipoise.model.reasons.reason import Reason, one_reason

SWING = 0.06  # rad, chosen: 7 degrees from side to side
DURATION = 60.0  # s, chosen: three swings or more at first
BEFORE = 5.0  # s, chosen: of rest, in the record of a look
SURE = 3.0  # sds, chosen
SHALLOW = 1e-5  # m, chosen: a swing of a minute or two
CLOSE = 1e-6  # m, chosen: one sd of the height at which no further look is needed
MOST_MEASUREMENTS = 4  # chosen: a look takes the sd to a third or less
TINY = 1e-9  # m, chosen: a step of masses that have none
ARRIVED = 2.0  # motor steps, chosen
PATIENCE = 5.0  # s, chosen: beyond twice the travel, for fine masses that are slower


@dataclass(frozen=True, slots=True)
class Height:
    """Where the platform hangs, and what is known of it."""

    along: float  # m, the shift along u
    depth: float  # m, as believed
    measurements: int = 0
    known: bool = False  # to CLOSE, or as well as it will be


class Sent(NamedTuple):
    """Masses on their way."""

    goal: Vector3  # m, shift
    then: Command
    late: float  # s, when they should long have arrived


@dataclass(frozen=True, slots=True, eq=False)
class HeightSearch:
    """How far a law has come with the height."""

    height: Height
    level: Vector3 | None = None  # m, the mean shift that last levelled the platform
    way: Sent | None = None  # None: the law levels


def height_search(plant: Hanging) -> HeightSearch:
    """Return the beginning: the platform hangs at the plant's depth."""
    return HeightSearch(Height(plant.lowered, plant.depth))


def gone_on(
    search: HeightSearch, sample: Sample | Estimate, plant: Hanging, target: Vector3
) -> tuple[HeightSearch, Command | None]:
    """Return the search after a sample or a look, and its command; None: the law levels."""
    if isinstance(sample, Sample):
        return search, None if search.way is None else on_the_way(plant, search.way, sample)
    assert search.level is not None
    if sees(sample):
        return HeightSearch(raised(plant, search.height, sample, target), search.level), None
    assert search.way is not None
    way = unseen(plant, sample, search.way, search.level)
    return replace(search, way=way), Command(shift=way.goal)


def levelled_at(
    search: HeightSearch, sample: Sample, level: Vector3, plant: Hanging, target: Vector3
) -> tuple[HeightSearch, Command]:
    """Return the search where the shift ``level`` (m) levels the platform, and its command."""
    way = once_level(plant, search.height, sample, level, target)
    return HeightSearch(search.height, level, way), Command(shift=way.goal)


def raised_note(height: Height) -> tuple[Reason, ...]:
    """Return what a command notes of a platform that was raised after a measurement."""
    return one_reason(LawReason.RAISED, depth=height.depth)


def sees(estimate: Estimate) -> bool:
    """Say whether a look shows the centre of mass."""
    return estimate.outcome.usable and estimate.sees(COM)


def raised(plant: Hanging, height: Height, estimate: Estimate, target: Vector3) -> Height:
    """Return where to level next, after a look that sees the centre of mass."""
    up, measurements = plant.up, height.measurements + 1
    sd = float(np.sqrt(up @ estimate.covariance_of(COM) @ up))
    known = sd <= CLOSE or measurements >= MOST_MEASUREMENTS
    depth = SHALLOW if known else max(SURE * sd, SHALLOW)
    return Height(float(up @ (target - estimate.com)) - depth, depth, measurements, known)


def last_shift(plant: Hanging, height: Height, level: Vector3, target: Vector3) -> Vector3:
    """Return the shift (m) to the target from one that levels the platform at this height."""
    up = plant.up
    sideways: Vector3 = level + target
    return sideways - up * (up @ sideways) + up * (height.along + height.depth)


def once_level(
    plant: Hanging, height: Height, sample: Sample, level: Vector3, target: Vector3
) -> Sent:
    """Return what follows where the shift ``level`` (m) levels the platform: a look, or the end."""
    if height.known:
        last = last_shift(plant, height, level, target)
        done = one_reason(LawReason.LEVEL_AT_TARGET)
        return sent(plant, sample, last, Command(shift=last, finished=done))
    kick = shift_for(plant, np.full(2, SWING * height.depth / np.sqrt(2)))
    since = max(sample.t - BEFORE, 0.0)
    measurement = Measurement(DURATION, "trajectory", hold=plant.still, use_prior=True, since=since)
    note = one_reason(LawReason.SWINGS_FOR_HEIGHT, swing=SWING)
    return sent(plant, sample, level + kick, Command(measurement=measurement, note=note))


def unseen(plant: Hanging, measurement: Estimate, way: Sent, level: Vector3) -> Sent:
    """Return the way back to level, and the end, where a look does not show the centre of mass."""
    why = (*one_reason(LawReason.HEIGHT_NOT_SHOWN), *measurement.outcome.reasons)
    longest = DURATION + 2 * float(np.linalg.norm(way.goal - level)) / plant.slew + PATIENCE
    return Sent(level, Command(shift=level, finished=why), way.late + longest)


def sent(plant: Hanging, sample: Sample, goal: Vector3, then: Command) -> Sent:
    """Return masses on their way to a shift (m)."""
    longest = 2 * float(np.linalg.norm(goal - sample.shift)) / plant.slew + PATIENCE
    return Sent(goal, then, sample.t + longest)


def on_the_way(plant: Hanging, way: Sent, sample: Sample) -> Command:
    """Return the same again until the masses have arrived; then what follows."""
    off = float(np.linalg.norm(sample.shift - way.goal))
    there = off <= ARRIVED * max(plant.step, TINY) or sample.t >= way.late
    return way.then if there else Command(shift=way.goal)
