"""Rows for a board's program: what a simulated platform shows while masses move now and then."""

import numpy as np

from equipoise.model.recording import Recording, Samples
from equipoise.onboard.trial import rows_of
from equipoise.simulation.bench import SimulatedBench

PERIOD = 0.1  # s
STEP = 20  # rows of the bench between two moves


def simulated_rows(bed, seed, duration, longest=1):
    """Return rows (n, 8 + k) of a run in which two masses move, one a time."""
    bench, rows, names = SimulatedBench(bed, seed), [], [mass.name for mass in bed.masses]
    here = np.zeros(len(names))
    for k in range(round(duration / PERIOD)):
        if k in (STEP * 3, STEP * 6):
            mass = bed.masses[k // STEP // 3]
            bench.move({mass.name: 20 * max(mass.resolution, 1e-4)})
        for row in rows_of(bench.read(PERIOD), bed, here, longest):
            rows.append(row)
            here = row[8:]
    return np.array(rows)


def recording_of(rows):
    """Return rows as the record of a camera, with the masses at the same times."""
    t = rows[:, 0]
    return Recording(attitude=Samples(t, rows[:, 1:5]), masses=Samples(t, rows[:, 8:]))
