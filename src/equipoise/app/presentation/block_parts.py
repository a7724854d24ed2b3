"""Parts that several records show: steps of a procedure, and sheets, as blocks."""

from collections.abc import Iterator, Sequence

from equipoise.app.presentation.tables import Table
from equipoise.app.text.blocks import Block, Grid, Heading, Moment, Paragraph
from equipoise.app.text.sheet import Sheet
from equipoise.model.step import Step


def sheet_blocks(sheet: Sheet) -> Iterator[Block]:
    """Yield title, table and remarks."""
    yield Heading(sheet.title)
    yield Grid(tuple(sheet.heads), tuple(map(tuple, sheet.lines)), tuple(sheet.words[1:]))
    yield from map(Paragraph, sheet.remarks)


def moments(steps: Sequence[Step]) -> Iterator[Moment]:
    """Yield when, what, and what came of it."""
    for step in steps:
        yield Moment(f"{step.time:.1f} s", step.kind, step.sentence)


def step_table(steps: Sequence[Step]) -> Table:
    """Return a row a step."""
    return Table(
        "step",
        {
            "step": list(range(1, len(steps) + 1)),
            "time_s": [step.time for step in steps],
            "kind": [step.kind for step in steps],
            "sentence": [step.sentence for step in steps],
        },
    )
