"""A laboratory's logbook after ten years: what it takes to open, list and draw a million runs.

Processor seconds of this process, start of Python and loading of libraries left out.
"""

import contextlib
import io
import resource
import tempfile
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path

from equipoise.app.cli import run
from equipoise.io.documents.logbook import INDEX, open_logbook
from verification.many_runs import put, write_runs
from verification.result import Result, Row, Spread, at_most, between, in_turn

STATED = 10**6  # runs
LISTED = 1.0  # s, of the issue: 10^6 runs are listed and filtered
WHOLE = 120.0  # s, chosen: a table or a figure of all runs; its texts are made safe one by one
FIRST = 1e-3  # s a run, chosen
FILTERS = (
    (), ("--platform", "nanosat"), ("--platform", "nobody"), ("--kind", "balance"),
    ("--outcome", "failed"), ("--outcome", "halted"), ("--method", "batch"), ("--method", "none"),
    ("--since", "2025-06-01"), ("--until", "2016-03-01"),
    ("--platform", "kau", "--kind", "balance", "--outcome", "failed", "--until", "2020-01-01"),
    ("--json",), ("--builds",), ("--builds", "--since", "2025-06-01"),
)  # fmt: skip


def processor_seconds(call: Callable[[], object]) -> float:
    """Return what a call takes of the processor."""
    before = resource.getrusage(resource.RUSAGE_SELF)
    call()
    after = resource.getrusage(resource.RUSAGE_SELF)
    return after.ru_utime - before.ru_utime + after.ru_stime - before.ru_stime


def counted(runs: Path) -> int:
    """Return how many runs a logbook has, opened now."""
    with open_logbook(runs) as book:
        return book.count()


def command(runs: Path, *words: str) -> None:
    """Carry out `equipoise logbook`; nothing of it is shown."""
    said = io.StringIO()
    with contextlib.redirect_stdout(said), contextlib.redirect_stderr(said):
        code = run(["logbook", str(runs), *words])
    assert code == 0, said.getvalue()


def opened(runs: Path, count: int) -> Iterator[Row]:
    """Yield what opening takes: at first, with nothing new, with one new run."""
    first = processor_seconds(lambda: counted(runs))
    yield at_most("taken in at first, s a run", first / count, FIRST, ".2g")
    counted(runs)  # the folder of all runs got its index a moment ago: it is listed once more
    still = processor_seconds(lambda: counted(runs))
    yield at_most("opened, nothing new, s", still, LISTED)
    finer = 7 * count  # in between the others
    for month, k in (("last", finer - 1), ("first", 1)):
        put(runs, k, finer)
        taken = processor_seconds(lambda: counted(runs))
        yield at_most(f"opened, one new run in the {month} month, s", taken, LISTED)
    found = counted(runs) - count
    yield between("new runs that it has", found, (2, 2), "d")


def listed(runs: Path) -> Iterator[Row]:
    """Yield what the command takes for the last 20 runs by each filter, and for all builds."""
    command(runs)  # libraries
    for words in FILTERS:
        taken = processor_seconds(lambda words=words: command(runs, *words))
        yield at_most(f"`logbook {' '.join(words)}`, s".replace(" `", "`"), taken, LISTED)


def drawn(runs: Path, place: Path) -> Iterator[Row]:
    """Yield what the command takes for all runs: trends of a platform, tables."""
    for words in (
        ("--platform", "nanosat", "--trend", "trend.png"),
        ("--export", "runs.parquet"),
        ("--export", "runs.csv"),
    ):
        out = (*words[:-1], str(place / words[-1]), "--last", "0")
        taken = processor_seconds(lambda out=out: command(runs, *out))
        yield at_most(f"`logbook --last 0 {' '.join(words)}`, s", taken, WHOLE)


def measure(seeds: Sequence[int], spread: Spread = in_turn) -> Result:
    """Make as many runs as there are seeds, and go through what people do with them."""
    del spread  # processor seconds are of this process
    count = len(seeds)
    with tempfile.TemporaryDirectory() as place:
        runs = Path(place) / "runs"
        write_runs(runs, seeds, count)
        rows = (*opened(runs, count), *listed(runs), *drawn(runs, Path(place)))
        size = (runs / INDEX).stat().st_size / count
    claim = (
        f"{count} runs of ten years, each in a real folder of its month, are listed and filtered "
        f"in {LISTED:g} s; what is new is taken in when the logbook is opened, and nothing else is "
        "read. Processor seconds, start of Python and loading of libraries left out."
    )
    return Result("logbook_scale", claim, rows, (f"The index has {size:.0f} bytes a run.",))
