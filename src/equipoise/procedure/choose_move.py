"""Which move to make: straight to the target, or first a brake when that would tilt too far.

A brake is a move to the far side of the target and below it, which stops the fall; the target
comes next. Of the brakes that keep the tilt within the guard the nearest to the target is taken,
else the one with the least tilt.
"""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from equipoise.actuators.sliding_masses import (
    com_shift_covariance,
    displacements_for,
    mass_maps,
)
from equipoise.model.arrays import Floats, Quaternion, Vector3
from equipoise.model.move import Move
from equipoise.model.testbed import Testbed
from equipoise.procedure.foresight import peak_tilt
from equipoise.procedure.knowledge import Knowledge, shifted

GUARD = 0.75  # of the tilt limit, chosen
HASTE = 30.0  # mm per s, weighs time against travel when a brake is needed
SIDEWAYS = (0.5, 1.0, 1.5)  # of the present sideways offset, to the far side
DOWN = (0.0, 40e-6)  # m


@dataclass(frozen=True, slots=True, eq=False)
class Option:
    """A move and the tilt it should lead to."""

    targets: Floats  # m
    peak: float  # rad
    brake: bool


def direct(
    knowledge: Knowledge,
    testbed: Testbed,
    state: tuple[Quaternion, Vector3],
    target: Vector3,
    wait: float = 0.0,
) -> Option:
    """Return the move straight to the target (m), beginning after ``wait`` (s)."""
    now = knowledge.displacement
    goal = displacements_for(testbed.masses, testbed.body.mass, now, target - knowledge.com)
    return Option(goal, peak_tilt(knowledge, testbed, state, goal, wait), False)


def brakes(
    knowledge: Knowledge, testbed: Testbed, state: tuple[Quaternion, Vector3], target: Vector3
) -> Iterator[Option]:
    """Yield moves beyond the target, the mildest first."""
    now, offset = knowledge.displacement, knowledge.com - target
    sideways = offset - (offset @ testbed.up) * testbed.up
    for share in SIDEWAYS:
        for down in DOWN:
            aim = target - share * sideways - down * testbed.up
            shift = aim - knowledge.com
            goal = displacements_for(testbed.masses, testbed.body.mass, now, shift, HASTE)
            yield Option(goal, peak_tilt(knowledge, testbed, state, goal, 0.0), True)


def best_option(
    knowledge: Knowledge,
    testbed: Testbed,
    state: tuple[Quaternion, Vector3],
    target: Vector3,
    may_brake: bool,
) -> Option:
    """Return the move to make now."""
    straight = direct(knowledge, testbed, state, target)
    guard = GUARD * testbed.tilt_limit
    if straight.peak <= guard or not may_brake:
        return straight
    options = [straight]
    for option in brakes(knowledge, testbed, state, target):
        if option.peak <= guard:
            return option
        options.append(option)
    return min(options, key=lambda option: option.peak)


def move_of(knowledge: Knowledge, testbed: Testbed, option: Option, reason: str) -> Move:
    """Return the move with what it should lead to."""
    now = knowledge.displacement
    change = option.targets - now
    speed = np.array([mass.speed for mass in testbed.masses])
    accuracy = np.array([mass.accuracy for mass in testbed.masses])
    stop = com_shift_covariance(
        mass_maps(testbed.masses), testbed.body.mass, accuracy, (change != 0).astype(float)
    )
    return Move(
        targets={m.name: float(d) for m, d in zip(testbed.masses, option.targets, strict=True)},
        travel=float(np.abs(change).sum()),
        duration=float((np.abs(change) / speed).max()),
        predicted_com=shifted(knowledge, testbed, option.targets),
        predicted_covariance=knowledge.covariance + stop,
        reason=reason,
    )
