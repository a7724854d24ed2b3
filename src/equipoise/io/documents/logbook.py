"""A logbook: the index of a folder of runs, in SQLite beside them.

The folders are what counts. The index can be deleted at any time: it is rebuilt from them. Each
time it is opened it takes in what has come, changed or gone since (``logbook_update`` says what it
does not notice). Several processes may have it open; each run is taken in whole or not at all. An
index of an older version becomes one of today.
"""

import json
import sqlite3
from collections.abc import Generator, Mapping, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Any, NamedTuple

from equipoise.io.documents.logbook_numbers import Numbers, arrays, unpacked
from equipoise.io.documents.logbook_schema import migrate
from equipoise.io.documents.logbook_update import Update
from equipoise.model.errors import InputError
from equipoise.model.estimate import Parameter
from equipoise.model.logged_run import Build, LoggedRun, ending_of

INDEX = "logbook.sqlite"
PATIENCE = 30.0  # s, chosen: for another process to end what it writes
MEMORY = 64 * 1024  # KiB of the index that are kept in memory, chosen
REMADE = "a logbook's index; delete it, and it is rebuilt from the folders of the runs"
NAME = "CASE folder WHEN '' THEN runs.name ELSE folder || '/' || runs.name END"
COLUMNS = ("name", "kind", "made_at", "platform", "configuration", "method", "bench", "outcome",
           "sentence", "temperature", "provenance")  # fmt: skip
# The index by time has all that runs are filtered by: what does not match is never fetched.
RUNS = ("runs INDEXED BY runs_by_time CROSS JOIN builds ON builds.id = runs.build "
        "CROSS JOIN shards ON shards.id = runs.shard")  # fmt: skip
ORDER = "ORDER BY utc DESC, runs.name DESC, runs.id DESC LIMIT ?"


class Choice(NamedTuple):
    """Which runs: a condition on the columns of ``runs``, with a ``?`` for each value."""

    where: str = ""
    values: Sequence[Any] = ()
    last: int | None = None  # of these the last so many; None: all


ALL = Choice()


class RunTable(NamedTuple):
    """Runs by column, the first one first."""

    columns: Mapping[str, Sequence[Any]]
    cells: Mapping[str, Sequence[tuple[str | None, bytes | None]]]  # form and numbers, by part

    def numbers(self, part: str, names: Sequence[str]) -> Numbers:
        """Return the numbers of these names in a part."""
        return arrays(self.cells[part], names)


@contextmanager
def open_logbook(folder: Path) -> Generator["Logbook"]:
    """Lend the logbook of a folder of runs, as it is now.

    Raises InputError if there is no such folder, or if its index cannot be read.
    """
    if not folder.is_dir():
        raise InputError(str(folder), "no such folder", "a folder of runs")
    path = folder / INDEX
    try:
        index = sqlite3.connect(path, timeout=PATIENCE, isolation_level=None)
        try:
            # No file comes or goes, which would make the folder one that has changed.
            index.execute("PRAGMA journal_mode = TRUNCATE")
            index.execute("PRAGMA foreign_keys = ON")
            index.execute(f"PRAGMA cache_size = -{MEMORY}")
            migrate(index, str(path))
            update = Update(index, folder)
            update.carry_out()
            yield Logbook(index, update.unread)
        finally:
            index.close()
    except (sqlite3.Error, UnicodeDecodeError) as error:  # what SQLite says need not be text
        raise InputError(str(path), str(error), REMADE) from error


class Logbook:
    """See above; ``unread`` has a sentence for each folder whose ``run.json`` is not one."""

    def __init__(self, index: sqlite3.Connection, unread: list[str]) -> None:
        self._index, self.unread = index, unread

    def runs(self, choice: Choice = ALL) -> list[LoggedRun]:
        """Return runs, the first one first, without their numbers."""
        columns = ", ".join((NAME, *COLUMNS[1:]))
        return [_run(row) for row in self._chosen(columns, RUNS, choice)]

    def count(self, choice: Choice = ALL) -> int:
        """Return how many runs there are; ``last`` plays no part."""
        query = f"SELECT count(*) FROM runs WHERE {choice.where or 'TRUE'}"
        return self._index.execute(query, tuple(choice.values)).fetchone()[0]

    def builds(self, choice: Choice = ALL) -> list[Build]:
        """Return each testbed file that platforms have had, as they came; ``last``: no part."""
        query = ("SELECT platform, configuration, first, last, runs FROM builds JOIN ("
                 "SELECT build, min(utc) AS first, max(utc) AS last, count(*) AS runs "
                 f"FROM runs INDEXED BY runs_by_build WHERE {choice.where or 'TRUE'} "
                 "GROUP BY build) ON build = builds.id ORDER BY first")  # fmt: skip
        return [Build(*row) for row in self._index.execute(query, tuple(choice.values))]

    def numbers(self, name: str, part: str) -> tuple[Parameter, ...]:
        """Return a run's numbers: of ``part`` 'home' the estimate, of 'standing' the verdict."""
        folder, _, own = name.rpartition("/")
        query = ("SELECT text, data FROM numbers JOIN forms ON forms.id = form WHERE part = ? "
                 "AND run = (SELECT runs.id FROM runs JOIN shards ON shards.id = shard "
                 "WHERE folder = ? AND name = ?)")  # fmt: skip
        row = self._index.execute(query, (part, folder, own)).fetchone()
        return () if row is None else unpacked(*row)

    def table(self, names: Sequence[str], parts: Sequence[str], choice: Choice = ALL) -> RunTable:
        """Return columns of ``COLUMNS``, and numbers of parts; no record is made of each run."""
        columns = [NAME if name == "name" else name for name in names]
        tables = [RUNS]
        for part in parts:
            columns += f"{part}.form", f"{part}.data"
            tables.append(f"LEFT JOIN numbers AS {part} ON {part}.run = runs.id "
                          f"AND {part}.part = '{part}'")  # fmt: skip
        rows = self._chosen(", ".join(columns), " ".join(tables), choice)
        forms = dict(self._index.execute("SELECT id, text FROM forms"))
        values = list(zip(*rows, strict=True)) or [()] * len(columns)
        n = len(names)
        pairs = zip(values[n::2], values[n + 1 :: 2], strict=True)
        cells = {part: [(forms.get(form), cell) for form, cell in zip(*pair, strict=True)]
                 for part, pair in zip(parts, pairs, strict=True)}  # fmt: skip
        return RunTable(dict(zip(names, values, strict=False)), cells)

    def configuration(self, hash_: str) -> str:
        """Return the text of a testbed; empty if no run's folder has it."""
        query = "SELECT text FROM configurations WHERE hash = ?"
        row = self._index.execute(query, (hash_,)).fetchone()
        return "" if row is None else row[0]

    def _chosen(self, columns: str, tables: str, choice: Choice) -> list[tuple[Any, ...]]:
        query = f"SELECT {columns} FROM {tables} WHERE {choice.where or 'TRUE'} {ORDER}"
        most = -1 if choice.last is None else choice.last
        return self._index.execute(query, (*choice.values, most)).fetchall()[::-1]


def _run(row: tuple[Any, ...]) -> LoggedRun:
    *values, provenance = row
    named = dict(zip(COLUMNS, values, strict=False))
    named["outcome"] = ending_of(named["outcome"])
    return LoggedRun(**named, provenance=json.loads(provenance))
