"""Where masses stood still in a recording, and the effect of the error of a stop.

A mass that is commanded to d stops at d + error, with one error for each stop. Between stops the
error changes in proportion to the travel of the mass, which waits while a play is taken up
(``lost_motion``). At home the error is zero by definition: home is where the mass properties are
stated. A mass that is logged in steps is at one place for a moment: an error there says how far it
really was between two steps. Where there are very many, such a travel is one, without them.
"""

from collections.abc import Sequence
from functools import lru_cache
from itertools import pairwise
from typing import NamedTuple

import numpy as np

from equipoise.model.arrays import Bools, Floats, Series1
from equipoise.model.recording import Samples
from equipoise.model.testbed import SlidingMass

STILL = 0.05  # of the mass's speed, chosen: slower than this is standing still
MANY = 30  # stops of one mass, chosen: a search carries the errors of so many
ROUGH = 0.25  # of a step, chosen: an accuracy that rounding gives, q / sqrt(12), or worse
ALIKE = 0.1  # of a step, chosen: rounding of logs
CORNERS = 4  # chosen: of a commanded travel, which waits for other masses
KEPT = 4  # rows to either side of a change, chosen: what belongs to a travel looks at two
REACH = 3.0  # s, chosen, and as long to either side: lags are far shorter
STAND = 0.5  # s, chosen: between two steps of one travel, or less


class MassError(NamedTuple):
    """One unknown, and the masses on which it acts."""

    name: str
    sd: float  # in its unit: m of a stop, s of a lag
    response: list[tuple[int, Series1]]  # index of the rail; displacement by unknown


def is_travelling(t: Series1, d: Series1, speed: float) -> Bools:
    """Say of each step between rows whether one mass travels in it."""
    return np.abs(np.diff(d)) > STILL * speed * np.diff(t)


def travels(t: Series1, d: Series1, speed: float) -> list[tuple[int, int]]:
    """Return first and last row of every travel of one mass."""
    edges = np.diff(np.concatenate([[0], is_travelling(t, d, speed).astype(int), [0]]))
    first, last = np.flatnonzero(edges == 1), np.flatnonzero(edges == -1)
    return [(int(a), int(b)) for a, b in zip(first, last, strict=True)]


def joined(t: Series1, travelled: list[tuple[int, int]], pause: float) -> list[tuple[int, int]]:
    """Return first and last rows of travels, those with less than ``pause`` (s) between as one."""
    starts = [k for k, (a, b) in enumerate(pairwise(travelled), 1) if t[b[0]] - t[a[1]] >= pause]
    bounds = [0, *starts, len(travelled)]
    groups = (travelled[a:b] for a, b in pairwise(bounds))
    return [(group[0][0], group[-1][1]) for group in groups if group]


def stand_of(mass: SlidingMass) -> float:
    """Return how long (s) a mass must be at one place in a log to stand there.

    One that travels as slowly as counts is logged at the same place for resolution / speed.
    """
    return max(STAND, mass.resolution / (STILL * mass.speed))


def is_rounded(mass: SlidingMass) -> bool:
    """Say whether a mass may well stand between the steps in which it is logged."""
    return mass.resolution > 0 and mass.accuracy >= ROUGH * mass.resolution


def is_logged_in_steps(t: Series1, d: Series1, mass: SlidingMass) -> bool:
    """Say whether displacements are measured in steps: so a travel passes some of them.

    One that was commanded is at its ends, at a corner or two, or on its way at any place.
    """
    if not is_rounded(mass):
        return False
    steps = d / mass.resolution
    whole = np.round(steps)
    if np.any(np.abs(steps - whole) > ALIKE):
        return False
    ways = joined(t, travels(t, d, mass.speed), stand_of(mass))
    return any(len(np.unique(whole[a : b + 1])) > CORNERS for a, b in ways)


def response(t: Series1, arrival: tuple[int, int], departure: tuple[int, int]) -> Floats:
    """Return the share of the error of one stop at each row: up, on, down."""
    before, after = t[list(arrival)], t[list(departure)]
    knots = [before[0], before[1], after[0], after[1]]
    levels = [float(arrival[1] == arrival[0]), 1.0, 1.0, float(departure[1] == departure[0])]
    return np.interp(t, knots, levels)


def stops_of(t: Series1, d: Series1, mass: SlidingMass) -> list[Floats]:
    """Return the share of the error of each stop of one mass at each row, home excepted."""
    ways = travels(t, d, mass.speed)
    if len(ways) > MANY:
        ways = joined(t, ways, stand_of(mass))
    bounds = [(0, 0), *ways, (len(d) - 1, len(d) - 1)]
    stands = [response(t, bounds[k], bounds[k + 1]) for k in range(len(bounds) - 1)]
    return stands if abs(d[0]) > mass.accuracy else stands[1:]


def stop_errors(
    reported: Sequence[Series1], track: Samples, masses: tuple[SlidingMass, ...]
) -> list[MassError]:
    """Return an unknown displacement for each stop of a mass that stops with an accuracy.

    The error of mass i acts when the mass has gone as far as commanded at times ``reported[i]``.
    """
    return [
        MassError(f"error_{mass.name}_{k + 1}", mass.accuracy, [(i, np.interp(t, track.t, stand))])
        for i, (mass, t) in enumerate(zip(masses, reported, strict=True))
        if mass.accuracy > 0
        for k, stand in enumerate(stops_of(track.t, track.values[:, i], mass))
    ]


def changing_rows(track: Samples) -> Samples:
    """Return the first row and those near a change, as one object for all tracks that share them.

    A record that grows has a row for every look while all masses stand. What a travel leaves open
    (``mass_errors``) is in the rows about it; those with nothing but standing around them add
    nothing. So what is kept by identity of a track is kept until the next travel.
    """
    changed = np.any(track.values[1:] != track.values[:-1], axis=1)
    changes, t = np.append(0, np.cumsum(changed)), track.t
    ahead = np.searchsorted(t, t + REACH, side="right") - 1 + KEPT
    behind = np.searchsorted(t, t - REACH) - KEPT
    near = changes[np.minimum(ahead, len(t) - 1)] > changes[np.maximum(behind, 0)]
    near[:1] = True
    if near.all():
        return track
    rows = track.where(near)
    return _one_of(rows.t.tobytes(), rows.values.tobytes(), rows.values.shape[1])


@lru_cache(maxsize=4)
def _one_of(t: bytes, values: bytes, columns: int) -> Samples:
    found: Floats = np.frombuffer(values).reshape(-1, columns)
    return Samples(np.frombuffer(t), found)
