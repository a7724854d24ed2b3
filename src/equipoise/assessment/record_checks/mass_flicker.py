"""A mass that stands between two steps of its log, which flickers from one to the other and back.

A position that is logged in steps of q says where a mass is to q / 2. One that stands near the
middle between two steps, and trembles by less than either, is logged as if it moved by q and back.
Taken for a move, that is a known change of the centre of mass which never happened, and the scale
of the inertia rests on these.

A mass counts as standing where its log leaves by one step of its ``resolution`` and is back within
a second, if steps so large are no more than its ``accuracy`` leaves open: q / 4, less than the
q / sqrt(12) of rounding. Cannot tell it from a mass that was moved by one step and back as quickly.
"""

from typing import NamedTuple

import numpy as np

from equipoise.actuators.stops import ALIKE, is_rounded
from equipoise.model.arrays import Series1
from equipoise.model.finding import Finding
from equipoise.model.reasons.finding_reasons import FindingReason as Why
from equipoise.model.reasons.reason import one_reason
from equipoise.model.recording import Recording, Samples
from equipoise.model.testbed import SlidingMass, Testbed

BACK = 1.0  # s, chosen: half a turn of a platform that spins, and trembles, at 180 deg/s


class Flicker(NamedTuple):
    """How one mass flickers."""

    positions: Series1  # m, without it
    times: int


def flicker_of(t: Series1, d: Series1, mass: SlidingMass) -> Flicker:
    """Return the positions (m) of one mass without flicker, and how often there was one."""
    if not is_rounded(mass):
        return Flicker(d, 0)
    tolerance, count, still = ALIKE * mass.resolution, 0, d.copy()
    changes = np.flatnonzero(np.abs(np.diff(d)) > tolerance)
    there, back = changes[:-1], changes[1:]
    out = d[there + 1] - d[there]
    aside = np.abs(np.abs(out) - mass.resolution) < tolerance
    returned = np.abs(d[back + 1] - d[there]) < tolerance
    until = -1
    for k in np.flatnonzero(aside & returned & (t[back] - t[there] < BACK)):
        if there[k] >= until:  # else the way back of the one before
            still[there[k] + 1 : back[k] + 1] = d[there[k]]
            until, count = back[k] + 1, count + 1
    return Flicker(still, count)


def flickers(recording: Recording, testbed: Testbed) -> dict[str, Flicker]:
    """Return the masses that flicker, by name."""
    rows, masses = recording.masses, {mass.name: mass for mass in testbed.masses}
    if rows is None:
        return {}
    names = recording.mass_names or testbed.mass_names
    found = {
        name: flicker_of(rows.t, column, masses[name])
        for name, column in zip(names, rows.values.T, strict=False)
        if name in masses
    }
    return {name: flicker for name, flicker in found.items() if flicker.times}


def without_flicker(recording: Recording, testbed: Testbed) -> Samples | None:
    """Return the positions of the masses where they stand instead of flicker."""
    rows, found = recording.masses, flickers(recording, testbed)
    if rows is None or not found:
        return rows
    names = recording.mass_names or testbed.mass_names
    values = rows.values.copy()
    for name, flicker in found.items():
        values[:, names.index(name)] = flicker.positions
    return Samples(rows.t, values)


def flicker_findings(recording: Recording, testbed: Testbed | None) -> list[Finding]:
    """Return one finding for each mass that flickers."""
    found = flickers(recording, testbed) if testbed is not None else {}
    return [
        Finding("mended", one_reason(Why.MASS_FLICKERS, name, count=flicker.times))
        for name, flicker in found.items()
    ]
