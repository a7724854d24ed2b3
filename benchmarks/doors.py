"""What a person waits for at the doors: a long file, a long list; and where masses go."""

import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Iterator
from pathlib import Path

import numpy as np

from equipoise.actuators.mass_allocation import allocate, rails_of
from equipoise.io.columns.column_map import Layout
from equipoise.io.columns.native_columns import native_columns
from equipoise.io.columns.table import Table
from equipoise.io.documents.logbook import open_logbook
from equipoise.io.documents.run_file import text_of_run
from equipoise.io.formats.csv_table import csv_text, cut, table_of
from equipoise.io.recording.recording_file import read_recording, write_recording
from equipoise.io.testbed.presets import read_preset
from equipoise.maths.attitude import exponential
from equipoise.model.logged_run import RUN
from equipoise.model.recording import Recording, Samples
from tests.io.documents.killed_writer import run

ROWS, LONG_ROWS, RUNS, ANSWERS = 180_000, 500_000, 10_000, 20


def table() -> Iterator[tuple[str, float, float]]:
    """Return what was done, the seconds that it took at best, and those wanted at most."""
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "recorded.csv"
        write_recording(recorded(ROWS), file)
        yield f"reading {ROWS:,} rows of CSV", quickest(lambda: read_recording(file), 3), 15.0
        runs = Path(folder) / "runs"
        write_runs(runs)
        yield f"listing {RUNS:,} runs", quickest(lambda: listed(runs), 5), 0.5
    yield "where masses go, one answer", allocation(), 1e-4
    words = [sys.executable, "-m", "equipoise.app.cli", "balance", "--help"]
    helped = quickest(lambda: subprocess.run(words, capture_output=True, check=True), 3)
    yield "help of a command", helped, 0.5


def quickest(call: Callable[[], object], repeats: int) -> float:
    """Return the fewest seconds of several calls, after one that prepares or compiles."""
    call()
    taken: list[float] = []
    for _ in range(repeats):
        began = time.perf_counter()
        call()
        taken.append(time.perf_counter() - began)
    return min(taken)


def recorded(rows: int) -> Recording:
    """Return attitude and rate at 100 Hz."""
    rng, t = np.random.default_rng(1), np.arange(rows) * 0.01
    q = exponential(np.cumsum(rng.normal(scale=1e-3, size=(rows, 3)), axis=0))
    return Recording(attitude=Samples(t, q), rate=Samples(t, rng.normal(size=(rows, 3))))


def long_text() -> tuple[float, float, float]:
    """Return the MB of a long table, and the seconds to numbers: row by row, and by pyarrow."""
    text = csv_text(native_columns(recorded(LONG_ROWS)))
    by_rows = quickest(lambda: numbers(row_by_row(text)), 3)
    by_columns = quickest(lambda: numbers(cut(text, "long.csv", Layout())), 3)
    return 1e-6 * len(text), by_rows, by_columns


def row_by_row(text: str) -> Table:
    """Return the table in a text whose cells are cut and read one by one."""
    rows = [line.split(",") for line in text.splitlines()]
    return table_of(rows, [*range(1, len(rows) + 1)], "long.csv", Layout())


def numbers(table: Table) -> int:
    """Return how many cells of a table hold a number."""
    return sum(int(np.isfinite(table.numbers(name).values).sum()) for name in table.names)


def write_runs(folder: Path) -> None:
    """Write the entries of many runs."""
    text = text_of_run(run())
    for k in range(RUNS):
        (folder / f"run{k:05d}").mkdir(parents=True)
        (folder / f"run{k:05d}" / RUN).write_text(text)


def listed(folder: Path) -> int:
    """Return how many runs there are; what changed is looked for."""
    with open_logbook(folder) as book:
        return len(book.runs())


def allocation() -> float:
    """Return the seconds of one answer, each from where the last one left the masses."""
    bed, rng = read_preset("reference-table"), np.random.default_rng(1)
    rails, none = rails_of(bed.masses, bed.body.mass), np.zeros(len(bed.masses))
    wishes = 1e-4 * rng.uniform(-1, 1, (ANSWERS, 3))

    def all_of_them() -> None:
        d = none
        for wish in wishes:
            d = allocate(rails, d, wish)

    return quickest(all_of_them, 20) / ANSWERS
