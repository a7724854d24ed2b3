"""Sliding masses that are driven open loop, and where they really go.

A stepper reports its commanded steps, so the reported displacement is the target rounded to the
mass's resolution, reached in a straight line at the mass's speed. The mass stands while the play is
taken up, and goes in a straight line, in the time that is left, to where it really stops:

    carriage   += gain * (reported target - reported before)     gain 1: sound, 0: stuck
    held        = carriage, followed with a play of +-backlash/2
    real        = held + accuracy * normal                       a new draw for each stop

A fault shows from the bench's ``from_move``-th move on, counted over all masses; from the first
move on, the carriage then stands ``gain`` times the reported distance from home. A mass that the
play does not take along stays where it is, error and all. A mass that is sent elsewhere or
halted on its way goes on from there, with its share of the errors of the two stops.
At home all is zero: home is where the mass properties are stated.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from equipoise.maths.straight_lines import read_at
from equipoise.model.arrays import Floats, Series1
from equipoise.model.bench_requests import checked_targets
from equipoise.model.recording import Samples
from equipoise.model.testbed import Fault, SlidingMass
from equipoise.simulation.clock import tick, tick_one

REPORTED, CARRIAGE, HELD, REAL = range(4)  # rows of a displacement, m


@dataclass(frozen=True, slots=True, eq=False)
class Travel:
    """The last way each of k masses was sent. Before it starts and after it ends they stand."""

    start: Floats  # (k,) s
    taken: Floats  # (k,) s, when the mass is taken along, behind its play
    arrive: Floats  # (k,) s
    begin: Floats  # (4, k) m
    end: Floats  # (4, k) m
    moves: int = 0  # accepted so far


def standing(now: float, where: Floats) -> Travel:
    """Return masses that stand somewhere (4, k), sent nowhere since ``now`` (s)."""
    when = np.full(where.shape[1], now)
    return Travel(when, when, when, where, where)


def left_at(
    masses: Sequence[SlidingMass], at: Mapping[str, float], rng: np.random.Generator
) -> Travel:
    """Return masses that were sent to displacements (m) before time zero, or else stand at home."""
    end = np.zeros((4, len(masses)))
    for i, mass in enumerate(masses):
        if at.get(mass.name, 0.0) != 0.0:
            end[:, i] = stop_of(end[:, i], at[mass.name], mass, 1.0, rng.standard_normal())
    return standing(0.0, end)


def displacement(travel: Travel, t: float) -> Floats:
    """Return where the masses are at a time not before their last command, (4, k) m."""
    if t >= travel.arrive.max(initial=-np.inf):
        return travel.end
    share = share_of(t, np.array([travel.start, travel.taken]), travel.arrive)
    share = share[[0, 0, 1, 1]]  # reported and carriage; held and real
    return (1.0 - share) * travel.begin + share * travel.end


def share_of(t: float, start: Floats, end: Series1) -> Floats:
    """Return how much of the time from start to end has passed, 0 to 1."""
    length = np.maximum(end - start, 1e-12)
    return np.where(t >= end, 1.0, np.minimum(np.maximum((t - start) / length, 0.0), 1.0))


def checked(
    travel: Travel, now: float, targets: Mapping[str, float], masses: Sequence[SlidingMass]
) -> dict[int, float]:
    """Return targets by index, in whole steps (m); see ``model.bench_requests``."""
    return checked_targets(masses, displacement(travel, now)[REPORTED], targets)


def slowed(masses: Sequence[SlidingMass], speed: float) -> Sequence[SlidingMass]:
    """Return the masses, none of them faster than ``speed`` (m/s)."""
    return [replace(mass, speed=min(mass.speed, speed)) for mass in masses]


def gain_of(faults: Sequence[Fault], name: str, move: int) -> float:
    """Return the share of its way that a mass goes in a move, counted from 1."""
    shown = [fault for fault in faults if fault.mass == name and fault.from_move <= move]
    return max(shown, key=lambda fault: fault.from_move).gain if shown else 1.0


def stop_of(here: Floats, goal: float, mass: SlidingMass, gain: float, normal: float) -> Floats:
    """Return where one mass will stand (4,) when it is sent from ``here`` to ``goal``, m."""
    carriage = here[CARRIAGE] + gain * (goal - here[REPORTED])
    play = 0.5 * mass.backlash
    held = min(max(here[HELD], carriage - play), carriage + play)
    real = here[REAL] if held == here[HELD] else held + mass.accuracy * normal
    return np.array([goal, carriage, held, real])


def sent(
    travel: Travel,
    now: float,
    goals: Mapping[int, float],
    masses: Sequence[SlidingMass],
    faults: Sequence[Fault],
    rng: np.random.Generator,
) -> Travel:
    """Return the masses on their way to goals (m); the others go on as they were."""
    here = displacement(travel, now)[REPORTED]
    way = replace(travel, moves=travel.moves + 1)
    for i, goal in goals.items():
        end = now + abs(goal - here[i]) / masses[i].speed
        way = led(way, i, (now, end, goal), masses[i], faults, rng.standard_normal())
    return way


def led(
    travel: Travel,
    i: int,
    leg: tuple[float, float, float],
    mass: SlidingMass,
    faults: Sequence[Fault],
    normal: float,
) -> Travel:
    """Return mass ``i`` on a leg: when it starts, when it ends (s), and where (m)."""
    now, until, goal = leg
    here = displacement(travel, now)[:, i]
    there = stop_of(here, goal, mass, gain_of(faults, mass.name, travel.moves), normal)
    start, taken, arrive = travel.start.copy(), travel.taken.copy(), travel.arrive.copy()
    begin, end = travel.begin.copy(), travel.end.copy()
    start[i], begin[:, i], end[:, i] = now, here, there
    arrive[i] = tick_one(until)
    taken[i] = tick_one(now + free_share(here, there) * (arrive[i] - now))
    return Travel(start, taken, arrive, begin, end, travel.moves)


def free_share(here: Floats, there: Floats) -> float:
    """Return the share of a carriage's way in which it crosses its play."""
    way, taken_along = abs(there[CARRIAGE] - here[CARRIAGE]), abs(there[HELD] - here[HELD])
    return 1.0 - taken_along / way if way > 0 else 0.0


