"""Blocks as the terminal shows them, and the one style of everything printed there."""

from collections.abc import Iterable
from functools import singledispatch

from rich.console import Group, RenderableType
from rich.table import Table as RichTable
from rich.text import Text

from equipoise.app.console.plain_console import shown
from equipoise.app.console.terminal import stdout
from equipoise.app.text.blocks import (
    Block,
    Claim,
    Figure,
    Heading,
    Items,
    Moment,
    Pairs,
    Paragraph,
    Table,
)
from equipoise.app.text.charts import Chart, Heatmap, Replay
from equipoise.app.text.still import correlation_table, course_table

STYLES = {"plain": "", "good": "green", "bad": "red", "caution": "yellow", "quiet": "dim"}
MARKS = {"plain": "", "good": "ok", "bad": "PROBLEM", "caution": "!", "quiet": "~"}
WHAT = 11  # letters of the longest kind of step, "measurement"
NARROW = 2  # letters of a list's marks with the gap behind them
STEP_STYLES = {
    "measurement": "dim",
    "move": "cyan",
    "place": "bold cyan",
    "control": "cyan",
    "verify": "bold",
    "stop": "bold",
}


def show(blocks: Iterable[Block], below: bool = False) -> None:
    """Print blocks; ``below`` sets them off from what stands above already."""
    console, above = stdout(), None
    for block in blocks:
        if below if above is None else _set_off(above, block):
            console.print()
        console.print(renderable(block))
        above = block


def _set_off(above: Block, below: Block) -> bool:
    """Say whether an empty line stands between two blocks."""
    if isinstance(above, Heading):
        return False
    if isinstance(below, Heading | Table | Pairs) or isinstance(above, Table | Pairs):
        return True
    return isinstance(above, Moment) != isinstance(below, Moment)


@singledispatch
def renderable(block: Block) -> RenderableType:
    """Return what rich draws for a block."""
    raise TypeError(type(block))


@renderable.register
def _(block: Heading) -> Text:
    return shown(block.text, style="bold")


@renderable.register
def _(block: Paragraph) -> Text:
    return shown(block.text, style=STYLES[block.tone])


@renderable.register
def _(block: Claim) -> Text:
    return shown(block.text, style=f"bold {STYLES[block.tone]}".strip())


@renderable.register
def _(block: Items) -> RichTable:
    marks = [MARKS[item.tone] for item in block.items]
    grid = RichTable.grid()
    grid.add_column(width=max(NARROW, *(len(mark) + NARROW for mark in marks if len(mark) > 1), 0))
    grid.add_column()
    for mark, item in zip(marks, block.items, strict=True):
        grid.add_row(shown(mark), shown(item.text), style=STYLES[item.tone])
    return grid


@renderable.register
def _(block: Pairs) -> RichTable:
    grid = _quiet_table(header=False)
    grid.add_column(style="bold", no_wrap=True)
    grid.add_column()
    for name, text in block.pairs:
        grid.add_row(shown(name), shown(text))
    return grid


@renderable.register
def _(block: Table) -> Group:
    grid = _quiet_table(header=any(column.title for column in block.columns))
    # The names of rows are kept whole, and so is all that stands beside long texts.
    folds = any(column.fold for column in block.columns)
    for k, column in enumerate(block.columns):
        kept = not column.fold and (folds or k == 0)
        grid.add_column(
            shown(column.title), justify=column.align, style="" if k else "bold", no_wrap=kept
        )
    for row in block.rows:
        grid.add_row(*map(shown, row.cells), style=STYLES[row.tone])
    title = [shown(block.title, style="bold")] if block.title else []
    return Group(*title, *([grid] if block.rows else []), *map(shown, block.notes))


def _quiet_table(header: bool) -> RichTable:
    """Return a table without lines between rows."""
    return RichTable(box=None, pad_edge=False, show_header=header)


@renderable.register
def _(block: Moment) -> RichTable:
    grid = RichTable.grid(padding=(0, 2))
    grid.add_column(width=9, justify="right", no_wrap=True)
    grid.add_column(width=WHAT, no_wrap=True)
    grid.add_column()
    cells = map(shown, (block.time, block.what, block.text))
    grid.add_row(*cells, style=STEP_STYLES.get(block.what, ""))
    return grid


@renderable.register
def _(block: Figure) -> Text:
    return shown(f"[{block.name}] {block.caption}", style="dim")


@renderable.register
def _(block: Chart) -> Group:
    caption = shown(f"[{block.name}] {block.caption}", style="dim")
    return Group(caption, renderable(course_table(block)))


@renderable.register
def _(block: Replay) -> Text:
    return shown(f"[{block.name}] {block.caption}", style="dim")


@renderable.register
def _(block: Heatmap) -> RenderableType:
    return renderable(correlation_table(block))
