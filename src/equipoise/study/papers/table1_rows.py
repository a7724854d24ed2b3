"""What runs of table 1 come to, as rows beside the paper's numbers."""

from collections.abc import Sequence

import numpy as np

from equipoise.model.units import UM, UN_M
from equipoise.study.papers.paper_row import Agreement, PaperRow
from equipoise.study.papers.table1 import Entry, Left, Procedure

WANTED = 0.9  # of the platforms, chosen: on which our best leaves no more than is printed
NEAR = 2.0  # chosen: a median that is within so many times of one printed number agrees with it
DIGITS = 9  # chosen: what a number in SI had before it was divided by its unit
WAYS = {
    "law": "{name}",
    "compensation": "moves by {name}",
    "placing": "weights placed by the estimate",
    "feed_forward": "gyros' torque by {name}",
}


def values_of(entry: Entry, runs: Sequence[Left]) -> list[float]:
    """Return what counts of runs, in the table's unit: offset in um, or else torque in uN m."""
    if entry.reached is not None and entry.reached.kind == "offset":
        return [run.offset / UM for run in runs]
    return [run.torque / UN_M for run in runs]


def printed_of(entry: Entry) -> tuple[float, ...]:
    """Return what is printed, in the table's unit."""
    if entry.reached is None:
        return ()
    unit = UM if entry.reached.kind == "offset" else UN_M
    return (round(entry.reached.value / unit, DIGITS),)


def unit_of(entry: Entry) -> str:
    """Return the table's unit."""
    return "um" if entry.reached is not None and entry.reached.kind == "offset" else "uN m"


def share_reached(entry: Entry, runs: Sequence[Left]) -> float:
    """Return on how many of the platforms no more is left than is printed; 1 if nothing is."""
    printed = printed_of(entry)
    if not printed:
        return 1.0
    return float(np.mean([value <= printed[0] for value in values_of(entry, runs)]))


def named(procedure: Procedure) -> str:
    """Return a procedure in words."""
    return WAYS[procedure.way].format(name=procedure.name)


def row_of(entry: Entry, procedure: Procedure, runs: Sequence[Left]) -> PaperRow:
    """Return the row of one procedure: the median, and what 90 % of platforms stay below."""
    values, printed = values_of(entry, runs), printed_of(entry)
    share = share_reached(entry, runs)
    what = "offset" if unit_of(entry) == "um" else "torque"
    ours = (float(np.median(values)), float(np.quantile(values, WANTED)))
    agreement = Agreement.SHOWN
    if printed:
        near = ours[0] <= NEAR * printed[0]
        agreement = Agreement.AGREES if near else Agreement.DIFFERS
        agreement = Agreement.BETTER if share >= WANTED else agreement
    reach = f"{share:.0%} of {len(runs)} platforms reach it" if printed else ""
    cause = entry.cause if agreement is not Agreement.BETTER and procedure == entry.own else ""
    return PaperRow(
        f"Table 1, {entry.institution}",
        f"{what} left by {named(procedure)}, median and 90 %",
        unit_of(entry),
        printed,
        ours,
        agreement,
        "; ".join(part for part in (reach, cause) if part),
    )


def rows_of(entry: Entry, own: Sequence[Left], best: Sequence[Left]) -> tuple[PaperRow, ...]:
    """Return the rows of an entry: its own method as run here, and ours where it is another."""
    if entry.own == entry.best:
        return (row_of(entry, entry.best, best),)
    return row_of(entry, entry.own, own), row_of(entry, entry.best, best)
