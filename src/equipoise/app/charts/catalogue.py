"""The charts of an identification, a balancing and a demonstration."""

from equipoise.app.charts.of_courses import of_balancing, of_course, of_move, of_tracking
from equipoise.app.charts.of_fit import of_fit, of_residual_rows, residuals_of_fit
from equipoise.app.charts.of_motion import of_motion
from equipoise.app.charts.of_residuals import of_residuals
from equipoise.app.figures.balancing.story import Story
from equipoise.app.text.charts import Drawn
from equipoise.model.estimate import Estimate
from equipoise.model.recording import Recording
from equipoise.model.testbed import Testbed
from equipoise.procedure.identification.fitted_motion import residuals_of
from equipoise.procedure.identification.record_courses import RecordCourses

IDENTIFICATION = "identification"
BALANCING = "balancing"
ASSESSMENT = "assessment"


def charts_of_estimate(
    recording: Recording, testbed: Testbed, estimate: Estimate, courses: RecordCourses
) -> tuple[Drawn, ...]:
    """Return replay and charts of an estimate from one record."""
    return (
        *of_motion(recording, testbed, estimate, IDENTIFICATION),
        *charts_of_fit(recording, courses),
        *_tracked(recording, estimate, courses),
    )


def charts_of_fit(recording: Recording, courses: RecordCourses) -> tuple[Drawn, ...]:
    """Return the charts of a fit and of its residuals; none where nothing was fitted."""
    if courses.fit is None:
        return ()
    fit = of_fit(recording, courses.fit, IDENTIFICATION)
    return (*fit, *of_residuals(residuals_of_fit(courses.fit)))


def _tracked(recording: Recording, estimate: Estimate, courses: RecordCourses) -> tuple[Drawn, ...]:
    if courses.tracked is None:
        return tuple(of_course(recording, estimate, IDENTIFICATION))
    return (
        *of_tracking(recording, courses.tracked, IDENTIFICATION),
        *of_move(recording, courses.tracked, None, IDENTIFICATION),
    )


def charts_of_assessment(
    recording: Recording, testbed: Testbed, estimate: Estimate
) -> tuple[Drawn, ...]:
    """Return replay, residuals of both sensors and their statistics."""
    replay, residual = of_motion(recording, testbed, estimate, ASSESSMENT), estimate.residual
    if residual is None:
        return tuple(replay)
    left = residuals_of(testbed, residual.attitude, residual.rate)
    rows = of_residual_rows(recording, left, ASSESSMENT)
    return (*replay, *rows, *of_residuals(left))


def charts_of_balancing(
    recording: Recording | None,
    testbed: Testbed,
    estimate: Estimate | None,
    courses: RecordCourses,
    story: Story,
) -> tuple[Drawn, ...]:
    """Return replay and charts of a balancing run; the tracker's, where it was run."""
    if recording is None:
        return ()
    replay = tuple(of_motion(recording, testbed, estimate, BALANCING))
    if courses.tracked is None:
        return replay
    return (
        *replay,
        *of_tracking(recording, courses.tracked, BALANCING),
        *of_balancing(recording, courses.tracked, story, BALANCING),
    )
