"""Between levelling and levelling: see how deep the platform hangs, and raise it.

A level platform at rest shows nothing of its height r.u. It is set swinging by moving the centre
of mass sideways by SWING of its depth, and looked at with the masses still. Free motion alone fixes
the centre of mass up to the scale of the inertia, so the height is known to a share of itself only:
the platform is raised to SURE sds below the target, levelled again, and the next look, from there,
sees it so much better. When the sd is small enough, or after MOST_LOOKS, it is levelled once more
at SHALLOW below the target, and raised by that: it is still then, and a camera that is off plumb
by an angle leaves no more than the angle times SHALLOW.

    shift along u = target.u - r_home.u - depth,       r_home of the last look

What the looks do not see (an estimate that is not usable, or does not hold the centre of mass) is
left as it was, and said.
"""

from dataclasses import dataclass

import numpy as np

from equipoise.control.hanging import Hanging, shift_for
from equipoise.model.arrays import Vector3
from equipoise.model.command import Command, Look
from equipoise.model.estimate import COM, Estimate

SWING = 0.06  # rad, chosen: 7 degrees from side to side
LOOK = Look(60.0, "trajectory")  # chosen: three swings or more at first
SURE = 3.0  # sds, chosen
SHALLOW = 1e-5  # m, chosen: a swing of a minute or two
CLOSE = 1e-6  # m, chosen: one sd of the height at which no further look is needed
MOST_LOOKS = 4  # chosen: each takes the sd to a third or less


@dataclass(frozen=True, slots=True)
class Height:
    """Where the platform hangs, and what is known of it."""

    along: float  # m, the shift along u
    depth: float  # m, as believed
    looks: int = 0
    known: bool = False  # to CLOSE, or as well as it will be


def sees(seen: Estimate) -> bool:
    """Say whether a look shows the centre of mass."""
    return seen.outcome.usable and seen.sees(COM)


def raised(plant: Hanging, height: Height, seen: Estimate, target: Vector3) -> Height:
    """Return where to level next, after a look that sees the centre of mass."""
    up, looks = plant.up, height.looks + 1
    sd = float(np.sqrt(up @ seen.covariance_of(COM) @ up))
    known = sd <= CLOSE or looks >= MOST_LOOKS
    depth = SHALLOW if known else max(SURE * sd, SHALLOW)
    return Height(float(up @ (target - seen.com)) - depth, depth, looks, known)


def last_shift(plant: Hanging, height: Height, level: Vector3, target: Vector3) -> Vector3:
    """Return the shift (m) to the target from one that levels the platform at this height."""
    up = plant.up
    sideways: Vector3 = level + target
    return sideways - up * (up @ sideways) + up * (height.along + height.depth)


def once_level(plant: Hanging, height: Height, level: Vector3, target: Vector3) -> Command:
    """Return what follows where this shift (m) levels the platform: a look, or the end."""
    if height.known:
        last = last_shift(plant, height, level, target)
        return Command(shift=last, finished="level, and raised to the target")
    kick = shift_for(plant, np.full(2, SWING * height.depth / np.sqrt(2)))
    note = f"level; the masses swing it by {np.degrees(SWING):.1f} deg for a look at its height"
    return Command(shift=level + kick, look=LOOK, note=note)


def unseen(seen: Estimate, level: Vector3) -> Command:
    """Return the end where a look does not show the centre of mass."""
    why = f"level; its height was not seen: {seen.outcome.sentence}"
    return Command(shift=level, finished=why)
