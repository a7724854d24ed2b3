"""What it takes to read and to convert tables of millions of rows: memory, and nothing lost."""

import filecmp
import tempfile
from collections.abc import Sequence
from pathlib import Path
from typing import NamedTuple

from tests.support.long_tables import CONVERT, READ, in_its_own_process, long_table
from verification.result import Result, Row, Spread, at_most, in_turn

READ_ROWS, ROWS = 10**6, 10**7
MEGABYTES = 300.0
GROWING = (".csv", ".parquet", ".mcap")


class Task(NamedTuple):
    """A table to read, or to convert."""

    rows: int
    suffix: str  # of the file to write; empty: it is read


class Found(NamedTuple):
    """What came of it."""

    task: Task
    megabytes: float  # the most that the process ever held
    differ: bool  # a table that is written as it was read


def taken(task: Task) -> Found:
    """Read or convert one table in a process of its own."""
    with tempfile.TemporaryDirectory() as place:
        table = long_table(Path(place) / "table.csv", task.rows)
        out = Path(place) / f"out{task.suffix}"
        words = [CONVERT, table, out] if task.suffix else [READ, table]
        held = int(in_its_own_process(*words)[-1]) * 1024 / 1e6
        differ = task.suffix == ".csv" and not filecmp.cmp(table, out, shallow=False)
        return Found(task, held, differ)


def rows_of(found: Found) -> tuple[Row, ...]:
    """Return the rows of one table."""
    task = found.task
    done = f"converted to {task.suffix}" if task.suffix else "read"
    held = at_most(f"{task.rows} rows {done}: memory, MB", found.megabytes, MEGABYTES)
    if task.suffix != ".csv":
        return (held,)
    return (held, at_most(f"{task.rows} rows {done}: files that differ", found.differ, 0, "d"))


def measure(seeds: Sequence[int], spread: Spread = in_turn) -> Result:
    """Read a table, and convert one ten times as long to each format that grows by pieces."""
    del seeds  # nothing is drawn
    tasks = [Task(READ_ROWS, ""), *(Task(ROWS, suffix) for suffix in GROWING)]
    found = spread(taken, tasks)
    claim = (
        f"A text table of {READ_ROWS:.0e} rows of clock, attitude and gyro is read, and one of "
        f"{ROWS:.0e} rows is converted, in {MEGABYTES:g} MB, all of Python included; a table of "
        "ours that is converted to CSV comes out byte by byte as it was."
    )
    return Result("long_tables", claim, tuple(row for each in found for row in rows_of(each)))
