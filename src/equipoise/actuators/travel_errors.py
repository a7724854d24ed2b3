"""When a mass departed and arrived between the rows of its track, as unknowns of each travel.

Late by tau_1 at its departure and by tau_2 at its arrival (``travel_times``: how late is open),

    d(t) = d_log(t) - tau_1 e_1(t) - tau_2 e_2(t)

A mass that was measured was between two rows where these say, however late within the step. So e is
of the first or the last step alone, dd / dt on average; a triangle of twice that height comes
nearest to a jump anywhere in the step: its third moments in time are wrong by 0.02 dd dt^3 rms.

A jump at tau, drawn as a ramp over the step, has another second moment in time, too, so that the
platform turns by another angle within the step where its rate is the same behind. Each open step
has one unknown more, mass that passes from its first half to its second or back, a triangle each:

    d(t) = d_log(t) +- x 8 dd / dt,   x = (tau^2 - slack^2 / 12) / (2 dt)
    sd = slack^2 / (2 dt sqrt(180))   for tau spread evenly over the slack

Steps of a stepper, all of them open, and a command that the mass reaches behind its last row are
late by degrees, s going from 0 to 1 from departure to arrival:

    d(t) = d_log(t - tau) = d_log(t) - tau d_log'(t) + ...,   tau = (1 - s) tau_1 + s tau_2

Cannot see a speed that changes within a step but by these moments.
"""

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from equipoise.actuators.lags import slowness
from equipoise.actuators.travel_times import TimedTravel, timed
from equipoise.model.arrays import Series1
from equipoise.model.recording import Samples
from equipoise.model.testbed import SlidingMass

DEPARTURE, ARRIVAL, SPREAD = "departure", "arrival", "spread"
QUARTERS = np.linspace(0.0, 1.0, 5)  # of a step


class OpenTime(NamedTuple):
    """An unknown of a travel, s, and the displacement by it, m/s: straight between its corners."""

    name: str
    sd: float
    corners: Series1  # s
    effect: Series1

    def at(self, t: Series1) -> Series1:
        """Return the displacement by the unknown at times; zero beyond the corners."""
        return np.interp(t, self.corners, self.effect, left=0.0, right=0.0)


def open_times(track: Samples, i: int, mass: SlidingMass, least: float) -> Iterator[OpenTime]:
    """Yield what changes the time integral of a first moment by more than ``least`` (kg m s)."""
    for k, travel in enumerate(timed(track.t, track.values[:, i], mass.speed), 1):
        by_degrees = travel.is_late or travel.is_stepwise
        times = (_by_degrees if by_degrees else _of_ends)(track, i, f"{mass.name}_{k}", travel)
        yield from (each for each in times if mass.mass * travel.path * each.sd > least)


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
