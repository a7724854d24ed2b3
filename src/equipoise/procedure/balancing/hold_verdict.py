"""The verdict on a hold: within tolerance at every measurement, by the posterior at that time.

Each measurement is a claim of its own, on all axes with their covariance. The hold passes if each
of them does, so a platform that was outside at one of them passes in at most 2.5 % of holds.

Cannot see what happens between measurements.
"""

from typing import NamedTuple

import numpy as np

from equipoise.maths.gaussian_length import Bounded
from equipoise.model.arrays import Matrix3, Vector3
from equipoise.model.criterion import HELD, Interval, jointly
from equipoise.model.reasons.reason import axes_of
from equipoise.model.verdict import Verdict
from equipoise.procedure.steps.gaussian_box import bounded_use
from equipoise.procedure.steps.verify import Aim, axes_in_doubt


class Measured(NamedTuple):
    """The posterior of the centre of mass after a measurement, as the masses stand."""

    com: Vector3  # m
    covariance: Matrix3  # m^2

    @property
    def sd(self) -> Vector3:
        """Standard deviations, m."""
        return np.sqrt(np.diag(self.covariance))


class Course(NamedTuple):
    """What the measurements of a hold come to so far: as large after hours as after one."""

    last: Measured
    off: Vector3  # m, the greatest offset along each axis
    sd: Vector3  # m, of that offset then
    use: Interval  # of all measurements, the shares of the tolerance that they use
    beyond: frozenset[str] = frozenset()  # axes outside for sure at some measurement
    doubtful: frozenset[str] = frozenset()  # axes not inside for sure at some measurement


def course_from(first: Measured, aim: Aim) -> Course:
    """Return the course of one measurement."""
    off, use = first.com - aim.target, use_of(first, aim)
    one = Course(first, np.abs(off), first.sd, Interval(use.low, use.high))
    return named(one, off, use, aim)


def followed(course: Course, fresh: Measured, aim: Aim) -> Course:
    """Return the course with one measurement more."""
    off, use = fresh.com - aim.target, use_of(fresh, aim)
    more = np.abs(off) > course.off
    grown = course._replace(
        last=fresh,
        off=np.where(more, np.abs(off), course.off),
        sd=np.where(more, fresh.sd, course.sd),
        use=jointly((course.use, use)),
    )
    return named(grown, off, use, aim)


def use_of(measured: Measured, aim: Aim) -> Bounded:
    """Return the share of the tolerances that a measurement uses."""
    return bounded_use(measured.com - aim.target, measured.covariance, aim.tolerance)


def named(course: Course, off: Vector3, use: Bounded, aim: Aim) -> Course:
    """Return the course with the axes that its last measurement has outside, or in doubt."""
    if use.high <= 1:
        return course
    axes = frozenset(axes_in_doubt(off, course.last.sd, aim.tolerance, use))
    if use.low > 1:
        course = course._replace(beyond=course.beyond | axes)
    return course._replace(doubtful=course.doubtful | axes)


def verdict_on(course: Course, aim: Aim, duration: float) -> Verdict:
    """Return the verdict on a hold that lasted for ``duration`` (s)."""
    found = course.beyond if course.use.low > 1 else course.doubtful
    names = tuple(axis for axis in "xyz" if axis in found)
    numbers = {"duration": duration, **axes_of("off", course.off), **axes_of("sd", course.sd)}
    reason = HELD.answer(course.use, 1.0, numbers, names)
    return Verdict((reason,), course.last.com, course.last.sd)
