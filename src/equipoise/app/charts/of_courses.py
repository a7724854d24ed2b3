"""Courses of centre of mass and angular velocity along a record, as charts."""

from collections.abc import Iterator

import numpy as np

from equipoise.app.charts.of_fit import shaded_times
from equipoise.app.charts.rows import banded, rows_of, straight
from equipoise.app.figures.balancing.story import Story
from equipoise.app.figures.base.com_panels import SETTLED
from equipoise.app.figures.base.strokes import around
from equipoise.app.figures.base.style import AXES, BAND
from equipoise.app.figures.catalogue import TrueCourse
from equipoise.app.figures.estimate import com_course, moved_com, tracked_com, tracked_rate
from equipoise.app.text.charts import Chart, Panel, Rows
from equipoise.model.arrays import Series1
from equipoise.model.estimate import COM, Course, Estimate
from equipoise.model.recording import Recording
from equipoise.model.units import DEG, MM, UM
from equipoise.procedure.identification.record_courses import TrackedCourses

BALANCED = (
    "Centre of mass with the masses in their present positions, in body axes: tracker (lines, "
    "bands of two standard deviations), target with tolerance (dashed, shaded), estimates of the "
    "procedure and, of a simulated platform, the truth (dots). Grey: masses move."
)
DISPLACED = "Displacements of the balancing masses from home."
RATE, HOME = "figure11_tracked_rate", "figure12_tracked_com"
OF_TRACKING = (RATE, HOME)


def of_course(recording: Recording, estimate: Estimate, record: str) -> Iterator[Chart]:
    """Yield the centre of mass along the record, of a method that states it with its sd."""
    course = estimate.course
    if course is None or not set(COM) <= set(course.names) or not np.all(np.isfinite(course.sd)):
        return
    where = [course.names.index(name) for name in COM]
    com = Course(COM, course.t, course.values[:, where], course.sd[:, where])
    panel = com_panel(f"centre of mass, {estimate.method}", com)
    yield Chart("com_course", com_course.CAPTION, (panel,), record=record,
                shaded=shaded_times(recording))  # fmt: skip


def of_tracking(recording: Recording, tracked: TrackedCourses, record: str) -> Iterator[Chart]:
    """Yield rate and centre of mass by the tracker."""
    shaded = shaded_times(recording)
    rate = settled_panel("angular velocity, tracker", "deg/s", tracked.rate, DEG)
    yield Chart(RATE, tracked_rate.CAPTION, (rate,), record=record,
                shaded=shaded)  # fmt: skip
    com = com_panel("centre of mass, masses at home", tracked.com)
    yield Chart(HOME, tracked_com.CAPTION, (com,), record=record, shaded=shaded)


def of_move(
    recording: Recording, tracked: TrackedCourses, truth: TrueCourse | None, record: str
) -> Iterator[Chart]:
    """Yield the centre of mass across a move where the tracker was run without the move too."""
    if tracked.ignored is None:
        return
    real = () if truth is None else (true_rows(truth),)
    panels = (
        com_panel("move fed to the tracker", tracked.standing, *real),
        com_panel("move ignored", tracked.ignored, *real),
    )
    yield Chart("figure13_move", moved_com.CAPTION, panels, record=record,
                shaded=shaded_times(recording))  # fmt: skip


def of_balancing(
    recording: Recording, tracked: TrackedCourses, story: Story, record: str
) -> Iterator[Chart]:
    """Yield the centre of mass and the masses on the way to balance."""
    shaded = shaded_times(recording)
    real = () if story.truth is None else (true_rows(story.truth),)
    beside = (wanted_rows(story, tracked.standing.t), *measured_rows(story), *real)
    panel = com_panel("centre of mass, present mass positions", tracked.standing, *beside)
    yield Chart("figure14_balancing", BALANCED, (panel,), record=record, shaded=shaded)
    if recording.masses is not None and len(recording.masses):
        rows = straight(recording.mass_names, recording.masses.t, recording.masses.values, MM)
        moved = Panel("displacement from home", "mm", (rows,))
        yield Chart("figure15_displacements", DISPLACED, (moved,), record=record)


def com_panel(title: str, course: Course, *beside: Rows) -> Panel:
    """Return x, y and z of a centre of mass in um; its scale is that past the first moments."""
    return settled_panel(title, "um", course, UM, *beside)


def settled_panel(title: str, unit: str, course: Course, size: float, *beside: Rows) -> Panel:
    """Return the columns x, y, z of a course with bands of two sd."""
    rows = banded(AXES, course.t, course.values, course.sd, size)
    late = slice(int(SETTLED * len(course.t)), None)
    scale = around(course.values[late] / size, course.sd[late] / size)
    return Panel(title, unit, (rows, *beside), scale=scale)


def measured_rows(story: Story) -> tuple[Rows, ...]:
    """Return the estimates of the procedure."""
    if not story.measurements:
        return ()
    t = np.array([float(t) for t, _, _ in story.measurements])
    com = np.array([com for _, com, _ in story.measurements])
    return (rows_of([f"estimate {axis}" for axis in AXES], t, com, UM, "dots"),)


def true_rows(truth: TrueCourse) -> Rows:
    """Return where the simulated centre of mass really was; unknown while masses move (NaN)."""
    t, com = truth
    names = [f"truth {axis}" for axis in AXES]
    along = np.isnan(com).any()
    return straight(names, t, com, UM) if along else rows_of(names, t, com, UM, "dots")


def wanted_rows(story: Story, t: Series1) -> Rows:
    """Return the target from the first to the last of some times, with its tolerance."""
    target, tolerance = np.array([story.target] * 2), np.array([story.tolerance] * 2)
    names = [f"target {axis}" for axis in AXES]
    return banded(names, t[[0, -1]], target, tolerance / BAND, UM)
