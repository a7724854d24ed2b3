"""A balancing by hand for terminal, JSON and report."""

import numpy as np

from equipoise.app.console.rich_results import change_table
from equipoise.app.console.terminal import stdout
from equipoise.app.figures.balancing import rounds_com
from equipoise.app.figures.balancing.balanced_com import Marked, Story
from equipoise.app.figures.catalogue import Picture
from equipoise.app.figures.step_catalogue import Frame, pictures_of_steps
from equipoise.app.report.run_record import Account, origin
from equipoise.app.runs.balancing import change_of
from equipoise.app.runs.manual_balancing import ByHand
from equipoise.app.text.com_estimate import as_it_stands
from equipoise.app.text.json_document import View, balance_json
from equipoise.app.views.balance_views import requested, wanted
from equipoise.model.arrays import Vector3
from equipoise.procedure.identification.record_courses import RecordCourses

TRIAL = (
    "Manual balancing by trial and error is reported to take hours and to leave some 1e-2 N m "
    "(da Silva et al. 2021)."
)


def effort(done: ByHand) -> str:
    """Return what it took."""
    handled, rounds = sum(placing.handled for placing in done.placings), len(done.placings)
    return (
        f"{rounds} round{'s' * (rounds != 1)} of weights, {handled} handled, "
        f"{done.recorded:.0f} s of recordings."
    )


def show_result(done: ByHand) -> None:
    """Print before and after, the verdict, and what it took."""
    console, change, verdict = stdout(), change_of(done.balancing), done.verdict
    if verdict is None:
        return
    console.print()
    if change is not None:
        console.print(change_table(change))
        console.print()
    console.print(verdict.sentence, style="bold green" if verdict.passed else "bold red",
                  markup=False)  # fmt: skip
    console.print(f"{effort(done)} {TRIAL}", markup=False)


def document_of(done: ByHand, of: dict[str, str]) -> View:
    """Return the run as JSON; ``of`` says what it was made of."""
    truths, provenance = done.balancing.truths, origin(**of)
    return balance_json(
        done.balancing.steps, done.verdict, truths[-1] if truths else None, provenance
    )


def account_of(done: ByHand, of: dict[str, str], courses: RecordCourses) -> Account:
    """Return the run as a report."""
    balancing = done.balancing
    bench = "simulated hands" if balancing.truths else "a person's hands"
    return Account(
        title="Balancing by hand",
        requested=requested(balancing) | {"bench": bench, "effort": effort(done)},
        testbed=balancing.testbed,
        chapters={"Steps": balancing.steps},
        origin=origin(**of),
        estimate=balancing.estimate,
        verdict=done.verdict,
        change=change_of(balancing),
        pictures=pictures_of(done),
        step_pictures=pictures_of_steps(
            balancing.steps,
            Frame(balancing.testbed, wanted(balancing.goal), motions=courses.steps),
        ),
    )


def pictures_of(done: ByHand) -> list[Picture]:
    """Return the centre of mass by recording."""
    balancing, measurements = done.balancing, list[Marked]()
    truth: list[Vector3] = []
    estimates = [k for k, step in enumerate(balancing.steps) if step.kind == "estimate"]
    for number, k in enumerate(estimates, 1):
        estimate = balancing.steps[k].estimate
        estimated = None if estimate is None else as_it_stands(estimate)
        if estimated is not None:
            measurements.append((float(number), estimated.com, estimated.sd))
        if balancing.truths:
            truth.append(balancing.truths[k].com)
    if not measurements:
        return []
    course = (np.arange(1.0, len(truth) + 1), np.array(truth)) if truth else None
    story = Story(measurements, balancing.goal.target, balancing.goal.tolerance, course)
    return [Picture("rounds_com", rounds_com.CAPTION, rounds_com.draw(story))]
