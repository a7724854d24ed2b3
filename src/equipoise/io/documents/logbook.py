"""A logbook: the index of a folder of runs, in SQLite beside them.

The folders are what counts. The index can be deleted at any time: it is made anew from them. Each
time it is opened it takes in what has come, changed or gone since. Several processes may have it
open (write-ahead log); each run is taken in whole or not at all. An index of an older version
becomes one of today.
"""

import json
import os
import sqlite3
from collections.abc import Generator, Iterator, Sequence
from contextlib import contextmanager
from datetime import datetime
from pathlib import Path
from typing import Any

from equipoise.io.documents.run_folder import read_configuration
from equipoise.model.errors import InputError
from equipoise.model.estimate import Parameter
from equipoise.model.logged_run import RUN, Build, LoggedRun, ending_of

INDEX = "logbook.sqlite"
PATIENCE = 30.0  # s, chosen: for another process to end what it writes
REMADE = "a logbook's index; delete it, and it is made anew from the folders of the runs"
LATEST = 32_503_680_000.0  # s since 1970, chosen: the year 3000, which every clock can show
A_TIME = "a time from 1970 to 2999, such as 2026-03-01T09:00:00+01:00"
COLUMNS = ("name", "kind", "made_at", "platform", "configuration", "method", "bench", "outcome",
           "sentence", "temperature", "provenance")  # fmt: skip


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
            index.execute("PRAGMA journal_mode = WAL")
            index.execute("PRAGMA foreign_keys = ON")
            migrate(index, str(path))
            logbook = Logbook(index, folder)
            logbook.take_in()
            yield logbook
        finally:
            index.close()
    except (sqlite3.Error, UnicodeDecodeError) as error:  # what SQLite says need not be text
        raise InputError(str(path), str(error), REMADE) from error


class Logbook:
    """See above; ``unread`` has a sentence for each folder whose ``run.json`` is not one."""

    def __init__(self, index: sqlite3.Connection, folder: Path) -> None:
        self._index, self.folder = index, folder
        self.unread: list[str] = []

    def take_in(self) -> None:
        """Take in the runs that came or changed since, and drop those that are gone."""
        known = dict(self._index.execute("SELECT name, stamp FROM runs"))
        there = dict(_stamps(self.folder))
        changed = [name for name, stamp in there.items() if known.get(name) != stamp]
        gone = known.keys() - there.keys()
        if not changed and not gone:
            return
        with self._whole():
            self._index.executemany("DELETE FROM runs WHERE name = ?", [(n,) for n in gone])
            for name in changed:
                self._enter(name, there[name])

    def runs(
        self, where: str = "", values: Sequence[Any] = (), last: int | None = None
    ) -> list[LoggedRun]:
        """Return runs, the first one first, without their numbers; or the last so many of them.

        ``where`` is a condition on the columns of ``runs``, with a ``?`` for each value.
        """
        query = (f"SELECT {', '.join(COLUMNS)} FROM runs WHERE {where or 'TRUE'} "
                 "ORDER BY utc DESC, name DESC LIMIT ?")  # fmt: skip
        most = -1 if last is None else last
        return [_run(row) for row in self._index.execute(query, (*values, most))][::-1]

    def count(self, where: str = "", values: Sequence[Any] = ()) -> int:
        """Return how many runs there are."""
        query = f"SELECT count(*) FROM runs WHERE {where or 'TRUE'}"
        return self._index.execute(query, tuple(values)).fetchone()[0]

    def builds(self, where: str = "", values: Sequence[Any] = ()) -> list[Build]:
        """Return each testbed file that platforms have had, as they came; of all runs, or some."""
        query = ("SELECT platform, configuration, min(utc), max(utc), count(*) FROM runs "
                 f"WHERE {where or 'TRUE'} GROUP BY platform, configuration "
                 "ORDER BY min(utc)")  # fmt: skip
        return [Build(*row) for row in self._index.execute(query, tuple(values))]

    def numbers(self, name: str, part: str) -> tuple[Parameter, ...]:
        """Return a run's numbers: of ``part`` 'home' the estimate, of 'standing' the verdict."""
        query = ("SELECT name, unit, value, sd, observable FROM estimates "
                 "WHERE run = ? AND part = ? ORDER BY place")  # fmt: skip
        return tuple(
            Parameter(n, unit, _number(value), _number(sd), bool(observed))
            for n, unit, value, sd, observed in self._index.execute(query, (name, part))
        )

    def configuration(self, hash_: str) -> str:
        """Return the text of a testbed; empty if no run's folder has it."""
        query = "SELECT text FROM configurations WHERE hash = ?"
        row = self._index.execute(query, (hash_,)).fetchone()
        return "" if row is None else row[0]

    def _enter(self, name: str, stamp: int) -> None:
        # Where nothing is new, nothing needs to be read: listing does without what reading needs.
        from equipoise.io.documents.run_file import read_run

        # A run may come from anywhere: whatever is wrong with it costs the list that run alone.
        self._index.execute("SAVEPOINT one")
        try:
            run = read_run(self.folder / name)
            self._insert(name, stamp, _utc(run.made_at, str(self.folder / name)), run)
        except InputError as error:
            self._leave_out(str(error))
        except (ValueError, ArithmeticError, sqlite3.DataError) as error:
            self._leave_out(f"{self.folder / name}: {error}")
        self._index.execute("RELEASE one")

    def _leave_out(self, sentence: str) -> None:
        self._index.execute("ROLLBACK TO one")
        self.unread.append(sentence)

    def _insert(self, name: str, stamp: int, utc: float, run: LoggedRun) -> None:
        values = (*(getattr(run, c) for c in COLUMNS[:-1]), json.dumps(dict(run.provenance)))
        marks = ", ".join("?" * (len(COLUMNS) + 2))
        names = ", ".join((*COLUMNS, "stamp", "utc"))
        self._index.execute("DELETE FROM runs WHERE name = ?", (name,))
        self._index.execute(f"INSERT INTO runs ({names}) VALUES ({marks})", (*values, stamp, utc))
        rows = [(name, *row) for row in _rows(run)]
        self._index.executemany("INSERT INTO estimates VALUES (?, ?, ?, ?, ?, ?, ?, ?)", rows)
        text = read_configuration(self.folder / name)
        if text:
            known = (run.configuration, run.platform, text)
            self._index.execute("INSERT OR IGNORE INTO configurations VALUES (?, ?, ?)", known)

    @contextmanager
    def _whole(self) -> Generator[None]:
        """Carry out all of a block, or nothing of it."""
        self._index.execute("BEGIN IMMEDIATE")
        try:
            yield
        except BaseException:
            self._index.execute("ROLLBACK")
            raise
        self._index.execute("COMMIT")


