"""When a mass departed and arrived between the rows of its track: what these leave open.

A track is straight between rows; the mass was not. It departed somewhere between two rows, and
arrived somewhere between two others. How late is open within the slack of the first and the last
step of a travel, dt - |dd| / v: of an interval dt in which the mass went dd it travelled for
|dd| / v, v being its speed. A start anywhere in the slack moves the mean time of the step evenly
within half of it to either side,

    sd = slack / sqrt(12)

A travel faster than v, such as a stepper's, tells nothing of the speed: its slack is the whole
step. A mass that was commanded so arrives as late as its path takes at v; one that was measured has
arrived. One step from rest to rest has one mean time, so one unknown. Rows at the corners of a
travel at v leave no slack.

Travels with short pauses between are one: steps of a stepper, which keep their phase to the rows or
change it slowly. In a record of very many travels pauses count as short until ``MOST`` are left.

Cannot see a speed that changes within a step but by its mean time.
"""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from equipoise.actuators.lags import is_command
from equipoise.actuators.stops import is_travelling, joined, travels
from equipoise.model.arrays import Series1
from equipoise.model.recording import Samples
from equipoise.model.testbed import SlidingMass

PAUSE = 1.0  # s, chosen: far below the periods of a platform
MOST = 12  # travels of one mass, chosen: each costs two columns of the propagator
ROUNDING = 1e-9  # s, chosen: less is no lateness
FASTER = 1.1  # times the stated speed, chosen: beyond it that says nothing of a travel


class TimedTravel(NamedTuple):
    """One travel, or some with short pauses between."""

    first: int  # row at which the mass still stood
    last: int  # row at which it stood again
    departure_sd: float  # s
    arrival_sd: float  # s
    path: float  # m
    slack: Series1  # s, of each of its steps
    is_late: bool  # it may arrive behind its last row

    @property
    def is_one_step(self) -> bool:
        """Say whether it lies between two neighbouring rows."""
        return self.last == self.first + 1

    @property
    def is_long(self) -> bool:
        """Say whether there are steps between its first and its last: how even they are is open."""
        return self.last > self.first + 2


def merged_travels(t: Series1, d: Series1, speed: float) -> list[tuple[int, int]]:
    """Return first and last rows of travels, those with a short pause between as one."""
    found, pause = travels(t, d, speed), PAUSE
    while len(joined(t, found, pause)) > MOST and pause <= t[-1] - t[0]:
        pause *= 2
    return joined(t, found, pause)


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
    later = float(under_way.sum() - steps.sum()) if commanded else 0.0
    later = later if later > ROUNDING else 0.0
    sd = slack / np.sqrt(12)
    arrival_sd = float(np.hypot(sd[-1], later))
    last, path = first + len(steps), float(ways.sum())
    return TimedTravel(first, last, float(sd[0]), arrival_sd, path, slack, later > 0)


def unresolved_steps(track: Samples, masses: Sequence[SlidingMass]) -> NDArray[np.bool_]:
    """Say of each step between rows, (n - 1, k), which mass travels in an unknown part of it."""
    found = np.zeros((len(track) - 1, len(masses)), dtype=bool)
    for i, mass in enumerate(masses):
        for travel in timed(track.t, track.values[:, i], mass.speed):
            found[travel.first : travel.last, i] |= travel.slack > 0
    return found
