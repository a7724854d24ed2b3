"""The last part of a law that has levelled a hanging platform: see how deep it hangs, and raise it.

A level platform at rest shows nothing of r.u. It is set swinging by moving the centre of mass
sideways by SWING of its depth, and looked at with the masses still. Free motion alone fixes the
centre of mass up to the scale of the inertia, so r.u is known to a share of itself only: masses
raise it to SURE sds below the target, and the next look, from there, sees it so much better. When
the sd is small enough, or after MOST_LOOKS, the masses go to

    s = target - r_home,    r_home of the last look, on all three axes.

What the looks cannot see (an estimate that is not usable, or does not hold the centre of mass) is
left as the level loop left it, and said.
"""

from typing import NamedTuple

import numpy as np

from equipoise.control.hanging import Hanging, shift_for
from equipoise.model.arrays import Vector3
from equipoise.model.command import Command, Look
from equipoise.model.estimate import COM, Estimate

SWING = 0.06  # rad, chosen: half the swing; 7 degrees at most on the first look
LOOK = Look(60.0, "trajectory")  # chosen: three swings or more
SURE = 3.0  # sds, chosen
CLOSE = 1e-6  # m, chosen: one sd of the height at which no further look is needed
MOST_LOOKS = 4  # chosen: each takes the sd to a third or less


class Looking(NamedTuple):
    """Where it stands."""

    level: Vector3  # m, the shift that levels the platform
    looks: int = 0


def set_swinging(plant: Hanging, level: Vector3) -> tuple[Looking, Command]:
    """Return the first look of a platform that is level with this shift (m)."""
    kick = shift_for(plant, np.full(2, SWING * plant.depth / np.sqrt(2)))
    note = f"level; the masses swing it by {np.degrees(SWING):.1f} deg for a look at its height"
    return Looking(level), Command(shift=level + kick, look=LOOK, note=note)


def after_look(
    plant: Hanging, looking: Looking, seen: Estimate, target: Vector3
) -> tuple[Looking, Command]:
    """Return what follows a look: another from further up, or the end."""
    looking = looking._replace(looks=looking.looks + 1)
    if not (seen.outcome.usable and seen.sees(COM)):
        why = f"level; its height was not seen: {seen.outcome.sentence}"
        return looking, Command(shift=looking.level, finished=why)
    shift, up = target - seen.com, plant.up
    sd = float(np.sqrt(up @ seen.covariance_of(COM) @ up))
    if sd <= CLOSE or looking.looks >= MOST_LOOKS:
        why = f"level, and raised to the target by a look that knows it to {sd * 1e6:.2g} um"
        return looking, Command(shift=shift, finished=why)
    note = f"raised to {SURE * sd * 1e6:.3g} um below the target for another look"
    return looking, Command(shift=shift - SURE * sd * up, look=LOOK, note=note)
