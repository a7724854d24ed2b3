"""Errors of drives against their nominal values: gain, rail and backlash, as unknowns.

A mass m that is commanded to d, on a rail along u, with v and w across it, stands at

    e = d [ (1 + x_g) u + x_v v + x_w w ] + [ x_p p(t) - x_b s(t) / 2 ] u

x_g    gain           relative, of the product m d: mass and steps have one effect
x_v,w  rail           tangents of its misalignment about w and v
x_b    backlash       lost motion when the direction changes; s: side of the play on which the mass
                      hangs, in the end the direction of the last travel
x_p    play at home   unknown initial position within the backlash; p: 1 from the first travel on

s and p are 0 before the first travel and pass over while the play is taken up (``lost_motion``),
for which the backlash has to be known roughly: it is that of the testbed, or of a fit before. The
rails across begin at the same home and carry the same mass: two more coordinates of the
propagator, displaced by these unknowns alone. The inertia of a displacement along both,
-m (e_u e_v^T + e_v e_u^T), is left out: it is of second order, m d^2 x, 1e-5 of J.

Masses with a ``doubt`` (``model.testbed.DriveDoubt``) that travel in the record have all of these.
One with a ``mass_sd`` that is off home has a gain alone, which is how wrongly it was weighed: three
such masses contradict each other, and the motion says which.

A travel shorter than the backlash, and a bent rail, are not modelled.
"""

from collections.abc import Sequence
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from equipoise.actuators.lost_motion import Play, directions, play_of
from equipoise.actuators.stops import MassError
from equipoise.maths.axes_across import axes_across
from equipoise.model.arrays import Series1
from equipoise.model.recording import Samples
from equipoise.model.testbed import SlidingMass

GAIN, ACROSS, BACKLASH, PLAY = "gain", "across", "backlash", "play"
SIDES = 2  # directions across a rail


class DriveNames(NamedTuple):
    """The names of the unknowns of one mass."""

    gain: str
    across: tuple[str, str]
    backlash: str
    play: str


def drive_names(mass: str) -> DriveNames:
    """Return the names of the unknowns of a mass."""
    sides = (f"{ACROSS}_{mass}_1", f"{ACROSS}_{mass}_2")
    return DriveNames(f"{GAIN}_{mass}", sides, f"{BACKLASH}_{mass}", f"{PLAY}_{mass}")


def is_turned(mass: SlidingMass) -> bool:
    """Say whether a rail may lie another way than stated."""
    return mass.doubt is not None and mass.doubt.across > 0


def rails_of(masses: Sequence[SlidingMass]) -> tuple[SlidingMass, ...]:
    """Return the masses, and behind them the rails across those whose rail is in doubt."""
    beside = [
        replace(mass, name=name, axis=axis, doubt=None)
        for mass in masses
        if is_turned(mass)
        for name, axis in zip(drive_names(mass.name).across, axes_across(mass.axis), strict=True)
    ]
    return (*masses, *beside)


def on_rails(track: Samples | None, rails: int) -> Samples | None:
    """Return a track of masses with columns for the rails across, which have no commands."""
    if track is None or track.values.shape[1] == rails:
        return track
    more = np.zeros((len(track), rails - track.values.shape[1]))
    return Samples(track.t, np.hstack([track.values, more]))


def plays(track: Samples, masses: tuple[SlidingMass, ...]) -> dict[int, Play]:
    """Return how each drive in doubt that travels takes up its play, by the mass's index."""
    found: dict[int, Play] = {}
    for i, mass in enumerate(masses):
        d = track.values[:, i]
        ways = directions(track.t, d, mass.speed) if mass.doubt is not None else []
        if ways:
            found[i] = play_of(track.t, d, ways, mass.backlash)
    return found


def is_sought(d: Series1, mass: SlidingMass) -> bool:
    """Say whether the weight of a mass with these displacements is an unknown, and nothing else."""
    return mass.doubt is None and mass.mass_sd > 0 and bool(np.any(d))


def corners(track: Samples, masses: tuple[SlidingMass, ...]) -> list[Series1]:
    """Return the times between which masses whose weight is unknown move straight."""
    found: list[Series1] = []
    for i, mass in enumerate(masses):
        d = track.values[:, i]
        if is_sought(d, mass):
            ways = directions(track.t, d, mass.speed)
            rows = sorted({0, len(d) - 1, *(k for way in ways for k in way[:2])})
            found.append(track.t[rows])
    return found


def drive_errors(
    t: Series1, track: Samples, masses: tuple[SlidingMass, ...], taken_up: dict[int, Play]
) -> list[MassError]:
    """Return the unknowns of drives, with their effect at times ``t``."""
    turned = [i for i, mass in enumerate(masses) if is_turned(mass)]
    found: list[MassError] = []
    for i, mass in enumerate(masses):
        d = np.interp(t, track.t, track.values[:, i])
        if is_sought(track.values[:, i], mass):
            found.append(MassError(drive_names(mass.name).gain, mass.mass_sd, [(i, d)]))
        elif i in taken_up:
            side = len(masses) + SIDES * turned.index(i) if i in turned else i
            found += of_one(t, d, (i, side), mass, taken_up[i])
    return found


def of_one(
    t: Series1, d: Series1, rail: tuple[int, int], mass: SlidingMass, play: Play
) -> list[MassError]:
    """Return the unknowns of one drive; ``rail`` are its rail and the first of those across."""
    assert mass.doubt is not None
    (along, side), names, doubt = rail, drive_names(mass.name), mass.doubt
    s = np.interp(t, play.t, play.side)
    p = np.interp(t, play.t[1:3], [0.0, 1.0])
    found = [
        MassError(names.gain, doubt.gain, [(along, d)]),
        *(MassError(n, doubt.across, [(side + k, d)]) for k, n in enumerate(names.across)),
        MassError(names.backlash, doubt.backlash, [(along, -s / 2)]),
        MassError(names.play, doubt.backlash / 2, [(along, p)]),
    ]
    return [each for each in found if each.sd > 0]
