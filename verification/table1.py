"""The thirteen testbeds of the review's table 1, balanced by their methods and by ours."""

from collections.abc import Sequence

from equipoise.io.testbed.presets import read_preset
from equipoise.study.papers.paper_row import PaperRow
from equipoise.study.papers.table1 import TABLE1, Entry, Left
from equipoise.study.papers.table1_rows import WANTED, rows_of, share_reached
from equipoise.study.papers.table1_run import table1_runs
from verification.chance import fewest
from verification.result import Result, Row, Spread, at_least, in_turn

STATED = 100  # platforms of each testbed


def shown(row: PaperRow) -> Row:
    """Return a row beside what is printed."""
    found = f"{row.ours[0]:.3g}, {row.ours[1]:.3g} {row.unit}"
    printed = f"printed {row.printed[0]:.3g}" if row.printed else "none printed"
    return Row(f"{row.place}: {row.quantity}", found, printed, True)


def entry_rows(entry: Entry, own: Sequence[Left], best: Sequence[Left]) -> list[Row]:
    """Return what is left beside what is printed, and whether ours reaches that."""
    rows = [shown(row) for row in rows_of(entry, own, best)]
    if entry.reached is None:
        return rows
    share, n = share_reached(entry, best), len(best)
    least = WANTED if n >= STATED else fewest(WANTED, n)
    wanted = f"{entry.preset}: ours leaves no more than is printed"
    return [*rows, at_least(wanted, share, least, ".0%")]


def measure(
    seeds: Sequence[int], spread: Spread = in_turn, entries: Sequence[Entry] = TABLE1
) -> Result:
    """Balance every testbed's platforms of some seeds."""
    numbers = [1 + seed for seed in seeds]
    beds = {entry.preset: read_preset(entry.preset) for entry in entries}
    runs = table1_runs(beds, entries, numbers, lambda *work: iter(spread(*work)))
    rows, n = [row for run in runs for row in entry_rows(*run)], len(seeds)
    claim = (
        f"The thirteen testbeds of table 1 of da Silva et al. (2021), {n} platforms each, target "
        "(0, 0, 0): what the method that the table names leaves as it is run here, and what ours "
        "does; medians, and what 90 % stay below. Torque is rms over directions within 20 deg of "
        "level (Sydney: at level). What the review does not print of a testbed is assumed, such "
        "that the printed result is within reach."
    )
    return Result("table1", claim, tuple(rows))
