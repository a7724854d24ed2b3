"""The still form of blocks that a page shows to be used: drawings and tables."""

from collections.abc import Iterable, Iterator
from dataclasses import replace

from equipoise.app.text.blocks import Block, Column, Document, Figure, Table, number, table
from equipoise.app.text.charts import Chart, Heatmap, Replay
from equipoise.app.text.numbers import fixed
from equipoise.app.text.sparkline import BLOCKS, above_least

WIDTH = 40  # letters of a course, chosen: beside its name in 80 columns


def still(document: Document) -> Document:
    """Return a document for media that do not move: drawings and tables in place of charts.

    What has no still form is left out.
    """
    sections = (replace(s, blocks=tuple(_still(s.blocks))) for s in document.sections)
    return replace(document, sections=tuple(sections))


def _still(blocks: Iterable[Block]) -> Iterator[Block]:
    for block in blocks:
        if isinstance(block, Heatmap):
            yield correlation_table(block)
        elif isinstance(block, Chart):
            yield from drawing_of(block)
        elif not isinstance(block, Replay):
            yield block


def drawing_of(chart: Chart) -> tuple[Figure, ...]:
    """Return the figure that a chart stands for; nothing if there is none."""
    return (Figure(chart.name, chart.drawing),) if chart.drawing else ()


def correlation_table(block: Heatmap) -> Table:
    """Return correlations as a table; rows have the numbers that head its columns."""
    columns = (Column(), *(number(str(k + 1)) for k in range(len(block.names))))
    rows = (
        (f"{k} {name}", *map(correlation, values))
        for k, (name, values) in enumerate(zip(block.names, block.values, strict=True), 1)
    )
    return table(block.title, columns, rows, filter(None, (block.note,)))


def correlation(value: float | None) -> str:
    """Return a correlation with the two digits that can be told apart."""
    return "" if value is None else fixed(value, 2)


def course_table(block: Chart, letters: str = BLOCKS) -> Table:
    """Return a line of letters for each column of a chart, from its least to its greatest."""
    columns = (
        Column(),
        Column("unit"),
        Column(", ".join(filter(None, (block.axis, block.axis_unit)))),
    )
    rows = (
        (f"{panel.title}: {name}", panel.unit, above_least(column, WIDTH, letters))
        for panel in block.panels
        for rows in panel.rows
        for name, column in zip(rows.names, rows.columns, strict=True)
    )
    return table("", columns, rows)
