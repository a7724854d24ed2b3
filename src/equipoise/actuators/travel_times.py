"""How a mass travelled between the rows of its track, as unknowns of each travel.

A track is straight between rows; the mass was not. It departed somewhere between two rows, and
arrived somewhere between two others: late by tau_1 and tau_2,

    d(t) = d_log(t - tau),   tau = (1 - s) tau_1 + s tau_2,   s: 0 to 1 from departure to arrival
    d(t) = d_log(t) - [(1 - s) tau_1 + s tau_2] d_log'(t) + ...

How late is open within the slack of the first and the last step of a travel, dt - |dd| / v: of an
interval dt in which the mass went dd it travelled for |dd| / v, v being its speed. A start anywhere
in the slack moves the mean time of the step evenly within half of it to either side,

    sd = slack / sqrt(12)

A travel faster than v, such as a stepper's, tells nothing of the speed: its slack is the whole
step. A mass that was commanded so arrives as late as its path takes at v; one that was measured has
arrived. One step from rest to rest has one mean time, so one unknown. Rows at the corners of a
travel at v leave no slack.

Travels with short pauses between are one: steps of a stepper, which keep their phase to the rows or
change it slowly. In a record of very many travels pauses count as short until ``MOST`` are left.

Nor was the speed even between rows. A third unknown is how far the path bends as a smooth one,

    d(t) = d_log(t) + c [d_smooth(t) - d_log(t)]

with d_smooth the cubic of each step whose slopes at the rows are the mean speeds across them: c is
0 of a motor at even speed, 1 of a smooth ramp. At v a mass goes straight. Where it stood or went at
v in the next step, the cubic has the slope of that; a step between two such bends evenly about its
mean time, which is open already, and has no c.

Cannot see a path that bends otherwise between rows.
"""

from collections.abc import Sequence
from itertools import pairwise
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from equipoise.actuators.lags import is_command, slowness
from equipoise.actuators.stops import MassError, is_travelling, travels
from equipoise.model.arrays import Series1
from equipoise.model.recording import Samples
from equipoise.model.testbed import SlidingMass

DEPARTURE, ARRIVAL, SMOOTHNESS = "departure", "arrival", "smoothness"
PAUSE = 1.0  # s, chosen: far below the periods of a platform
MOST = 12  # travels of one mass, chosen: each costs two columns of the propagator
PARTS = 4  # of a step, chosen: the cubic as straight pieces, of the right speed in their middle
TAIL = 2  # rows before and behind a travel, chosen: there a smooth one is slower than ``STILL``
CORNER = 0.05  # of the speed on the other side of a row, chosen: less is standing still
SMOOTH = 1.0  # chosen: one sd of c
FASTER = 1.1  # times the stated speed, chosen: beyond it that says nothing of a travel


class TimedTravel(NamedTuple):
    """One travel, or some with short pauses between."""

    first: int  # row at which the mass still stood
    last: int  # row at which it stood again
    departure_sd: float  # s
    arrival_sd: float  # s
    path: float  # m
    slack: Series1  # s, of each of its steps
    smoothness_sd: float  # -
    speed: float  # m/s, the greatest of the mass

    @property
    def is_one_step(self) -> bool:
        """Say whether it lies between two neighbouring rows."""
        return self.last == self.first + 1


def merged_travels(t: Series1, d: Series1, speed: float) -> list[tuple[int, int]]:
    """Return first and last rows of travels, those with a short pause between as one."""
    found, pause = travels(t, d, speed), PAUSE
    while True:
        starts = [k for k in range(1, len(found)) if t[found[k][0]] - t[found[k - 1][1]] >= pause]
        bounds = [0, *starts, len(found)]
        if len(bounds) - 1 <= MOST or pause > t[-1] - t[0]:
            break
        pause *= 2
    groups = (found[a:b] for a, b in pairwise(bounds))
    return [(group[0][0], group[-1][1]) for group in groups if group]


def timed(t: Series1, d: Series1, speed: float) -> list[TimedTravel]:
    """Return every travel of one mass with what its rows leave open of its times."""
    commanded = is_command(d, is_travelling(t, d, speed))
    return [
        one_timed(np.diff(t[a : b + 1]), np.abs(np.diff(d[a : b + 1])), speed, commanded, a)
        for a, b in merged_travels(t, d, speed)
    ]


def one_timed(
    steps: Series1, ways: Series1, speed: float, commanded: bool, first: int
) -> TimedTravel:
    """Return the travel of these steps (s) and ways (m) from a row on."""
    under_way = ways / speed
    faster = bool(np.any(under_way > FASTER * steps))
    slack: Series1 = steps if faster else np.maximum(steps - under_way, 0.0)
    slack = np.where(slack > (1 - 1 / FASTER) * steps, slack, 0.0)  # rounded speeds are no slack
    if not faster:
        slack[1:-1] = 0.0  # within a travel, slower than the greatest speed is a speed
    later = max(float(under_way.sum() - steps.sum()), 0.0) if commanded else 0.0
    sd = slack / np.sqrt(12)
    arrival_sd = float(np.hypot(sd[-1], later))
    last, path = first + len(steps), float(ways.sum())
    return TimedTravel(first, last, float(sd[0]), arrival_sd, path, slack, SMOOTH, speed)


def unresolved_steps(track: Samples, masses: Sequence[SlidingMass]) -> NDArray[np.bool_]:
    """Say of each step between rows, (n - 1, k), which mass travels in an unknown part of it."""
    found = np.zeros((len(track) - 1, len(masses)), dtype=bool)
    for i, mass in enumerate(masses):
        for travel in timed(track.t, track.values[:, i], mass.speed):
            found[travel.first : travel.last, i] |= travel.slack > 0
    return found