def halted(travel: Travel, now: float) -> Travel:
    """Return the masses standing where they are."""
    return replace(standing(now, displacement(travel, now)), moves=travel.moves)


@dataclass(frozen=True, slots=True, eq=False)
class Track:
    """Where the masses were and, without another command, will be: straight between the rows."""

    t: Series1  # s
    reported: Floats  # (n, k) m
    real: Floats  # (n, k) m


def tracked(travel: Travel) -> Track:
    """Return the track from time zero on."""
    nowhere = np.zeros((0, travel.end.shape[1]))
    return retracked(Track(np.zeros(0), nowhere, nowhere), travel, 0.0)


def retracked(track: Track, travel: Travel, now: float) -> Track:
    """Return the track up to a command at ``now`` (s) and on from there."""
    past = track.t < now
    corners = np.append(travel.taken, travel.arrive)
    ahead = np.unique(np.append(corners[corners > now], now))
    rows = np.array([displacement(travel, t) for t in ahead])
    return Track(
        np.append(track.t[past], ahead),
        np.vstack([track.reported[past], rows[:, REPORTED]]),
        np.vstack([track.real[past], rows[:, REAL]]),
    )


def without_past(track: Track, before: float) -> Track:
    """Return the track without what only matters before a time (s)."""
    first = max(int(np.searchsorted(track.t, before, side="right")) - 1, 0)
    return Track(track.t[first:], track.reported[first:], track.real[first:]) if first else track


def reported_rows(track: Track, start: float, end: float) -> Samples:
    """Return what a recording from ``start`` to ``end`` (s) holds: both ends and all corners."""
    corners = track.t[(track.t > start) & (track.t < end)]
    t = np.unique(np.concatenate([[start], corners, [end]]))
    return Samples(tick(t), read_at(t, track.t, track.reported))
