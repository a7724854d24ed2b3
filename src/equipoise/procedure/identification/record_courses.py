"""Estimates along the records that they were made of: motions and courses for figures.

    fit        the motion that the testbed predicts, and the one that the estimate predicts
    tracked    angular velocity and centre of mass as the tracker (Kalman filter) has them

An identification by the tracker has its courses already: the filter does not run again for them.
Along other records it starts from the testbed's centre of mass and the inertia of an estimate.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import TypeGuard

import numpy as np

from equipoise.actuators.sliding_masses import com_shift, mass_maps
from equipoise.estimation.methods.tracker import com_course, rate_course
from equipoise.estimation.output_error.predict import before, predict
from equipoise.estimation.planar.friction_field import FrictionField, friction_field
from equipoise.estimation.tracker import tracker
from equipoise.model.arrays import Floats, Series1
from equipoise.model.estimate import ATTITUDE, COM, INERTIA, RATE, Course, Estimate
from equipoise.model.predicted_motion import PredictedMotion
from equipoise.model.recording import Recording
from equipoise.model.step import Step
from equipoise.model.testbed import Testbed
from equipoise.procedure.identification.fitted_motion import FittedMotion, fitted_motion

TRACKER, PLANAR = "tracker", "planar"


@dataclass(frozen=True, slots=True, eq=False)
class FitMotions:
    """The motion along a record, before and after the fit."""

    before: PredictedMotion  # of the testbed's description
    after: PredictedMotion  # of the estimate, from its first state on
    fitted: FittedMotion  # at the rows of camera and gyro


@dataclass(frozen=True, slots=True, eq=False)
class TrackedCourses:
    """The courses of the tracker along a record."""

    rate: Course  # rad/s, body axes
    com: Course  # m, body axes, masses at home
    standing: Course  # the same with the masses as they stand
    ignored: Course | None = None  # the same of a tracker that was not given the moves


@dataclass(frozen=True, slots=True, eq=False)
class RecordCourses:
    """All that the figures of one run draw along records."""

    fit: FitMotions | None = None
    tracked: TrackedCourses | None = None
    table: FrictionField | None = None


def identification_courses(
    recording: Recording, testbed: Testbed, steps: Sequence[Step]
) -> RecordCourses:
    """Return the courses of an identification; the last step has the estimate that counts."""
    estimate = steps[-1].estimate
    if estimate is None:
        return RecordCourses()
    if (table := friction_field(recording, testbed, estimate)) is not None:
        return RecordCourses(table=table)
    if estimate.method != TRACKER:
        return RecordCourses(fit_motions(recording, testbed, estimate))
    if estimate.course is None or estimate.rate_course is None:
        return RecordCourses()
    standing = standing_course(estimate.course, recording, testbed)
    tracked = TrackedCourses(estimate.rate_course, estimate.course, standing)
    masses = recording.masses
    if masses is not None and np.any(np.ptp(masses.values, axis=0)):
        tracked = replace(tracked, ignored=com_course(_track(recording, testbed, None, "ignored")))
    return RecordCourses(tracked=tracked)


def balancing_courses(
    recording: Recording | None, testbed: Testbed, estimate: Estimate | None
) -> RecordCourses:
    """Return the courses of a balancing run; ``recording`` has all that the bench gave."""
    if not has_attitude(recording):
        return RecordCourses()
    return RecordCourses(tracked=tracked_courses(recording, testbed, estimate))


def fit_motions(recording: Recording, testbed: Testbed, estimate: Estimate) -> FitMotions | None:
    """Return the motions of a fit; None where the estimate has no initial state."""
    if not predicts_motion(estimate):
        return None
    after = predict(recording, testbed, estimate)
    fitted = fitted_motion(recording, testbed, estimate, after)
    return FitMotions(before(recording, testbed), after, fitted)


def predicts_motion(estimate: Estimate | None) -> TypeGuard[Estimate]:
    """Say whether an estimate holds the initial state, so that the model can be run along it."""
    names = (*COM, *INERTIA, *RATE, *ATTITUDE)
    own = (TRACKER, PLANAR)  # of which the motion is another's
    return estimate is not None and all(map(estimate.has, names)) and estimate.method not in own


def has_attitude(recording: Recording | None) -> TypeGuard[Recording]:
    """Say whether there is a recording with attitude rows."""
    return recording is not None and recording.attitude is not None


def tracked_courses(
    recording: Recording, testbed: Testbed, estimate: Estimate | None, compare: bool = False
) -> TrackedCourses:
    """Return the courses of the tracker along a record with attitude rows.

    ``compare`` runs it a second time, without the commanded moves.
    """
    track = _track(recording, testbed, estimate, "fed")
    com = com_course(track)
    ignored = com_course(_track(recording, testbed, estimate, "ignored")) if compare else None
    standing = standing_course(com, recording, testbed)
    return TrackedCourses(rate_course(track), com, standing, ignored)


def _track(
    recording: Recording, testbed: Testbed, estimate: Estimate | None, moves: tracker.Moves
) -> tracker.Track:
    rows = recording.attitude
    assert rows is not None
    posterior = tracker.posterior_of(testbed, estimate)
    state = tracker.first_state(float(rows.t[0]), rows.values[0], testbed, posterior)
    return tracker.track(recording, testbed, tracker.Params(moves), state)


def standing_course(course: Course, recording: Recording, testbed: Testbed) -> Course:
    """Return a course of the centre of mass with the masses as they stand."""
    maps = mass_maps(testbed.masses)
    at = displacement_at(course.t, recording, testbed)
    shift = np.array([com_shift(maps, testbed.body.mass, d) for d in at])
    return Course(course.names, course.t, course.values + shift.reshape(-1, 3), course.sd)


def displacement_at(t: Series1, recording: Recording, testbed: Testbed) -> Floats:
    """Return the displacements (m) of the testbed's masses at times t (s), in its order."""
    rows = recording.masses
    at = np.zeros((len(t), len(testbed.masses)))
    for k, mass in enumerate(testbed.masses):
        if rows is not None and mass.name in recording.mass_names:
            column = rows.values[:, recording.mass_names.index(mass.name)]
            at[:, k] = np.interp(t, rows.t, column)
    return at
