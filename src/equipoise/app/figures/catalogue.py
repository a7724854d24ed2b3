"""Figures of a fit, a track, a move and a balancing run; names, captions, drawings."""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from equipoise.app.figures.balancing import balanced_com, displacements
from equipoise.app.figures.balancing.story import Story
from equipoise.app.figures.base.canvas import Figure
from equipoise.app.figures.estimate import (
    attitude_fit,
    com_course,
    moved_com,
    rates,
    residuals,
    table_friction,
    tracked_com,
    tracked_rate,
)
from equipoise.model.arrays import Series1, Series3, Vector3
from equipoise.model.estimate import COM, Estimate
from equipoise.model.recording import Recording
from equipoise.model.testbed import Testbed
from equipoise.procedure.identification.record_courses import (
    FitMotions,
    RecordCourses,
    TrackedCourses,
)

TrueCourse = tuple[Series1, Series3]  # s, m: where the simulated centre of mass really was


@dataclass(frozen=True, slots=True, eq=False)
class Picture:
    """A figure with the name of its file and the caption below it."""

    name: str
    caption: str
    figure: Figure


def of_estimate(
    recording: Recording, estimate: Estimate, courses: RecordCourses
) -> Iterator[Picture]:
    """Yield the figures that suit the method of an estimate."""
    if courses.fit is not None:
        yield from of_fit(recording, courses.fit)
    if courses.table is not None:
        drawn = table_friction.draw(courses.table)
        yield Picture("table_friction", table_friction.CAPTION, drawn)
    if courses.tracked is None:
        yield from of_course(recording, estimate)
    else:
        yield from of_tracking(recording, courses.tracked, None)
        yield from of_move(recording, courses.tracked, None)


def of_fit(recording: Recording, motions: FitMotions) -> Iterator[Picture]:
    """Yield Figs. 6, 7 and 8, and what the fit leaves of a gyro."""
    if recording.attitude is not None:
        drawn = attitude_fit.draw(recording, motions)
        yield Picture("figure06_attitude", attitude_fit.CAPTION, drawn)
    if motions.fitted.camera_residual is not None:
        drawn = residuals.draw(recording, motions.fitted.camera_residual, residuals.CAMERA)
        yield Picture("figure07_residual", residuals.CAMERA.caption, drawn)
    drawn = rates.draw(recording, motions.fitted)
    yield Picture("figure08_rate", rates.caption(motions.fitted), drawn)
    if motions.fitted.gyro_residual is not None:
        drawn = residuals.draw(recording, motions.fitted.gyro_residual, residuals.GYRO)
        yield Picture("gyro_residual", residuals.GYRO.caption, drawn)


def of_course(recording: Recording, estimate: Estimate) -> Iterator[Picture]:
    """Yield the centre of mass along the record, of a method that states it with its sd."""
    course = estimate.course
    if course is None or not set(COM) <= set(course.names) or not np.all(np.isfinite(course.sd)):
        return
    drawn = com_course.draw(course, estimate.method, recording)
    yield Picture("com_course", com_course.CAPTION, drawn)


def of_tracking(
    recording: Recording, tracked: TrackedCourses, truth: Vector3 | None
) -> Iterator[Picture]:
    """Yield Figs. 11 and 12 for a record in which the masses stand still."""
    drawn = tracked_rate.draw(tracked.rate, recording)
    yield Picture("figure11_tracked_rate", tracked_rate.CAPTION, drawn)
    drawn = tracked_com.draw(tracked.com, recording, truth)
    yield Picture("figure12_tracked_com", tracked_com.CAPTION, drawn)


def of_move(
    recording: Recording, tracked: TrackedCourses, truth: TrueCourse | None
) -> Iterator[Picture]:
    """Yield Fig. 13 where the tracker was run without the moves too."""
    if tracked.ignored is not None:
        drawn = moved_com.draw(tracked.standing, tracked.ignored, recording, truth)
        yield Picture("figure13_move", moved_com.CAPTION, drawn)


def of_balancing(
    recording: Recording, testbed: Testbed, tracked: TrackedCourses, story: Story
) -> Iterator[Picture]:
    """Yield Figs. 14 and 15."""
    drawn = balanced_com.draw(tracked.standing, recording, story)
    yield Picture("figure14_balancing", balanced_com.CAPTION, drawn)
    drawn = displacements.draw(recording, testbed)
    yield Picture("figure15_displacements", displacements.CAPTION, drawn)
