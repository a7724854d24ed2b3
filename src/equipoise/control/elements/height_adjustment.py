"""Height adjustment of a platform that masses keep level: measure the depth, raise, level again.

A level platform at rest shows nothing of its height r.u. Masses move its centre of mass sideways by
SWING of its depth, which sets it swinging. A measurement follows, over the record from BEFORE that
move on: the known move determines the scale that free motion leaves open. Then the platform is
raised to SURE sds below the target and levelled again; the next measurement, from there, determines
the height that much better. When the sd is small enough, or after MOST_MEASUREMENTS, the platform
is levelled once more at SHALLOW below the target and raised by that. It is still then, and a camera
that is off plumb by an angle leaves no more than the angle times SHALLOW.

    shift along u = target.u - r_home.u - depth,       r_home of the last measurement

A law that levels the platform keeps a ``HeightSearch`` in its state. It calls ``continued`` at each
step before its own feedback, and ``levelling`` with the shift that this feedback requests.

Masses are sent first; the measurement or the end follows when they have arrived. A measurement that
does not show the centre of mass ends the law, with the reason.
"""

from dataclasses import dataclass, field, replace
from typing import NamedTuple

import numpy as np

from equipoise.control.elements.height_step import along_for, depth_for, is_known
from equipoise.control.elements.height_step import last_shift as shift_to_target
from equipoise.control.elements.tilt_pid import shift_at
from equipoise.control.law import Sample
from equipoise.control.plant.moving_means import Bounds, at_depth
from equipoise.control.plant.pendulum import Hanging, pair, shift_for, tilt_axes, triple
from equipoise.control.plant.settling import Rest, is_quiet, settle
from equipoise.control.plant.swing_estimates import shows
from equipoise.model.arrays import Floats, Vector3
from equipoise.model.command import Command, Measurement
from equipoise.model.estimate import COM, Estimate
from equipoise.model.reasons.law_reasons import LawReason
from equipoise.model.reasons.reason import Reason, one_reason

SWING = 0.06  # rad, chosen: 7 degrees from side to side
DURATION = 60.0  # s, chosen: three swings or more at first
BEFORE = 5.0  # s, chosen: of rest, in the record of a measurement
TINY = 1e-9  # m, chosen: a step of masses that have none
ARRIVED = 2.0  # motor steps, chosen
PATIENCE = 5.0  # s, chosen: beyond twice the travel, for fine masses that are slower


@dataclass(frozen=True, slots=True)
class Height:
    """Where the platform hangs."""

    along: float  # m, the shift along u
    depth: float  # m, as estimated
    measurements: int = 0
    known: bool = False  # to CLOSE, or as well as it will be


class Sent(NamedTuple):
    """Masses on their way."""

    goal: Vector3  # m, shift
    then: Command
    late: float  # s, when they should long have arrived


@dataclass(frozen=True, slots=True, eq=False)
class HeightSearch:
    """The progress of a law with the height."""

    plant: Hanging
    target: Vector3  # m
    height: Height
    rest: Rest = field(default_factory=Rest)  # of the levelling
    level: Vector3 | None = None  # m, the mean shift that last levelled the platform
    way: Sent | None = None  # None: the law levels


def height_search(plant: Hanging, target: Vector3) -> HeightSearch:
    """Return the beginning: the platform hangs at the plant's depth."""
    return HeightSearch(plant, target, Height(plant.lowered, plant.depth))


def continued(
    search: HeightSearch, sample: Sample | Estimate
) -> tuple[HeightSearch, Command | None]:
    """Return the search after a sample or a measurement, and its command; None: the law levels."""
    if isinstance(sample, Sample):
        return search, None if search.way is None else on_the_way(search.plant, search.way, sample)
    if shows(sample):
        return replace(search, height=raised(search, sample), rest=Rest(), way=None), None
    way = unobserved(search, sample)
    return replace(search, way=way), Command(shift=way.goal)


