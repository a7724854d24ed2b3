"""Positions of masses between two answers of their board.

A mass goes at its own speed or stands. Straight lines from answer to answer would show it creeping
where it starts and where it arrives, and the detection of moves in a recording would miss it.
So a row is put in where it started, as long before the answer as the way takes, and where it
arrived, as long after the answer before.

Answers come when they come, some ms early or late: on the way a mass seems to go too fast or too
slowly. That is left as it is; an answer that shows a mass on its way having hardly gone is not
kept, or it would count as a stop. A mass that has hardly gone for longer than answers are late by
is sent on by little and little, as a law does, and where it is has to be known.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from equipoise.hardware.transport.driver_protocol import POLL_MOVING, BoardState, Phase
from equipoise.model.arrays import Bools, Series1
from equipoise.model.hardware import Axis

HARDLY = 0.5  # of the way that it could have gone, chosen: late by half the time between answers
LATE = 1.5 * POLL_MOVING  # s, chosen: an answer late by more than half the time between two is rare
DIGITS = 1e-6  # m, chosen: the last digit of what a board says


@dataclass(frozen=True, slots=True, eq=False)
class Answer:
    """Where masses were (m) at a time (s), and which of them moved and were not there yet."""

    t: float
    at: Series1
    going: Bools


def on_the_way(state: BoardState, axes: Sequence[Axis]) -> dict[str, bool]:
    """Return of each mass of a board whether it is not yet where it was sent."""
    moving = state.phase in (Phase.MOVING, Phase.HOMING)
    return {
        axis.mass: moving and _short_of(state.position, state.goal, axis)
        for axis in axes
        if axis.mass in state.position
    }


def rows_to(
    before: Answer, t: float, at: Series1, wants: Bools, speed: Series1
) -> tuple[list[Answer], Answer]:
    """Return the rows after an answer up to the next one, and the answer to go on from.

    ``wants``: which masses are not yet where they were sent; ``speed``: m/s, each mass's own.
    """
    gap = t - before.t
    taken = np.minimum(np.abs(at - before.at) / speed, gap)
    if gap < LATE and bool(np.any(before.going & wants & (taken < HARDLY * gap))):
        return [], before
    gone = taken > 0
    new = Answer(t, at, wants & (gone | before.going))
    start = np.where(before.going, before.t, t - taken)
    end = np.where(before.going & ~wants, before.t + taken, t)
    corners = np.unique(np.concatenate([start[gone], end[gone]]))
    corners = corners[(corners > before.t) & (corners < t)]
    length = np.where(gone, end - start, 1.0)
    rows = [
        Answer(float(c), before.at + np.clip((c - start) / length, 0, 1) * (at - before.at), wants)
        for c in corners
    ]
    return [*rows, new], new


def _short_of(position: Mapping[str, float], goal: Mapping[str, float], axis: Axis) -> bool:
    """Say whether a mass is farther from its goal than a step and the last digit."""
    away = abs(position[axis.mass] - goal.get(axis.mass, position[axis.mass]))
    return away > 1.0 / axis.steps_per_m + DIGITS
