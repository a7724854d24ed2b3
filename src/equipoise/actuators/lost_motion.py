"""How a drive with backlash takes up its play, by its commands.

A nut that reverses first crosses its play and then takes the mass along. With s the side of the
play that it is at, 1 or -1 behind a travel that was long enough, and D the commanded travel since
its beginning,

    s -> clip(s + 2 D / b, -1, 1)        b: backlash

and the mass stands off its command by -b s / 2. Before the first travel s is unknown: 0.

Friction is not modelled: a mass that shakes in its play is not where it was left.
"""

from itertools import pairwise
from typing import NamedTuple

import numpy as np

from equipoise.actuators.stops import is_travelling
from equipoise.model.arrays import Series1

LEAST = 1e-5  # m, chosen: a lesser play, crossed in no time, counts as this


class Way(NamedTuple):
    """One travel."""

    first: int  # row
    last: int
    sign: float  # 1 or -1


class Play(NamedTuple):
    """How a play is taken up; both courses are straight between their knots.

    The side s of the play; the first two knots behind the start begin it. And the time at which the
    mass was commanded to where it is: it stands while the play is taken up, and makes up for that
    until the travel ends.
    """

    t: Series1  # s
    side: Series1
    gone: Series1  # s
    command_times: Series1  # s


def directions(t: Series1, d: Series1, speed: float) -> list[Way]:
    """Return every travel; a reversal ends one."""
    way = np.sign(np.diff(d)) * is_travelling(t, d, speed)
    turns = [0, *(np.flatnonzero(np.diff(way)) + 1), len(way)]
    return [Way(int(a), int(b), float(way[a])) for a, b in pairwise(turns) if b > a and way[a] != 0]


def play_of(t: Series1, d: Series1, ways: list[Way], backlash: float) -> Play:
    """Return how the play of a backlash (m) is taken up."""
    play, side = max(backlash, LEAST), 0.0
    knots, sides, gone, reported = [t[:1]], [np.zeros(1)], [t[:1]], [t[:1]]
    for first, last, sign in ways:
        rows = slice(first, last + 1)
        way = np.maximum.accumulate(np.abs(d[rows] - d[first]))
        turn = min(play * abs(sign - side) / 2, way[-1])
        crossed = np.append(way[way < turn], turn)
        knots.append(np.interp(crossed, way, t[rows]))
        sides.append(side + sign * 2 * crossed / play)
        side = sides[-1][-1]
        gone.append(np.array([t[first], knots[-1][-1], t[last]]))
        reported.append(t[[first, first, last]])
    return Play(*map(np.concatenate, (knots, sides, gone, reported)))


def command_times(play: Play | None, t: Series1) -> Series1:
    """Return when a mass was commanded to its position at ``t``; None: no play."""
    return t if play is None else np.interp(t, play.gone, play.command_times)