def bent_rows(track: Samples, travel: TimedTravel) -> slice:
    """Return the rows between which a travel bends: a smooth one begins and ends unnoticed."""
    return slice(max(travel.first - TAIL, 0), travel.last + 1 + TAIL)


def fine_times(track: Samples, travel: TimedTravel) -> Series1:
    """Return the rows between which a travel bends, and ``PARTS`` - 1 times between each two."""
    t = track.t[bent_rows(track, travel)]
    return np.interp(np.arange((len(t) - 1) * PARTS + 1) / PARTS, np.arange(len(t)), t)


def end_slopes(t: Series1, d: Series1, greatest: float) -> tuple[Series1, Series1]:
    """Return by how much a smooth path is faster than each step at its begin and its end, m/s."""
    steps, speeds = np.diff(t), np.diff(d) / np.diff(t)
    straight = (np.abs(speeds) > greatest / FASTER) & (np.abs(speeds) < greatest * FASTER)
    before, after = speeds[:-1], speeds[1:]
    slow, fast = np.sort(np.abs([before, after]), axis=0)
    alike = before * after > 0
    passing = alike & (slow > CORNER * fast) & ~(straight[:-1] | straight[1:])
    across = (d[2:] - d[:-2]) / (steps[:-1] + steps[1:])
    bent = ~straight & (np.append(passing, False) | np.append(False, passing))
    first = np.append(0.0, np.where(passing, across, alike * before)) - speeds
    last = np.append(np.where(passing, across, alike * after), 0.0) - speeds
    return bent * first, bent * last


def bend(t: Series1, track: Samples, i: int, travel: TimedTravel) -> Series1:
    """Return d_smooth - d_log of mass i in a travel at times ``t``, m: Hermite's cubics."""
    rows = bent_rows(track, travel)
    at, d = track.t[rows], track.values[rows, i]
    first, last = end_slopes(at, d, travel.speed)
    k = np.clip(np.searchsorted(at, t, side="right") - 1, 0, len(first) - 1)
    length = np.diff(at)[k]
    u = np.clip((t - at[k]) / length, 0.0, 1.0)
    return length * u * (1 - u) * (first[k] * (1 - u) - last[k] * u)


def bends_openly(track: Samples, i: int, travel: TimedTravel, least: float) -> bool:
    """Say whether the time integral of the bend, m s, exceeds ``least`` anywhere in a travel."""
    t = fine_times(track, travel)
    ahead = bend(t, track, i, travel)
    area = np.cumsum(0.5 * (ahead[1:] + ahead[:-1]) * np.diff(t))
    return travel.smoothness_sd * float(np.abs(area).max()) > least


def open_travels(track: Samples, i: int, mass: SlidingMass, least: float) -> dict[int, TimedTravel]:
    """Return by number the travels of one mass that are open by so much that it shows."""
    found: dict[int, TimedTravel] = {}
    for k, travel in enumerate(timed(track.t, track.values[:, i], mass.speed)):
        late = travel.path * max(travel.departure_sd, travel.arrival_sd) > least / mass.mass
        known = {} if late else {"departure_sd": 0.0, "arrival_sd": 0.0}
        if not bends_openly(track, i, travel, least / mass.mass):
            known["smoothness_sd"] = 0.0
        if late or "smoothness_sd" not in known:
            found[k + 1] = travel._replace(**known)
    return found


def reach(sd: float) -> float:
    """Return how late a time is at most, s, that is evenly spread with an sd."""
    return float(np.sqrt(3)) * sd


def bends(track: Samples, found: dict[int, TimedTravel]) -> list[Series1]:
    """Return the times at which the effects of what is open of travels bend."""
    fine = [fine_times(track, travel) for travel in found.values() if travel.smoothness_sd > 0]
    return fine + [
        track.t[travel.first : travel.last + 1] + sign * reach(sd)
        for travel in found.values()
        for sd in (travel.departure_sd, travel.arrival_sd)
        for sign in (-1, 1)
        if sd > 0
    ]


def effect(t: Series1, track: Samples, i: int, travel: TimedTravel, sd: float) -> Series1:
    """Return minus the speed of mass i in a travel, over ``reach`` to either side, m/s."""
    rows = slice(travel.first, travel.last + 1)
    return slowness(t, Samples(track.t[rows], track.values[rows]), i, reach(sd))


def travel_errors(
    t: Series1, track: Samples, i: int, name: str, found: dict[int, TimedTravel]
) -> list[MassError]:
    """Return the unknown times and paths of the travels of mass i: their effect at times ``t``."""
    errors: list[MassError] = []
    for k, travel in found.items():
        share = np.interp(t, track.t[[travel.first, travel.last]], [0.0, 1.0])
        ends = [(DEPARTURE, travel.departure_sd, 1 - share), (ARRIVAL, travel.arrival_sd, share)]
        if travel.is_one_step:
            ends = [(DEPARTURE, max(travel.departure_sd, travel.arrival_sd), np.ones_like(t))]
        errors += [
            MassError(f"{end}_{name}_{k}", sd, [(i, effect(t, track, i, travel, sd) * weight)])
            for end, sd, weight in ends
            if sd > 0
        ]
        if travel.smoothness_sd > 0:
            response = [(i, bend(t, track, i, travel))]
            errors.append(MassError(f"{SMOOTHNESS}_{name}_{k}", travel.smoothness_sd, response))
    return errors
