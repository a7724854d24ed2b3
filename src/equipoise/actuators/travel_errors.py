"""When a mass departed and arrived between the rows of its track, as unknowns of each travel.

Late by tau_1 at its departure and by tau_2 at its arrival (``travel_times``: how late is open),

    d(t) = d_log(t) - tau_1 e_1(t) - tau_2 e_2(t)

A mass that was measured in one step or two was between rows where these say, however late within
the step. So e is of the first or the last step alone, dd / dt on average; a triangle of twice that
height comes nearest to a jump anywhere in the step: its third moments in time are wrong by
0.02 dd dt^3 rms.

A jump at tau, drawn as a ramp over the step, has another second moment in time, too, so that the
platform turns by another angle within the step where its rate is the same behind. Each open step
has one unknown more, mass that passes from its first half to its second or back, a triangle each:

    d(t) = d_log(t) +- x 8 dd / dt,   x = (tau^2 - slack^2 / 12) / (2 dt)
    sd = slack^2 / (2 dt sqrt(180))   for tau spread evenly over the slack

A longer travel may be one of a stepper, at any phase to the rows, and a command may be reached
behind its last row: these are late by degrees, s going from 0 to 1 from departure to arrival:

    d(t) = d_log(t - tau) = d_log(t) - tau d_log'(t) + ...,   tau = (1 - s) tau_1 + s tau_2

Nor was the speed even between rows. One unknown more is how smooth the path is,

    d(t) = d_log(t) + c [d_smooth(t) - d_log(t)]

with d_smooth the cubic of each step whose slopes at the rows are the mean speeds across them: c is
0 of a motor at even speed, 1 of a smooth ramp. At v a mass goes straight. Where it stood or went at
v in the next step, the cubic has the slope of that; a step between two such bends evenly about its
mean time, which is open already, and has no c.

Cannot see a path that bends otherwise between rows.
"""

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from equipoise.actuators.lags import slowness
from equipoise.actuators.travel_times import FASTER, TimedTravel, timed
from equipoise.maths.sampled.running_integral import by_trapezia
from equipoise.model.arrays import Bools, Series1
from equipoise.model.recording import Samples
from equipoise.model.testbed import SlidingMass

DEPARTURE, ARRIVAL, SPREAD, SMOOTHNESS = "departure", "arrival", "spread", "smoothness"
QUARTERS = np.linspace(0.0, 1.0, 5)  # of a step
PARTS = 4  # of a step, chosen: the cubic as straight pieces, of the right speed in their middle
TAIL = 2  # rows before and behind a travel, chosen: there a smooth one is slower than ``STILL``
CORNER = 0.05  # of the speed on the other side of a row, chosen: less is standing still
SMOOTH = 1.0  # chosen: one sd of c


class OpenTime(NamedTuple):
    """An unknown of a travel and the displacement by it, m: straight between its corners."""

    name: str
    sd: float
    corners: Series1  # s
    effect: Series1

    def at(self, t: Series1) -> Series1:
        """Return the displacement by the unknown at times; zero beyond the corners."""
        return np.interp(t, self.corners, self.effect, left=0.0, right=0.0)


def open_times(track: Samples, i: int, mass: SlidingMass, least: float) -> Iterator[OpenTime]:
    """Yield what changes the time integral of a first moment by more than ``least`` (kg m s).

    The sd of a travel's times are the largest of what it leaves open but for its path.
    """
    uneven = _uneven(track.t, track.values[:, i], mass.speed)
    for k, travel in enumerate(timed(track.t, track.values[:, i], mass.speed), 1):
        name, moved = f"{mass.name}_{k}", mass.mass * travel.path
        if moved * max(travel.departure_sd, travel.arrival_sd) > least:
            by_degrees = travel.is_late or travel.is_long
            times = (_by_degrees if by_degrees else _of_ends)(track, i, name, travel)
            yield from (each for each in times if moved * each.sd > least)
        if uneven[max(travel.first - TAIL, 0) : travel.last + TAIL].any():
            smooth = _smooth(track, i, name, travel, mass.speed)
            area = by_trapezia(smooth.corners, smooth.effect)
            if mass.mass * smooth.sd * float(np.abs(area).max()) > least:
                yield smooth


def _uneven(t: Series1, d: Series1, greatest: float) -> Bools:
    """Say of each step whether a mass neither stands nor goes straight: without two, no bend."""
    speeds = np.diff(d) / np.diff(t)
    return (speeds != 0) & ~_is_straight(speeds, greatest)


