"""A balancing by hand for terminal, JSON and report."""

import numpy as np

from equipoise.app.figures.balancing import rounds_com
from equipoise.app.figures.balancing.story import Marked, Story
from equipoise.app.figures.catalogue import Picture
from equipoise.app.figures.step_catalogue import Frame, pictures_of_steps
from equipoise.app.report.build import estimate_sections, steps_section
from equipoise.app.report.run_record import Logged, Output, RunRecord, origin
from equipoise.app.runs.manual_balancing import ByHand
from equipoise.app.text.blocks import Blocks, paragraphs
from equipoise.app.text.com_estimate import as_it_stands
from equipoise.app.text.estimate_text import outcome_claim
from equipoise.app.text.json_document import BALANCE
from equipoise.app.text.json_shape import View
from equipoise.app.text.run_blocks import verdict_blocks
from equipoise.app.views.balancing.balance_views import change_blocks, requested, wanted
from equipoise.model.arrays import Vector3

TRIAL = (
    "Manual balancing by trial and error is reported to take hours and to leave some 1e-2 N m "
    "(da Silva et al. 2021)."
)


def effort(done: ByHand) -> str:
    """Return what it took."""
    handled, rounds = sum(placing.handled for placing in done.placings), len(done.placings)
    return (
        f"{rounds} round{'s' * (rounds != 1)} of weights, {handled} placed or removed, "
        f"{done.recorded:.0f} s of recordings."
    )


def output_of(done: ByHand, of: dict[str, str]) -> Output:
    """Return all that is handed over; ``of`` says what it was made of."""
    return Output(
        "balance",
        document(done, of),
        blocks(done),
        lambda: record_of(done, of),
        logged_of(done),
    )


def logged_of(done: ByHand) -> Logged:
    """Return what a logbook keeps beside the report."""
    balancing = done.balancing
    bench = "simulated" if balancing.simulated else "real"
    return Logged(
        "balance", "by hand", bench, balancing.recording, balancing.estimate, done.verdict
    )


def blocks(done: ByHand) -> Blocks:
    """Return before and after, the verdict, and what it took; nothing before the verdict."""
    if done.verdict is None:
        return ()
    taken = paragraphs(f"{effort(done)} {TRIAL}")
    return (*change_blocks(done.balancing), *verdict_blocks(done.verdict), *taken)


def document(done: ByHand, of: dict[str, str]) -> View:
    """Return the run as JSON; ``of`` says what it was made of."""
    truths = done.balancing.truths
    return BALANCE.write({
        "steps": done.balancing.steps,
        "verdict": done.verdict,
        "truth": truths[-1] if truths else None,
        "provenance": origin(**of),
    })  # fmt: skip


def record_of(done: ByHand, of: dict[str, str]) -> RunRecord:
    """Return the run as a report."""
    balancing = done.balancing
    bed, bench = balancing.testbed, "simulated hands" if balancing.truths else "a person's hands"
    shown = pictures_of_steps(balancing.steps, Frame(bed, wanted(balancing.goal)))
    return RunRecord(
        title="Balancing by hand",
        requested=requested(balancing) | {"bench": bench, "effort": effort(done)},
        testbed=bed,
        conclusion=(*conclusion(done), *change_blocks(balancing)),
        sections=(
            steps_section("Steps", balancing.steps, shown),
            *estimate_sections(balancing.estimate, bed),
        ),
        origin=origin(**of),
        figures=pictures_of(done),
        step_figures=tuple(shown.values()),
    )


def conclusion(done: ByHand) -> Blocks:
    """Return the verdict, else what the last estimate comes to, if there is one."""
    if done.verdict is not None:
        return verdict_blocks(done.verdict)
    estimate = done.balancing.estimate
    return () if estimate is None else (outcome_claim(estimate),)


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
