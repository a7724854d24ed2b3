"""``python -m benchmarks [--quick]``: the speed of the fit beside its peers, and of the rest."""

import os

from equipoise.app.engine.worker_processes import ONE_THREAD

# Before anything loads NumPy. Small matrices: threads of the library only get in the way.
os.environ.update(ONE_THREAD | os.environ)

import sys
from importlib.util import find_spec

from rich.console import Console
from rich.table import Table

from benchmarks import batches, commands, doors, fits, limit, others, steps

CUT = 2.0  # s between cuts, chosen: a short record then has a few, a long one thousands
console = Console(width=110)


def show_fits(quick: bool) -> None:
    """Print the fits side by side."""
    rows, missing = fits.table(quick=quick)
    ours = rows[0].seconds
    table = Table(title="One fit: 601 rows, 15 unknowns, covariance included, one process")
    for title in ("method", "ms a fit", "set-up s", "evaluations", "times ours", "sd from ours"):
        table.add_column(title, justify="left" if title == "method" else "right")
    for row in rows:
        times = f"{row.seconds / ours:.1f}"
        fit = (row.name, f"{1e3 * row.seconds:.2f}", f"{row.setup:.2f}", str(row.evaluations))
        table.add_row(*fit, times, f"{row.separation:.4f}")
    console.print(table)
    scipy, mujoco, peer = fits.WANTED_SCIPY, fits.WANTED_MUJOCO, fits.WANTED_PEER
    console.print(f"Wanted, times ours: SciPy {scipy:,.0f}, MuJoCo {mujoco:,.0f}, "
                  f"the best of the others {peer:g}.")  # fmt: skip
    for text in missing:
        console.print(text, markup=False)  # extras stand in brackets, as markup does


def show_steps() -> None:
    """Print what a row costs every recursive estimator."""
    table = Table(title="One row of a recursive estimator, prediction and correction; beside NumPy")
    for title in ("method", "elements", "us a row", "wanted, at most", "NumPy, us", "times ours"):
        table.add_column(title, justify="left" if title == "method" else "right")
    for step in steps.table():
        wanted = "" if step.wanted is None else f"{step.wanted:.0f}"
        cost = (f"{step.ours:.2f}", wanted, f"{step.plain:,.0f}", f"{step.plain / step.ours:,.0f}")
        table.add_row(step.name, str(step.elements), *cost)
    console.print(table)


def show_others() -> None:
    """Print tracker, simulator, lengths and throughput."""
    one, walked = others.tracker_step()
    console.print(f"Tracker: {one:.1f} us a row; each was passed {walked:.1f} times "
                  "(wanted: at most 15 us).")  # fmt: skip
    for length in (25.0, 120.0):
        times = others.simulator(length)
        console.print(f"Simulator, sputnix, reads of {length:.0f} s: {times:,.0f} x real time "
                      "(wanted: at least 20 000).")  # fmt: skip
    table = Table(title="One pass over a record: residuals and normal equations")
    for title in ("rows", "cut every", "ms", "us a row", "peak MB of the process"):
        table.add_column(title, justify="right")
    for separation in (None, CUT):
        for rows in (1_000, 10_000, 100_000, 1_000_000):
            n, seconds, memory = others.length_row(rows, separation)
            cut = "never" if separation is None else f"{separation:g} s"
            cost = (f"{1e3 * seconds:.2f}", f"{1e6 * seconds / n:.3f}", f"{memory:.0f}")
            table.add_row(f"{n:,}", cut, *cost)
    console.print(table)
    for given in (True, False):
        alone, together = others.throughput(given)
        start = "the peers' start" if given else "no start"
        console.print(f"Batch of 200 fits from {start}: {alone:.0f} a second in one thread, "
                      f"{together:.0f} on {os.cpu_count()} cores "
                      f"({1e3 / together:.2f} ms a fit).")  # fmt: skip


def show_batches() -> None:
    """Print fits a second of many records in one call, and where their time goes."""
    batch = batches.table()
    console.print(
        f"{batches.RECORDS} fits from no start, in one call: {batch.together:.0f} a second of one "
        f"core, {batch.together / batch.alone:.1f} times the {batch.alone:.0f} one by one; "
        f"{batch.on_two:.0f} by the clock on two, {batch.of_each:.0f} for each second of a core "
        f"(wanted: at least {batches.WANTED:.0f} on two cores)."
    )
    table = Table(title="Where the time of such a fit goes")
    for title in ("what", "ms"):
        table.add_column(title, justify="left" if title == "what" else "right")
    for what, spent in batch.shares.items():
        table.add_row(what, f"{spent:.3f}")
    console.print(table)


def show_limit() -> None:
    """Print how near the kernels are to what a core can do."""
    peak, shares = limit.table()
    table = Table(title=f"The limit: a core does {1e-6 * peak:,.0f} million operations a s")
    for title in ("what", "operations", "us", "million a s", "of the peak"):
        table.add_column(title, justify="left" if title == "what" else "right")
    for each in shares:
        rate = f"{1e-6 * each.operations / each.seconds:,.0f}"
        cost = (f"{each.operations:,.0f}", f"{1e6 * each.seconds:.3f}", rate)
        table.add_row(each.what, *cost, f"{each.of_peak:.0%}")
    console.print(table)


def show_commands() -> None:
    """Print what whole commands cost."""
    table = Table(title="Commands, from their start to their end")
    for title in ("command", "processor s", "wanted, at most", "peak MiB"):
        table.add_column(title, justify="left" if title == "command" else "right")
    for command, cost in commands.table():
        cells = (f"{cost.processor:.2f}", f"{command.wanted:g}", f"{cost.memory:.0f}")
        table.add_row(command.what, *cells)
    console.print(table)


def show_doors() -> None:
    """Print what a person waits for."""
    table = Table(title="At the doors")
    for title in ("what", "s", "wanted, at most"):
        table.add_column(title, justify="left" if title == "what" else "right")
    for what, seconds, wanted in doors.table():
        table.add_row(what, f"{seconds:.3g}", f"{wanted:g}")
    console.print(table)
    if find_spec("pyarrow") is None:
        console.print("pyarrow is not installed: long tables are read row by row.")
        return
    size, by_rows, by_columns = doors.long_text()
    console.print(
        f"{doors.LONG_ROWS:,} rows of CSV ({size:.0f} MB) to numbers: {by_rows:.2f} s row by row, "
        f"{by_columns:.2f} s by pyarrow, {by_rows / by_columns:.1f} times less."
    )


if __name__ == "__main__":
    show_fits("--quick" in sys.argv)
    show_steps()
    show_others()
    show_batches()
    show_limit()
    show_doors()
    show_commands()