def levelling(
    search: HeightSearch, sample: Sample, shift: Vector3, bounds: Bounds
) -> tuple[HeightSearch, Command]:
    """Return the search after a sample for which the law requests a shift (m), and the command.

    The command is that shift until the platform is level and quiet within the bounds, which are
    those for the plant's first depth.
    """
    quiet = at_depth(bounds, search.plant.depth, search.height.depth)
    rest = settle(search.rest, sample, search.plant, quiet, level=True)
    if not is_quiet(rest, sample.t, quiet):
        return replace(search, rest=rest), Command(shift=shift)
    way = once_level(search, sample, rest.shift)
    return replace(search, level=rest.shift, way=way), Command(shift=way.goal)


def shift_at_height(search: HeightSearch, v: Floats) -> Vector3:
    """Return the shift (m) that gives v within reach, at the height that is wanted."""
    plant, along = search.plant, search.height.along
    return np.array(shift_at(tilt_axes(plant), triple(plant.up), pair(v), plant.reach, along))


def raised_note(search: HeightSearch) -> tuple[Reason, ...]:
    """Return the note of a command after a measurement that raised the platform."""
    return one_reason(LawReason.RAISED, depth=search.height.depth)


def raised(search: HeightSearch, estimate: Estimate) -> Height:
    """Return where to level next, after a measurement that shows the centre of mass."""
    up, measurements = search.plant.up, search.height.measurements + 1
    sd = float(np.sqrt(up @ estimate.covariance_of(COM) @ up))
    known = is_known(sd, measurements)
    depth = depth_for(sd, known)
    along = along_for(triple(up), triple(search.target), triple(estimate.com), depth)
    return Height(along, depth, measurements, known)


def last_shift(search: HeightSearch, level: Vector3) -> Vector3:
    """Return the shift (m) to the target from one that levels the platform at this height."""
    up, along = triple(search.plant.up), search.height.along + search.height.depth
    return np.array(shift_to_target(up, triple(level), triple(search.target), along))


def once_level(search: HeightSearch, sample: Sample, level: Vector3) -> Sent:
    """Return the next goal of the masses once the shift ``level`` (m) levels the platform."""
    plant, depth = search.plant, search.height.depth
    if search.height.known:
        last = last_shift(search, level)
        done = one_reason(LawReason.LEVEL_AT_TARGET)
        return sent(plant, sample, last, Command(shift=last, finished=done))
    kick = shift_for(plant, np.full(2, SWING * depth / np.sqrt(2)))
    since = max(sample.t - BEFORE, 0.0)
    measurement = Measurement(DURATION, "trajectory", hold=plant.still, use_prior=True, since=since)
    note = one_reason(LawReason.SWINGS_FOR_HEIGHT, swing=SWING)
    return sent(plant, sample, level + kick, Command(measurement=measurement, note=note))


def unobserved(search: HeightSearch, measurement: Estimate) -> Sent:
    """Return the way back to level, and the end, after a measurement that shows no com."""
    way, level = search.way, search.level
    assert way is not None
    assert level is not None
    why = (*one_reason(LawReason.HEIGHT_NOT_SHOWN), *measurement.outcome.reasons)
    longest = DURATION + 2 * float(np.linalg.norm(way.goal - level)) / search.plant.slew + PATIENCE
    return Sent(level, Command(shift=level, finished=why), way.late + longest)


def sent(plant: Hanging, sample: Sample, goal: Vector3, then: Command) -> Sent:
    """Return masses on their way to a shift (m)."""
    longest = 2 * float(np.linalg.norm(goal - sample.shift)) / plant.slew + PATIENCE
    return Sent(goal, then, sample.t + longest)


def on_the_way(plant: Hanging, way: Sent, sample: Sample) -> Command:
    """Return the request for the goal until the masses have arrived; then what follows."""
    off = float(np.linalg.norm(sample.shift - way.goal))
    there = off <= ARRIVED * max(plant.step, TINY) or sample.t >= way.late
    return way.then if there else Command(shift=way.goal)
