"""Rows of a gyro that were measured while a mass moved at a speed that nobody knows.

A mass that travels along its rail u, through rho from P, has the momentum m d' rho x u, which the
body gives up at once:

    dw = -J^-1 m rho x u d'

Where a mass travelled in some part of the time between two rows of its track, d' at a row of the
gyro is anything up to its greatest; the attitude, which integrates, knows the mean alone. Rows that
this may put off by more than their noise say nothing of the platform and are left out.

Cannot see a mass that rattles while its track stands still.
"""

from dataclasses import replace

import numpy as np

from equipoise.actuators.sliding_masses import mass_maps
from equipoise.actuators.travel_times import unresolved_steps
from equipoise.model.arrays import Bools, Floats, Series1
from equipoise.model.recording import Recording, Samples
from equipoise.model.testbed import Testbed
from equipoise.sensors.timing import measured_at


def doubtful_rates(track: Samples, testbed: Testbed) -> Floats:
    """Return by how much a rate may be off within each step between rows of the masses, rad/s."""
    lever = np.linalg.solve(testbed.body.inertia_P, mass_maps(testbed.masses).momentum.T)
    speeds = np.abs(np.diff(track.values, axis=0)) / np.diff(track.t)[:, None]
    unresolved = unresolved_steps(track, testbed.masses)
    off: Floats = (speeds * unresolved) @ np.linalg.norm(lever, axis=0)
    return off


def touching(t: Series1, steps: Series1, doubtful: Bools) -> Bools:
    """Say which times lie within a doubtful step, ends included; ``steps``: the rows between."""
    k = np.searchsorted(steps, t, side="left"), np.searchsorted(steps, t, side="right")
    padded = np.concatenate([[False], doubtful, [False]])
    return np.asarray(padded[k[0]] | padded[k[1]])


def without_unresolved_rates(recording: Recording, testbed: Testbed) -> tuple[Recording, int]:
    """Return the record without the rows of the gyro that masses may put off, and their number."""
    rate, track, gyro = recording.rate, recording.masses, testbed.gyro
    if rate is None or gyro is None or track is None or len(track) < 2 or not testbed.masses:
        return recording, 0
    doubtful = doubtful_rates(track, testbed) > gyro.noise
    off = touching(measured_at(rate.t, gyro), track.t, doubtful)
    if not off.any() or off.all():
        return recording, 0
    return replace(recording, rate=rate.where(~off)), int(off.sum())
