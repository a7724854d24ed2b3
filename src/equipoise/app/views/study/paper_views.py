"""A paper's numbers beside our own, as blocks and JSON, whichever paper."""

from collections.abc import Sequence

from equipoise.app.text.blocks import Column, Row, Table, Tone, number, prose
from equipoise.app.text.numbers import significant
from equipoise.study.papers.paper_row import Agreement, PaperRow

TONE: dict[Agreement, Tone] = {
    Agreement.AGREES: "good",
    Agreement.BETTER: "good",
    Agreement.DIFFERS: "caution",
    Agreement.SHOWN: "plain",
}


def paper_table(title: str, rows: Sequence[PaperRow]) -> Table:
    """Return all rows: where, what and why, as printed, as found here, the verdict."""
    columns = (Column("item"), prose("quantity, and remarks"),
               number("printed"), number("this program"), Column("verdict"))  # fmt: skip
    return Table(title, columns, tuple(map(line, rows)))


def line(row: PaperRow) -> Row:
    """Return a row of the table, its tone that of the verdict."""
    quantity = ", ".join(filter(None, (row.quantity, row.unit)))
    what = ": ".join(filter(None, (quantity, row.why)))
    cells = (row.place, what, numbers(row.printed), numbers(row.ours), row.agreement.value)
    return Row(cells, TONE[row.agreement])


def numbers(values: Sequence[float]) -> str:
    """Return one number, several in order, or a dash where there is none."""
    return ", ".join(significant(value) for value in values) or "-"
