"""The review's Tables 2 and 3, measured, as tables (``study.review_tables``)."""

from collections.abc import Sequence

from equipoise.app.text.blocks import Column, Table, number, prose, table
from equipoise.app.views.study.method_comparison import percent, seconds
from equipoise.model.units import MEGABYTE, MS, UM, UN_M
from equipoise.study.compare_laws import LawSummary
from equipoise.study.compare_methods import MethodSummary
from equipoise.study.review_tables import LawRow, MethodRow, Span, law_rows, method_rows

SOURCE = "da Silva et al. 2021"
TABLE_2 = (
    f"What the table says is after {SOURCE}, Table 2, in short; numbers in brackets are its "
    "references. Measured, from the best method of a row to the worst: accuracy is RMSE / bound, "
    "and bias (mismodelling) bias / bound, of the centre of mass; ms and MB are effort and memory "
    "for one record; settles, the seconds until com stays within a tenth of the first error "
    "(convergence; never: mostly not at all); failed and wrong, the share of runs without a usable "
    "result and of confident misses by more than 5 sd (robustness)."
)
TABLE_3 = (
    f"What the table says is after {SOURCE}, Table 3 and sections 3 and 4; reported: results of "
    "hardware after its Table 1. Measured, medians, from the best law of a row to the worst: "
    "torque left, offset aside and in height, bench time; halted for safety; false: verdicts that "
    "passed what was twice the tolerance off. A row without numbers was not run here."
)


def spread_text(span: Span, unit: float = 1.0) -> str:
    """Return from the best to the worst."""
    best, worst = (seconds(value / unit) for value in span)
    return best if best == worst else f"{best} to {worst}"


def methods_table(methods: Sequence[MethodSummary], testbed: str) -> Table:
    """Return Table 2, measured."""
    headings = ("accuracy", "bias", "ms", "MB", "settles", "failed", "wrong")
    columns = (Column(), prose("the table says"), *map(number, headings))
    lines = [method_cells(row) for row in method_rows(methods)]
    title = f"As the review's Table 2, measured on {testbed}"
    return table(title, columns, lines, (TABLE_2, *members(lines, method_rows(methods))))


def method_cells(row: MethodRow) -> list[str]:
    """Return a row of Table 2."""
    return [
        row.printed.name,
        row.printed.says,
        spread_text(row.accuracy),
        spread_text(row.bias),
        spread_text(row.time, MS),
        spread_text(row.memory, MEGABYTE),
        spread_text(row.settled),
        percent(row.failed),
        percent(row.wrong),
    ]


def members(lines: Sequence[Sequence[str]], rows: Sequence[MethodRow]) -> list[str]:
    """Say which methods are in which row."""
    reported = [
        f"{line[0]}: {', '.join(row.methods)}" for line, row in zip(lines, rows, strict=True)
    ]
    return ["; ".join(reported) + "."]


def laws_table(laws: Sequence[LawSummary], testbed: str) -> Table:
    """Return Table 3, measured."""
    texts = map(prose, ("the review says", "reported", "laws"))
    columns = (prose(), *texts, number("", "uN m"), number("aside", "um"), number("height", "um"),
               number("", "s"), number("halted"), number("false"))  # fmt: skip
    lines = [law_cells(row) for row in law_rows(laws)]
    title = f"As the review's Table 3, measured on {testbed}"
    return table(title, columns, lines, (TABLE_3,))


def law_cells(row: LawRow) -> list[str]:
    """Return a row of Table 3."""
    return [
        row.printed.name,
        row.printed.says,
        row.printed.reported or "none",
        ", ".join(row.laws),
        spread_text(row.torque, UN_M),
        spread_text(row.aside, UM),
        spread_text(row.height, UM),
        spread_text(row.time),
        percent(row.halted),
        percent(row.false_passes),
    ]
