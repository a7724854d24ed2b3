"""Figures of the gallery: simulated records, drawn by the project's own functions."""

from collections.abc import Sequence

import equipoise as eq
from equipoise.app.figures.catalogue import Picture, of_fit, of_move
from equipoise.app.figures.design_catalogue import pictures_of as pictures_of_design
from equipoise.app.figures.estimate import inertia_ellipsoid, intervals
from equipoise.app.runs.demonstration import measured
from equipoise.app.views import assess_views
from equipoise.app.views.balancing import balance_views
from equipoise.estimation.regression.formulations.rows import body_with
from equipoise.procedure.identification.record_courses import (
    balancing_courses,
    fit_motions,
    tracked_courses,
)
from equipoise.simulation.free_start import freely

PRESET, SEED = "sputnix", 1
REQUIRED = 2e-4  # N m, chosen: the testbed before balancing fails, after it passes
RECORD = (
    "A recording with a known move half way: attitude and its spectrum, displacement of the "
    "masses, numbers of the record."
)
SWING = 120.0  # s, chosen: a recording as the tutorial has it


def identified() -> Sequence[Picture]:
    """Return figures of a recording with a known move, and of its estimate."""
    bed = eq.preset(PRESET)
    recording, truth = freely(bed, SEED, measured)[1]
    found = eq.identify(recording, bed).estimate
    values = {parameter.name: parameter.value for parameter in found.parameters}
    ellipsoid = inertia_ellipsoid.draw(body_with(bed, values))
    return [
        Picture("record", RECORD, recording.plot()),
        *of_fit(recording, fit_motions(recording, bed, found)),
        Picture("intervals", intervals.CAPTION, found.plot()),
        Picture("ellipsoid", inertia_ellipsoid.CAPTION, ellipsoid),
        *of_move(recording, tracked_courses(recording, bed, found, compare=True), truth),
    ]


def balanced() -> Sequence[Picture]:
    """Return figures of a balancing."""
    bed = eq.preset(PRESET)
    done = eq.balance(eq.SimulatedBench(bed, seed=SEED))
    courses = balancing_courses(done.recording, bed, done.estimate)
    return balance_views.pictures_of(done, courses)


def assessed() -> Sequence[Picture]:
    """Return figures of the gravity torque that is left."""
    recording = eq.simulate(PRESET, duration=SWING, seed=SEED)
    done = eq.assess(recording, PRESET, require_torque=REQUIRED)
    return list(assess_views.pictures_of(done))


def designed() -> Sequence[Picture]:
    """Return figures of a testbed before it is built."""
    return pictures_of_design(eq.design(PRESET))
