"""The review's Tables 2 and 3, measured, as tables (``study.review_tables``)."""

from collections.abc import Sequence

from equipoise.app.text.blocks import Column, Table, number, prose, tabulated
from equipoise.app.views.study.method_comparison import percent, seconds
from equipoise.model.units import MEGABYTE, MS, UM, UN_M
from equipoise.study.compare_laws import LawSummary
from equipoise.study.compare_methods import MethodSummary
from equipoise.study.review_tables import Span, law_rows, method_rows

SOURCE = "da Silva et al. 2021"
TABLE_2 = (
    f"Claims after {SOURCE}, Table 2, abridged; numbers in brackets are its "
    "references. Measured, from the best method of a row to the worst: accuracy is "
    "RMSE / bound, and bias (mismodelling) bias / bound, of the centre of mass; ms "
    "and MB are effort and memory for one record; settles, the seconds until the com "
    "error stays below a tenth of its initial value (convergence; never: in most "
    "runs); failed and wrong, the share of runs without a usable result and of "
    "confident errors above 5 sd (robustness)."
)
TABLE_3 = (
    f"Claims after {SOURCE}, Table 3 and sections 3 and 4; reported: hardware results "
    "of its Table 1. Measured medians, from the best law of a row to the worst: "
    "residual torque, horizontal and vertical offset, bench time; halted for safety; "
    "false: verdicts that passed a platform outside the tolerance. A row without "
    "numbers was not run here."
)


def spread_text(span: Span, unit: float = 1.0) -> str:
    """Return from the best to the worst."""
    best, worst = (seconds(value / unit) for value in span)
    return best if best == worst else f"{best} to {worst}"


def methods_table(methods: Sequence[MethodSummary], testbed: str) -> Table:
    """Return Table 2, measured."""
    rows = method_rows(methods)
    members = "; ".join(f"{row.printed.name}: {', '.join(row.methods)}" for row in rows)
    return tabulated(
        f"As the review's Table 2, measured on {testbed}",
        rows,
        (Column(), lambda row: row.printed.name),
        (prose("the table says"), lambda row: row.printed.says),
        (number("accuracy"), lambda row: spread_text(row.accuracy)),
        (number("bias"), lambda row: spread_text(row.bias)),
        (number("ms"), lambda row: spread_text(row.time, MS)),
        (number("MB"), lambda row: spread_text(row.memory, MEGABYTE)),
        (number("settles"), lambda row: spread_text(row.settled)),
        (number("failed"), lambda row: percent(row.failed)),
        (number("wrong"), lambda row: percent(row.wrong)),
        notes=(TABLE_2, f"{members}."),
    )


def laws_table(laws: Sequence[LawSummary], testbed: str) -> Table:
    """Return Table 3, measured."""
    return tabulated(
        f"As the review's Table 3, measured on {testbed}",
        law_rows(laws),
        (prose(), lambda row: row.printed.name),
        (prose("the review says"), lambda row: row.printed.says),
        (prose("reported"), lambda row: row.printed.reported or "none"),
        (prose("laws"), lambda row: ", ".join(row.laws)),
        (number("", "uN m"), lambda row: spread_text(row.torque, UN_M)),
        (number("sideways", "um"), lambda row: spread_text(row.aside, UM)),
        (number("height", "um"), lambda row: spread_text(row.height, UM)),
        (number("", "s"), lambda row: spread_text(row.time)),
        (number("halted"), lambda row: percent(row.halted)),
        (number("false passes"), lambda row: percent(row.false_passes)),
        notes=(TABLE_3,),
    )
