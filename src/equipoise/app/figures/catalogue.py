"""Which figures tell a fit, a track, a move and a balancing run; names, captions, drawings."""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from matplotlib.figure import Figure

from equipoise.actuators.sliding_masses import com_shift, mass_maps
from equipoise.app.figures.balancing import balanced_com, displacements
from equipoise.app.figures.estimate import (
    attitude_fit,
    attitude_residual,
    com_course,
    moved_com,
    rates,
    tracked_com,
    tracked_rate,
)
from equipoise.estimation.output_error.predict import ATTITUDE, RATE, before, predict
from equipoise.estimation.tracker import tracker
from equipoise.model.arrays import Floats, Series1, Series3, Vector3
from equipoise.model.estimate import COM, INERTIA, Estimate
from equipoise.model.recording import Recording
from equipoise.model.testbed import Testbed

TrueCourse = tuple[Series1, Series3]  # s, m: where the simulated centre of mass really was


@dataclass(frozen=True, slots=True, eq=False)
class Picture:
    """A figure with the name of its file and the caption below it."""

    name: str
    caption: str
    figure: Figure


def of_estimate(recording: Recording, testbed: Testbed, estimate: Estimate) -> Iterator[Picture]:
    """Yield the figures that suit the method of an estimate."""
    if estimate.method != "tracker":
        yield from of_fit(recording, testbed, estimate)
        yield from of_course(recording, estimate)
    elif recording.attitude is not None:
        yield from of_tracking(recording, testbed, estimate, None)
        if recording.masses is not None and np.any(np.ptp(recording.masses.values, axis=0)):
            yield from of_move(recording, testbed, estimate, None)


def of_fit(recording: Recording, testbed: Testbed, estimate: Estimate) -> Iterator[Picture]:
    """Yield Figs. 6, 7 and 8 for an estimate that says how its record began."""
    if not all(map(estimate.has, (*COM, *INERTIA, *RATE, *ATTITUDE))):
        return
    after = predict(recording, testbed, estimate)
    if recording.attitude is not None:
        drawn = attitude_fit.draw(recording, before(recording, testbed), after)
        yield Picture("figure06_attitude", attitude_fit.CAPTION, drawn)
        noise = testbed.attitude.noise if testbed.attitude else None
        drawn = attitude_residual.draw(recording, after, noise)
        yield Picture("figure07_residual", attitude_residual.CAPTION, drawn)
    yield Picture("figure08_rate", rates.CAPTION, rates.draw(recording, after))


def of_course(recording: Recording, estimate: Estimate) -> Iterator[Picture]:
    """Yield the centre of mass along the record, of a method that tells it with its sd."""
    course = estimate.course
    if course is None or not set(COM) <= set(course.names) or not np.all(np.isfinite(course.sd)):
        return
    drawn = com_course.draw(course, estimate.method, recording)
    yield Picture("com_course", com_course.CAPTION, drawn)


def tracked(
    recording: Recording, testbed: Testbed, estimate: Estimate | None, moves: tracker.Moves = "fed"
) -> tracker.Track:
    """Return what the tracker believes along a record that has a camera.

    It starts from the centre of mass of the testbed's description and the inertia of an estimate.
    """
    rows = recording.attitude
    assert rows is not None
    posterior = tracker.posterior_of(testbed, estimate)
    state = tracker.first_state(float(rows.t[0]), rows.values[0], testbed, posterior)
    return tracker.track(recording, testbed, tracker.Params(moves), state)


def of_tracking(
    recording: Recording, testbed: Testbed, estimate: Estimate | None, truth: Vector3 | None
) -> Iterator[Picture]:
    """Yield Figs. 11 and 12 for a record in which the masses stand still."""
    track = tracked(recording, testbed, estimate)
    drawn = tracked_rate.draw(track, recording)
    yield Picture("figure11_tracked_rate", tracked_rate.CAPTION, drawn)
    drawn = tracked_com.draw(track, recording, truth)
    yield Picture("figure12_tracked_com", tracked_com.CAPTION, drawn)


def of_move(
    recording: Recording, testbed: Testbed, estimate: Estimate | None, truth: TrueCourse | None
) -> Iterator[Picture]:
    """Yield Fig. 13 for a record with a move."""
    fed = tracked(recording, testbed, estimate)
    left_out = tracked(recording, testbed, estimate, "ignored")
    curves = standing(fed, recording, testbed), (left_out.t, left_out.com, left_out.com_sd)
    drawn = moved_com.draw(*curves, recording, truth)
    yield Picture("figure13_move", moved_com.CAPTION, drawn)


def of_balancing(
    recording: Recording,
    testbed: Testbed,
    estimate: Estimate | None,
    story: balanced_com.Story,
) -> Iterator[Picture]:
    """Yield Figs. 14 and 15."""
    curve = standing(tracked(recording, testbed, estimate), recording, testbed)
    drawn = balanced_com.draw(curve, recording, story)
    yield Picture("figure14_balancing", balanced_com.CAPTION, drawn)
    drawn = displacements.draw(recording, testbed)
    yield Picture("figure15_displacements", displacements.CAPTION, drawn)


def standing(track: tracker.Track, recording: Recording, testbed: Testbed) -> moved_com.Curve:
    """Return the tracked centre of mass with the masses as they stand."""
    at = displacement_at(track.t, recording, testbed)
    maps = mass_maps(testbed.masses)
    shift = np.array([com_shift(maps, testbed.body.mass, d) for d in at])
    return track.t, track.com + shift.reshape(-1, 3), track.com_sd


def displacement_at(t: Series1, recording: Recording, testbed: Testbed) -> Floats:
    """Return the displacements (m) of the testbed's masses at times t, in its order."""
    rows = recording.masses
    at = np.zeros((len(t), len(testbed.masses)))
    for k, mass in enumerate(testbed.masses):
        if rows is not None and mass.name in recording.mass_names:
            column = rows.values[:, recording.mass_names.index(mass.name)]
            at[:, k] = np.interp(t, rows.t, column)
    return at