def _is_straight(speeds: Series1, greatest: float) -> Bools:
    """Say of each step whether a mass goes as fast (m/s) as it can, at even speed."""
    return (np.abs(speeds) > greatest / FASTER) & (np.abs(speeds) < greatest * FASTER)


def _of_ends(track: Samples, i: int, name: str, travel: TimedTravel) -> Iterator[OpenTime]:
    """Yield lateness and spread of the first and the last step, where these are open."""
    ends = {0: DEPARTURE} if travel.is_one_step else {0: DEPARTURE, len(travel.slack) - 1: ARRIVAL}
    for k, end in ends.items():
        slack, rows = float(travel.slack[k]), slice(travel.first + k, travel.first + k + 2)
        if slack == 0:
            continue
        (start, stop), (a, b) = track.t[rows], track.values[rows, i]
        corners, speed = start + (stop - start) * QUARTERS, float((b - a) / (stop - start))
        late = -2 * speed * np.array([0.0, 0.5, 1.0, 0.5, 0.0])
        yield OpenTime(f"{end}_{name}", slack / np.sqrt(12), corners, late)
        sd = slack**2 / (2 * np.sqrt(180) * (stop - start))
        passed = 8 * speed * np.array([0.0, 1.0, 0.0, -1.0, 0.0])
        yield OpenTime(f"{SPREAD}_{end}_{name}", sd, corners, passed)


def _by_degrees(track: Samples, i: int, name: str, travel: TimedTravel) -> Iterator[OpenTime]:
    """Yield the times of a travel that is late by degrees, blurred by as much as it may be late."""
    rows = slice(travel.first, travel.last + 1)
    part = Samples(track.t[rows], track.values[rows])
    sds = travel.departure_sd, travel.arrival_sd
    if not any(sds):
        return
    knots = [part.t + sign * np.sqrt(3) * sd for sd in sds for sign in (-1, 1) if sd > 0]
    corners = np.unique(np.concatenate(knots))
    share = np.interp(corners, part.t[[0, -1]], [0.0, 1.0])
    ends = [(DEPARTURE, sds[0], 1 - share), (ARRIVAL, sds[1], share)]
    if travel.is_one_step:
        ends = [(DEPARTURE, max(sds), np.ones_like(corners))]
    for end, sd, weight in ends:
        if sd > 0:
            effect = weight * slowness(corners, part, i, np.sqrt(3) * sd)
            yield OpenTime(f"{end}_{name}", sd, corners, effect)


def _smooth(track: Samples, i: int, name: str, travel: TimedTravel, greatest: float) -> OpenTime:
    """Return d_smooth - d_log of a travel of a mass whose greatest speed (m/s) is known.

    A smooth one begins and ends unnoticed: ``TAIL`` rows to either side count.
    """
    rows = slice(max(travel.first - TAIL, 0), travel.last + 1 + TAIL)
    at, d = track.t[rows], track.values[rows, i]
    t = np.interp(np.arange((len(at) - 1) * PARTS + 1) / PARTS, np.arange(len(at)), at)
    return OpenTime(f"{SMOOTHNESS}_{name}", SMOOTH, t, bend(t, at, d, greatest))


def bend(t: Series1, at: Series1, d: Series1, greatest: float) -> Series1:
    """Return d_smooth - d_log (m) at ``t`` of rows d (m) at times ``at``: Hermite's cubics."""
    first, last = end_slopes(at, d, greatest)
    k = np.clip(np.searchsorted(at, t, side="right") - 1, 0, len(first) - 1)
    length = np.diff(at)[k]
    u = np.clip((t - at[k]) / length, 0.0, 1.0)
    return length * u * (1 - u) * (first[k] * (1 - u) - last[k] * u)


def end_slopes(t: Series1, d: Series1, greatest: float) -> tuple[Series1, Series1]:
    """Return by how much a smooth path is faster than each step at its begin and its end, m/s."""
    steps, speeds = np.diff(t), np.diff(d) / np.diff(t)
    straight = _is_straight(speeds, greatest)
    before, after = speeds[:-1], speeds[1:]
    slow, fast = np.sort(np.abs([before, after]), axis=0)
    alike = before * after > 0
    passing = alike & (slow > CORNER * fast) & ~(straight[:-1] | straight[1:])
    across = (d[2:] - d[:-2]) / (steps[:-1] + steps[1:])
    bent = ~straight & (np.append(passing, False) | np.append(False, passing))
    first = np.append(0.0, np.where(passing, across, alike * before)) - speeds
    last = np.append(np.where(passing, across, alike * after), 0.0) - speeds
    return bent * first, bent * last
