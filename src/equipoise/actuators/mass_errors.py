"""Errors of the recorded positions of masses, as unknowns with a prior.

    d_i(t) = d_i,log(t) + sum_j a_ij(t) x_j

One unknown x_j may act on one mass (where it stopped: ``stops``; when it travelled between rows:
``travel_errors``; its weight: ``drive_errors``), on several (how late they follow their commands:
``lags``), or along rails of its own (``drive_errors``). d_i is a displacement along one of the
``rails``: the masses' own, and those across drives in doubt.
"""

from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from equipoise.actuators.drive_errors import (
    ACROSS,
    BACKLASH,
    GAIN,
    PLAY,
    corners,
    drive_errors,
    plays,
    rails_of,
)
from equipoise.actuators.lags import (
    LAG,
    command_columns,
    kinds_of,
    lag_errors,
    lag_times,
    rests,
    sags,
)
from equipoise.actuators.lost_motion import command_times
from equipoise.actuators.stops import MassError, stop_errors
from equipoise.actuators.travel_errors import (
    ARRIVAL,
    DEPARTURE,
    SMOOTHNESS,
    SPREAD,
    open_times,
)
from equipoise.maths.straight_lines import bends
from equipoise.model.arrays import Floats, Ints, Series1
from equipoise.model.recording import Samples
from equipoise.model.testbed import SlidingMass


@dataclass(frozen=True, slots=True, eq=False)
class MassErrors:
    """The unknowns, and where each of them acts."""

    response: Samples | None  # (n, f) displacement by unknown, straight between rows
    owner: Ints  # (f, 2) index of the rail along which it acts, and of the unknown
    sd: Floats  # (e,) in the units of ``unit_of``
    names: tuple[str, ...]
    sag: Floats  # (rails,) m, one sd of how far a mass hangs below its log, rail upright
    at_rest: bool  # no mass travels


def unit_of(name: str) -> str:
    """Return the SI unit of an unknown: of a time, a gain, a rail across; else a displacement's."""
    if name.startswith(LAG):
        return "s"
    units = {GAIN: "1", ACROSS: "rad", DEPARTURE: "s", ARRIVAL: "s", SPREAD: "s", SMOOTHNESS: "1"}
    return units.get(name.split("_")[0], "m")


def is_of_drive(name: str) -> bool:
    """Say whether an unknown is a property of a drive: the same in every recording of a bench."""
    return name.startswith(LAG) or name.split("_")[0] in (GAIN, ACROSS, BACKLASH, PLAY)


def at_bends(t: Series1, columns: Floats) -> Samples:
    """Return columns of straight lines at the times at which any bends, and at both ends."""
    if len(t) < 2:
        return Samples(t, columns)
    return Samples(t, columns).where(np.concatenate([[True], bends(t, columns), [True]]))


@lru_cache(maxsize=4)  # a search poses a record hundreds of times; by identity
def mass_errors(
    track: Samples | None, masses: tuple[SlidingMass, ...], least: float = 0.0
) -> MassErrors:
    """Return the unknowns of a recording: stops, lags of drives, times of travels, drives in doubt.

    Times of travels that change the time integral of a first moment by ``least`` (kg m s) or less
    are as recorded.
    """
    if track is None or not len(track):
        none = np.zeros(0)
        return MassErrors(None, np.zeros((0, 2), dtype=np.int64), none, (), none, at_rest=True)
    commands, at_rest = command_columns(track, masses), rests(track, masses)
    kinds = kinds_of(commands, masses)
    late = lag_times(track, [sd for sd, kind in kinds.items() if kind])
    taken_up = plays(track, masses)
    times = [(i, o) for i, mass in enumerate(masses) for o in open_times(track, i, mass, least)]
    bent = [each.corners for _, each in times]
    bent += [*corners(track, masses), *(play.t for play in taken_up.values())]
    t = np.unique(np.concatenate([late, *bent]))
    gone = [command_times(taken_up.get(i), t) for i in range(len(masses))]
    found = [*stop_errors(gone, track, masses), *lag_errors(t, track, kinds)]
    found += [MassError(each.name, each.sd, [(i, each.at(t))]) for i, each in times]
    found += drive_errors(t, track, masses, taken_up)
    columns: list[Series1] = [column for each in found for _, column in each.response]
    pairs = [(mass, j) for j, each in enumerate(found) for mass, _ in each.response]
    return MassErrors(
        at_bends(t, np.column_stack(columns)) if columns else None,
        np.array(pairs, dtype=np.int64).reshape(-1, 2),
        np.array([each.sd for each in found]),
        tuple(each.name for each in found),
        np.append(sags(commands, masses, at_rest), np.zeros(len(rails_of(masses)) - len(masses))),
        at_rest,
    )