def _utc(made_at: str, where: str) -> float:
    """Return a time as s since 1970; InputError for one at which no run was made."""
    try:
        utc = datetime.fromisoformat(made_at).astimezone().timestamp()
    except (ValueError, ArithmeticError, OSError) as error:
        raise InputError(f"{where}: made_at", str(error), A_TIME) from error
    if not 0 <= utc < LATEST:
        raise InputError(f"{where}: made_at", f"'{made_at}'", A_TIME)
    return utc


def _stamps(folder: Path) -> Iterator[tuple[str, int]]:
    """Yield the name of each run's folder, and when its ``run.json`` was last written, ns."""
    top = str(folder)
    for name in os.listdir(folder):  # noqa: PTH208  (pathlib takes three times as long)
        if not name.startswith("."):
            try:
                yield name, os.stat(f"{top}/{name}/{RUN}").st_mtime_ns  # noqa: PTH116
            except OSError:
                continue  # some other file or folder, or a run that is not whole yet


def _rows(run: LoggedRun) -> Iterator[tuple[str, int, str, str, float, float, bool]]:
    """Yield part, place and number of all that is known by number."""
    for part, numbers in (("home", run.parameters), ("standing", run.standing)):
        for place, p in enumerate(numbers):
            yield part, place, p.name, p.unit, p.value, p.sd, p.observable


def _run(row: tuple[Any, ...]) -> LoggedRun:
    *values, provenance = row
    named = dict(zip(COLUMNS, values, strict=False))
    named["outcome"] = ending_of(named["outcome"])
    return LoggedRun(**named, provenance=json.loads(provenance))


def _number(stored: float | None) -> float:
    """Return what SQLite has kept; it knows no NaN."""
    return float("nan") if stored is None else stored


# One script for each version; what was published once is never changed, only followed.
MIGRATIONS = (
    """
    CREATE TABLE configurations (
        hash TEXT PRIMARY KEY, platform TEXT NOT NULL, text TEXT NOT NULL
    );
    CREATE TABLE runs (
        name TEXT PRIMARY KEY, stamp INTEGER NOT NULL, utc REAL NOT NULL, kind TEXT NOT NULL,
        made_at TEXT NOT NULL, platform TEXT NOT NULL, configuration TEXT NOT NULL,
        method TEXT NOT NULL, bench TEXT NOT NULL, outcome TEXT NOT NULL, sentence TEXT NOT NULL,
        provenance TEXT NOT NULL
    );
    CREATE TABLE estimates (
        run TEXT NOT NULL REFERENCES runs (name) ON DELETE CASCADE, part TEXT NOT NULL,
        place INTEGER NOT NULL, name TEXT NOT NULL, unit TEXT NOT NULL, value REAL, sd REAL,
        observable INTEGER NOT NULL, PRIMARY KEY (run, part, place)
    );
    """,
    """
    ALTER TABLE runs ADD COLUMN temperature REAL;
    CREATE INDEX runs_by_time ON runs (utc);
    CREATE INDEX runs_by_platform ON runs (platform, utc);
    """,
)


def migrate(index: sqlite3.Connection, source: str) -> None:
    """Bring an index to today's version, in one transaction.

    Raises InputError for one that is newer than this program.
    """
    index.execute("BEGIN IMMEDIATE")  # of two programs one waits, and finds the work done
    try:
        (version,) = index.execute("PRAGMA user_version").fetchone()
        if version > len(MIGRATIONS):
            wanted = f"an index of version {len(MIGRATIONS)} or older: update equipoise"
            raise InputError(source, f"version {version}", wanted)
        for script in MIGRATIONS[version:]:
            for statement in filter(str.strip, script.split(";")):
                index.execute(statement)
        index.execute(f"PRAGMA user_version = {len(MIGRATIONS)}")
        index.execute("COMMIT")
    except BaseException:
        index.execute("ROLLBACK")
        raise
