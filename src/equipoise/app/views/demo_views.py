"""The demo for terminal, JSON and report: the balancing with the identification before it."""

from collections.abc import Mapping
from dataclasses import replace

from equipoise.app.charts.catalogue import IDENTIFICATION, charts_of_fit
from equipoise.app.charts.of_correlation import correlations_of
from equipoise.app.charts.of_courses import OF_TRACKING
from equipoise.app.charts.of_courses import of_move as charts_of_move
from equipoise.app.charts.of_courses import of_tracking as charts_of_tracking
from equipoise.app.charts.of_motion import of_motion
from equipoise.app.figures.catalogue import Picture, of_fit, of_move, of_tracking
from equipoise.app.figures.step_catalogue import Frame, pictures_of_steps
from equipoise.app.report.build import estimate_sections, steps_section
from equipoise.app.report.run_record import Output, RunRecord
from equipoise.app.runs.demonstration import GOAL, DemoCourses, Demonstration, courses_of
from equipoise.app.text.charts import Drawn
from equipoise.app.views.balancing import balance_views
from equipoise.model.step import Step


def output_of(shown: Demonstration) -> Output:
    """Return all that is handed over."""
    output = balance_views.output_of(shown.balancing)
    logged = replace(balance_views.logged_of(shown.balancing), estimate=shown.estimate)
    return replace(output, record=lambda: record_of(shown, courses_of(shown)), logged=logged)


def record_of(shown: Demonstration, courses: DemoCourses) -> RunRecord:
    """Return the report."""
    figures = _figures_of_steps(shown)
    return replace(
        balance_views.record_of(shown.balancing, courses.balanced),
        title="From unknown and unbalanced to identified, balanced and verified",
        sections=(
            steps_section("Identify", shown.identified, figures),
            steps_section("Balance", shown.balancing.steps, figures),
            *estimate_sections(
                shown.estimate, shown.balancing.testbed, *correlations_of(shown.estimate)
            ),
        ),
        figures=pictures(shown, courses),
        step_figures=tuple(figures.values()),
        charts=charts(shown, courses),
    )


def charts(shown: Demonstration, courses: DemoCourses) -> tuple[Drawn, ...]:
    """Return the replays of both records, and the charts of figures 6 to 15."""
    bed, recording, along = shown.balancing.testbed, shown.recording, courses.identified
    moved = () if along.tracked is None else charts_of_move(
        recording, along.tracked, shown.truth, IDENTIFICATION)  # fmt: skip
    balanced = balance_views.charts_of(shown.balancing, courses.balanced)
    return (
        *of_motion(recording, bed, shown.estimate, IDENTIFICATION),
        *charts_of_fit(recording, along),
        *charts_of_tracking(courses.still, courses.tracked, IDENTIFICATION),
        *moved,
        *(chart for chart in balanced if chart.name not in OF_TRACKING),
    )


def _figures_of_steps(shown: Demonstration) -> Mapping[Step, Picture]:
    bed, first = shown.balancing.testbed, len(shown.identified) + 1
    balanced = Frame(bed, balance_views.wanted(GOAL))
    return {
        **pictures_of_steps(shown.identified, Frame(bed, at_home=True)),
        **pictures_of_steps(shown.balancing.steps, balanced, first),
    }


def pictures(shown: Demonstration, courses: DemoCourses) -> list[Picture]:
    """Return figures 6, 7, 8, 11, 12, 13, 14 and 15."""
    recording, along = shown.recording, courses.identified
    fit = () if along.fit is None else of_fit(recording, along.fit)
    moved = () if along.tracked is None else of_move(recording, along.tracked, shown.truth)
    return [
        *fit,
        *of_tracking(courses.still, courses.tracked, shown.truth[1][0]),
        *moved,
        *balance_views.pictures_of(shown.balancing, courses.balanced),
    ]
