"""A balancing run for terminal, JSON and report."""

import numpy as np

from equipoise.app.console.rich_results import change_table, noise_floor_line, step_line
from equipoise.app.console.terminal import stdout
from equipoise.app.figures.balancing.balanced_com import Story
from equipoise.app.figures.catalogue import Picture, TrueCourse, of_balancing, of_tracking
from equipoise.app.figures.estimate.step_com import Wanted
from equipoise.app.figures.step_catalogue import Frame, pictures_of_steps
from equipoise.app.report.logbook_entry import Kept
from equipoise.app.report.run_record import Account, origin
from equipoise.app.runs.balancing import Balancing, Goal, change_of, measurements
from equipoise.app.text.json_document import View, balance_json
from equipoise.app.text.numbers import fixed
from equipoise.app.text.units import UM
from equipoise.model.arrays import Vector3
from equipoise.model.step import Step
from equipoise.procedure.identification.record_courses import RecordCourses


def show_step(step: Step) -> None:
    """Print a step as it comes."""
    stdout().print(step_line(step))


def show_result(done: Balancing) -> None:
    """Print before and after, and the verdict."""
    console, change, verdict = stdout(), change_of(done), done.verdict
    console.print()
    if change is not None:
        console.print(change_table(change))
        console.print()
    style = "bold green" if verdict.passed else "bold red"
    console.print(verdict.sentence, style=style, markup=False)
    if floor := noise_floor_line(verdict):
        console.print(floor, style="dim", markup=False)


def document_of(done: Balancing, seed: int | None) -> View:
    """Return the run as JSON."""
    truth = done.truths[-1] if done.truths else None
    return balance_json(done.steps, done.verdict, truth, _origin(done, seed))


def kept_of(done: Balancing, law: str) -> Kept:
    """Return what a logbook is told beside the report."""
    return Kept("balance", law, "simulated" if done.simulated else "real", done.recording)


def account_of(done: Balancing, seed: int, courses: RecordCourses) -> Account:
    """Return the run as a report."""
    return Account(
        title="Balancing",
        requested=requested(done),
        testbed=done.testbed,
        chapters={"Steps": done.steps},
        origin=_origin(done, seed),
        estimate=done.estimate,
        verdict=done.verdict,
        change=change_of(done),
        pictures=[*pictures_of_tracking(done, courses), *pictures_of(done, courses)],
        step_pictures=pictures_of_steps(
            done.steps, Frame(done.testbed, wanted(done.goal), motions=courses.steps)
        ),
    )


def wanted(goal: Goal) -> Wanted:
    """Return where the centre of mass is to be, for a figure."""
    return Wanted(goal.target, goal.tolerance)


def _origin(done: Balancing, seed: int | None) -> dict[str, str]:
    """Return where it comes from; what is drawn by a seed is the simulated platform."""
    drawn = {"seed": str(seed)} if done.simulated and seed is not None else {}
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
    story = Story(measurements(done), done.goal.target, done.goal.tolerance, true_course(done))
    return list(of_balancing(done.recording, done.testbed, courses.tracked, story))


def true_course(done: Balancing) -> TrueCourse | None:
    """Return where the centre of mass really was at every step."""
    if not done.truths:
        return None
    return np.array([s.time for s in done.steps]), np.array([t.com for t in done.truths])


def _um(vector: Vector3) -> str:
    return f"({', '.join(fixed(float(v) * UM, 1) for v in vector)}) um"
