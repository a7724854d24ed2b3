"""A balancing run for terminal, JSON and report."""

from typing import Any

import numpy as np

from equipoise.app.charts.catalogue import charts_of_balancing
from equipoise.app.charts.of_correlation import correlations_of
from equipoise.app.figures.balancing.story import Story
from equipoise.app.figures.catalogue import Picture, TrueCourse, of_balancing, of_tracking
from equipoise.app.figures.estimate.step_com import Wanted
from equipoise.app.figures.step_catalogue import Frame, pictures_of_steps
from equipoise.app.report.build import estimate_sections, steps_section
from equipoise.app.report.run_record import Logged, Output, RunRecord, origin
from equipoise.app.runs.balancing import Balancing, Goal, change_of, measurements
from equipoise.app.text.before_after import change_table
from equipoise.app.text.blocks import Blocks
from equipoise.app.text.charts import Drawn
from equipoise.app.text.json_document import BALANCE
from equipoise.app.text.json_shape import View
from equipoise.app.text.numbers import fixed
from equipoise.app.text.run_blocks import verdict_blocks
from equipoise.model.arrays import Vector3
from equipoise.model.units import UM
from equipoise.procedure.identification.record_courses import RecordCourses


def output_of(done: Balancing) -> Output:
    """Return all that is handed over."""
    return Output(
        "balance",
        document(done),
        blocks(done),
        lambda: record_of(done, done.courses()),
        logged_of(done),
    )


def blocks(done: Balancing) -> Blocks:
    """Return before and after, and the verdict; steps were shown as they came."""
    return (*change_blocks(done), *verdict_blocks(done.verdict))


def change_blocks(done: Balancing) -> Blocks:
    """Return before and after; nothing where no estimate was made."""
    change = change_of(done)
    return () if change is None else (change_table(change),)


def document(done: Balancing) -> View:
    """Return the run as JSON."""
    return BALANCE.write(document_fields(done))


def document_fields(done: Balancing) -> dict[str, Any]:
    """Return what the document is written from."""
    return {
        "steps": done.steps,
        "verdict": done.verdict,
        "truth": done.truths[-1] if done.truths else None,
        "provenance": _origin(done),
    }


def logged_of(done: Balancing) -> Logged:
    """Return what a logbook keeps beside the report."""
    bench = "simulated" if done.simulated else "real"
    return Logged("balance", done.law, bench, done.recording, done.estimate, done.verdict)


def record_of(done: Balancing, courses: RecordCourses) -> RunRecord:
    """Return the run as a report."""
    shown = pictures_of_steps(done.steps, Frame(done.testbed, wanted(done.goal)))
    return RunRecord(
        title="Balancing",
        requested=requested(done),
        testbed=done.testbed,
        conclusion=(*verdict_blocks(done.verdict), *change_blocks(done)),
        sections=(
            steps_section("Steps", done.steps, shown),
            *estimate_sections(done.estimate, done.testbed, *correlations_of(done.estimate)),
        ),
        origin=_origin(done),
        figures=[*pictures_of_tracking(done, courses), *pictures_of(done, courses)],
        step_figures=tuple(shown.values()),
        charts=charts_of(done, courses),
    )


def wanted(goal: Goal) -> Wanted:
    """Return where the centre of mass is to be, for a figure."""
    return Wanted(goal.target, goal.tolerance)


def _origin(done: Balancing) -> dict[str, str]:
    """Return where it comes from; what is drawn by a seed is the simulated platform."""
    drawn = {} if done.seed is None else {"seed": str(done.seed)}
    return origin(testbed=done.testbed.source, **drawn)


def requested(done: Balancing) -> dict[str, str]:
    """Return target and tolerance as texts."""
    return {
        "target": _um(done.goal.target),
        "tolerance": _um(done.goal.tolerance),
        "bench": "simulated" if done.simulated else "real",
    }


def pictures_of_tracking(done: Balancing, courses: RecordCourses) -> list[Picture]:
    """Return Figs. 11 and 12; the tracker's centre of mass is with the masses at home."""
    if done.recording is None or courses.tracked is None:
        return []
    return list(of_tracking(done.recording, courses.tracked, None))


def pictures_of(done: Balancing, courses: RecordCourses) -> list[Picture]:
    """Return Figs. 14 and 15."""
    if done.recording is None or courses.tracked is None:
        return []
    return list(of_balancing(done.recording, done.testbed, courses.tracked, story_of(done)))


def charts_of(done: Balancing, courses: RecordCourses) -> tuple[Drawn, ...]:
    """Return replay and charts along the recording."""
    story = story_of(done)
    return charts_of_balancing(done.recording, done.testbed, done.estimate, courses, story)


def story_of(done: Balancing) -> Story:
    """Return what stands beside the tracker's curve."""
    return Story(measurements(done), done.goal.target, done.goal.tolerance, true_course(done))


def true_course(done: Balancing) -> TrueCourse | None:
    """Return where the centre of mass really was at every step."""
    if not done.truths:
        return None
    return np.array([s.time for s in done.steps]), np.array([t.com for t in done.truths])


def _um(vector: Vector3) -> str:
    return f"({', '.join(fixed(float(v) / UM, 1) for v in vector)}) um"
