"""Which move to make: straight to the target, or first a brake when that would tilt too far.

A brake is a move to the far side of the target and below it, which stops the fall; the target
comes next. Of the brakes that keep the tilt within the guard the nearest to the target is taken,
else the one with the least tilt.
"""

from collections.abc import Iterator
from dataclasses import dataclass, replace

from equipoise.model.arrays import Floats, Vector3
from equipoise.procedure.steps.displacement_choice import displacements_for
from equipoise.procedure.steps.joint_fit import stood
from equipoise.procedure.steps.tilt_prediction import Outlook

CALM = 0.5  # of the tilt limit, chosen: a peak at which the moment does not matter
WAITS = (0.6, 1.2, 2.4, 4.0, 6.0, 9.0, 12.0)  # s
HASTE = 30.0  # mm per s, weighs time against travel when a brake is needed
SIDEWAYS = (0.0, 0.5, 1.0, 1.5)  # of the present sideways offset, to the far side
DOWN = 100e-6  # m below the target: stiffer, and a larger known change to learn the scale from


@dataclass(frozen=True, slots=True, eq=False)
class Option:
    """A move and the tilt it should lead to."""

    targets: Floats  # m
    peak: float  # rad
    brake: bool


def option_for(view: Outlook, aim: Vector3, brake: bool = False, haste: float = 0.0) -> Option:
    """Return the move that brings the centre of mass to ``aim`` (m)."""
    now, shift = view.knowledge.displacement, aim - view.knowledge.com
    goal = displacements_for(view.testbed, now, shift, haste, stood(view.knowledge, view.testbed))
    return Option(goal, view.peak(goal), brake)


def good_moment(view: Outlook, option: Option) -> bool:
    """Say whether beginning this move later would not lead to clearly less tilt."""
    if option.peak <= CALM * view.testbed.tilt_limit:
        return True
    later = (replace(view, wait=wait).peak(option.targets) for wait in WAITS)
    return all(option.peak <= 1.05 * peak for peak in later)


def catches(view: Outlook, target: Vector3, may_brake: bool) -> Iterator[Option]:
    """Yield hasty moves that stop the platform from falling, the smallest first.

    They go to below the target, then to below and beyond it.
    """
    up, offset = view.testbed.up, view.knowledge.com - target
    sideways = offset - (offset @ up) * up
    for share in SIDEWAYS if may_brake else SIDEWAYS[:1]:
        aim = target - share * sideways - DOWN * up
        yield option_for(view, aim, share > 0, HASTE)


def safest(view: Outlook, target: Vector3, may_brake: bool) -> Option:
    """Return the smallest move that keeps the tilt within the guard, else the least tilting one."""
    options: list[Option] = []
    for option in catches(view, target, may_brake):
        options.append(option)
        if option.peak <= view.guard:
            return option
    return min(options, key=lambda option: option.peak)
