"""A keeping for terminal, JSON and report."""

from typing import Any

from equipoise.app.figures.balancing import kept_com
from equipoise.app.figures.catalogue import Picture
from equipoise.app.report.build import steps_section
from equipoise.app.report.run_record import Logged, Output, RunRecord, origin
from equipoise.app.runs.keeping import Keeping
from equipoise.app.text.blocks import Blocks, Row, Section, Table, number, paragraphs, table
from equipoise.app.text.estimate_text import parameter_table
from equipoise.app.text.json_document import KEEP
from equipoise.app.text.json_shape import View
from equipoise.app.text.numbers import fixed, with_sd
from equipoise.app.text.run_blocks import verdict_blocks
from equipoise.model.arrays import Vector3
from equipoise.model.estimate import COM
from equipoise.model.torque_terms import TERMS
from equipoise.model.units import MINUTE, MM, UM

MOST = 60  # steps in a report, chosen: two pages
ROWS = 12  # of the table, chosen: it fits beside the verdict
TITLE = "Centre of mass as the masses stood"
MOVES = "What moves it, at the last report"


def output_of(done: Keeping) -> Output:
    """Return all that is handed over."""
    bench = "real" if done.seed is None else "simulated"
    logged = Logged("balance", "keep", bench, None, None, done.verdict)
    return Output("keep", document(done), blocks(done), lambda: record_of(done), logged)


def blocks(done: Keeping) -> Blocks:
    """Return what masses did, and the verdict; steps were shown as they came."""
    moves = f"{done.moves} move{'s' * (done.moves != 1)}"
    moved = f"{moves} of the masses while holding, {done.travel / MM:.3g} mm in all"
    shown = (course_table(done), terms_table(done)) if len(done.course.t) else ()
    return (*shown, *paragraphs(moved), *verdict_blocks(done.verdict))


def terms_table(done: Keeping) -> Table:
    """Return what moves the centre of mass, as the last report has it: drift, heat and sag."""
    last = next(step.estimate for step in reversed(done.steps) if step.estimate is not None)
    return parameter_table(MOVES, [p for p in last.parameters if p.name in TERMS])


def course_table(done: Keeping) -> Table:
    """Return where the centre of mass stood, at some of the reports."""
    course, keep = done.course, slice(None, None, -(-len(done.course.t) // ROWS))
    columns = (number("time", "min"), *(number(name, "um") for name in COM))
    every = zip(course.t[keep].tolist(), course.values[keep], course.sd[keep], strict=True)
    rows = ((fixed(t / MINUTE, 1), *com_cells(com, sd)) for t, com, sd in every)
    return table(TITLE, columns, map(Row, rows))


def com_cells(com: Vector3, sd: Vector3) -> list[str]:
    """Return the texts of a centre of mass (m) with its sd, um."""
    pairs = zip((com / UM).tolist(), (sd / UM).tolist(), strict=True)
    return [" ± ".join(with_sd(*pair)) for pair in pairs]


def document(done: Keeping) -> View:
    """Return the run as JSON."""
    fields: dict[str, Any] = {
        "steps": done.steps,
        "verdict": done.verdict,
        "moves": done.moves,
        "travel": done.travel,
        "course": done.course,
        "truth": done.truth,
        "provenance": _origin(done),
    }
    return KEEP.write(fields)


def record_of(done: Keeping) -> RunRecord:
    """Return the run as a report."""
    goal = done.goal
    names = ("target", "tolerance")
    wanted = {
        name: f"({', '.join(fixed(float(v) / UM, 1) for v in values)}) um"
        for name, values in zip(names, (goal.target, goal.tolerance), strict=True)
    }
    drawn = []
    if len(done.course.t) > 1:
        figure = kept_com.draw(done.course, done.truth, goal.target, goal.tolerance)
        drawn = [Picture("kept_com", kept_com.CAPTION, figure)]
    sections: tuple[Section, ...] = (steps_section("Steps", done.steps[-MOST:], {}),)
    return RunRecord(
        title="Balance kept during an experiment",
        requested=wanted,
        testbed=done.testbed,
        conclusion=blocks(done),
        sections=sections,
        origin=_origin(done),
        figures=drawn,
    )


def _origin(done: Keeping) -> dict[str, str]:
    drawn = {} if done.seed is None else {"seed": str(done.seed)}
    return origin(testbed=done.testbed.source, **drawn)
