"""A balancing in two levels for terminal, JSON and report."""

from dataclasses import replace

from equipoise.app.figures.catalogue import Picture
from equipoise.app.figures.step_catalogue import Frame, pictures_of_steps
from equipoise.app.report.build import estimate_sections, steps_section
from equipoise.app.report.run_record import Logged, Output, RunRecord, origin
from equipoise.app.runs.balancing import Balancing
from equipoise.app.runs.joint_balancing import InTwoLevels
from equipoise.app.text.blocks import Blocks, paragraphs
from equipoise.app.text.json_document import BALANCE
from equipoise.app.text.json_shape import View
from equipoise.app.text.run_blocks import verdict_blocks
from equipoise.app.views.balancing import balance_views, manual_views
from equipoise.app.views.balancing.balance_views import change_blocks, requested, wanted
from equipoise.procedure.identification.record_courses import RecordCourses


def output_of(done: InTwoLevels, of: dict[str, str]) -> Output:
    """Return all that is handed over; ``of`` says what it was made of."""
    masses = done.by_masses
    if masses is None:
        return manual_views.output_of(done.by_hand, of)
    return Output(
        "balance",
        document(done, masses, of),
        blocks(done, masses),
        lambda: record_of(done, masses, of),
        logged_of(masses),
    )


def document(done: InTwoLevels, masses: Balancing, of: dict[str, str]) -> View:
    """Return the session as JSON: the steps of the hands, then those of the masses."""
    return BALANCE.write({
        "steps": done.steps,
        "verdict": masses.verdict,
        "truth": masses.truths[-1] if masses.truths else None,
        "provenance": origin(**of),
    })  # fmt: skip


def logged_of(masses: Balancing) -> Logged:
    """Return what a logbook keeps beside the report."""
    logged = balance_views.logged_of(masses)
    return replace(logged, method=f"by hand, then {logged.method}")


def from_the_beginning(done: InTwoLevels, masses: Balancing) -> Balancing:
    """Return the masses' part as if it had begun with the platform before any weight."""
    first = done.by_hand.balancing
    return replace(masses, before=first.before, truth_before=first.truth_before)


def effort(done: InTwoLevels, masses: Balancing) -> str:
    """Return what it took."""
    moves = sum(step.move is not None for step in masses.steps)
    own = f"Then {moves} move{'s' * (moves != 1)} of masses, {masses.steps[-1].time:.0f} s."
    return f"{manual_views.effort(done.by_hand)} {own}"


def blocks(done: InTwoLevels, masses: Balancing) -> Blocks:
    """Return before and after, the verdict, and what it took."""
    return (*conclusion(done, masses), *paragraphs(effort(done, masses)))


def conclusion(done: InTwoLevels, masses: Balancing) -> Blocks:
    """Return before and after, and the verdict."""
    change = change_blocks(from_the_beginning(done, masses))
    return (*change, *verdict_blocks(masses.verdict))


def record_of(done: InTwoLevels, masses: Balancing, of: dict[str, str]) -> RunRecord:
    """Return the session as a report."""
    first, courses = done.by_hand.balancing, masses.courses()
    by_hand = pictures_of_steps(first.steps, Frame(first.testbed, wanted(first.goal)))
    by_masses = pictures_of_steps(
        masses.steps,
        Frame(masses.testbed, wanted(masses.goal)),
        len(first.steps) + 1,
    )
    return RunRecord(
        title="Balancing by hand, then by masses",
        requested=requested(masses) | {"effort": effort(done, masses)},
        testbed=first.testbed,
        conclusion=conclusion(done, masses),
        sections=(
            steps_section("Steps by hand", first.steps, by_hand),
            steps_section("Steps of the masses", masses.steps, by_masses),
            *estimate_sections(masses.estimate, masses.testbed),
        ),
        origin=origin(**of),
        figures=pictures_of(done, masses, courses),
        step_figures=(*by_hand.values(), *by_masses.values()),
    )


def pictures_of(done: InTwoLevels, masses: Balancing, courses: RecordCourses) -> list[Picture]:
    """Return the centre of mass by recording, and the figures of the masses."""
    return [
        *manual_views.pictures_of(done.by_hand),
        *balance_views.pictures_of_tracking(masses, courses),
        *balance_views.pictures_of(masses, courses),
    ]
