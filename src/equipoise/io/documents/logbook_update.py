"""Taking in: what came, changed or went among folders of runs since an index was last opened.

A folder whose time of change is the one that it had when it was last listed has had no run come
or go: it is not listed again. Of its runs the latest by their files are still checked, and all
that was no run then. Not noticed is a ``run.json`` that is older than these and was rewritten in
place by something else than this program, which sets the time of the folder around it; `touch`
does the same. So it is on drives that do not keep times of folders.

A folder that changed a moment ago counts as changed until that moment is past, as the next change
may bear the same time. Runs are taken in so many at a time; one that is stopped has lost those of
one batch, and the next one goes on there.
"""

import json
import os
import sqlite3
import time
from collections.abc import Iterator, Mapping, Sequence
from datetime import datetime
from pathlib import Path
from typing import Any, NamedTuple

from equipoise.io.documents.logbook_numbers import form_of, packed
from equipoise.io.documents.logbook_schema import whole
from equipoise.io.documents.run_folder import read_configuration
from equipoise.io.documents.run_shards import MONTH, stamp_of, stamps_within
from equipoise.model.errors import InputError
from equipoise.model.logged_run import RUN, LoggedRun

RECENT = 1000  # runs that are checked at each opening; chosen: some milliseconds
SETTLED = 60 * 10**9  # ns, chosen: times on disks are 2 s coarse at most, clocks differ by more
BATCH = 1000  # runs, chosen: a second or less, for which other programs wait
LATEST = 32_503_680_000.0  # s since 1970, chosen: the year 3000, which every clock can show
A_TIME = "a time from 1970 to 2999, such as 2026-03-01T09:00:00+01:00"
OWN = ("kind", "outcome", "method", "bench", "made_at", "temperature", "sentence")
PARTS = {"home": "parameters", "standing": "standing"}

Stamps = Mapping[str, int]


class Shard(NamedTuple):
    """A folder of runs, as the index knows it."""

    id: int
    folder: str  # within the folder of all runs; empty: that one itself
    stamp: int | None  # when it was changed, ns; None: it may have changed since it was listed


class Read(NamedTuple):
    """A run as it was read."""

    name: str
    stamp: int
    run: LoggedRun
    utc: float
    testbed: str  # its text, if the index does not have it


class Update:
    """One taking in; ``unread`` has a sentence for each run that cannot be listed."""

    def __init__(self, index: sqlite3.Connection, folder: Path) -> None:
        self._index, self._folder = index, folder
        self.unread: list[str] = []
        self._texts: set[str] = set()  # hashes of testbeds that the index has for sure

    def carry_out(self) -> None:
        """Bring the index up to what the folders say."""
        recent: dict[int, dict[str, int]] = {}
        query = "SELECT shard, name, stamp FROM runs ORDER BY stamp DESC LIMIT ?"
        for shard, name, stamp in self._index.execute(query, (RECENT,)):
            recent.setdefault(shard, {})[name] = stamp
        for where in ("folder = ''", "folder <> ''"):  # the first one says which others there are
            query = f"SELECT id, folder, stamp FROM shards WHERE {where} ORDER BY folder"
            for row in self._index.execute(query).fetchall():
                self._update(Shard(*row), recent.get(row[0], {}))

    def _update(self, shard: Shard, recent: Stamps) -> None:
        place, now = self._folder / shard.folder, time.time_ns()
        stamp = stamp_of(str(place))
        waiting = self._waiting(shard)
        try:
            if stamp is not None and stamp == shard.stamp:
                known = recent
                found = {n: stamp_of(f"{place}/{n}/{RUN}") for n in (*waiting, *recent)}
            else:
                known = self._known(shard)  # before the folder is listed: others write here too
                found = stamps_within(place)
        except (FileNotFoundError, NotADirectoryError):
            self._drop(shard)
            return
        except OSError as error:  # what is known of its runs still stands
            self.unread.append(f"{place}: {error.strerror}")
            return
        fresh = [(n, s) for n, s in found.items() if s is not None and known.get(n) != s]
        waits = {n for n, s in found.items() if s is None} | self._enter(shard, fresh)
        gone = [(shard.id, n, s) for n, s in known.items() if found.get(n) is None]
        is_settled = stamp is not None and now - stamp >= SETTLED
        settled = shard._replace(stamp=stamp if is_settled else None)
        if gone or waits != waiting or settled != shard:
            self._settle(settled, waits, gone)

    def _waiting(self, shard: Shard) -> set[str]:
        """Return the folders that were no runs, or could not be read."""
        query = "SELECT name FROM waiting WHERE shard = ?"
        return {os.fsdecode(name) for (name,) in self._index.execute(query, (shard.id,))}

    def _known(self, shard: Shard) -> dict[str, int]:
        query = "SELECT name, stamp FROM runs WHERE shard = ?"
        return dict(self._index.execute(query, (shard.id,)))

    def _drop(self, shard: Shard) -> None:
        """Forget the runs of a folder that is gone."""
        with whole(self._index):
            self._index.execute("DELETE FROM runs WHERE shard = ?", (shard.id,))
            self._index.execute("DELETE FROM shards WHERE id = ? AND id > 0", (shard.id,))

    def _settle(
        self, shard: Shard, waiting: set[str], gone: Sequence[tuple[int, str, int]]
    ) -> None:
        """Keep that a folder was listed, and what it has."""
        run = self._index.executemany
        with whole(self._index):
            run("DELETE FROM runs WHERE shard = ? AND name = ? AND stamp = ?", gone)
            self._index.execute("DELETE FROM waiting WHERE shard = ?", (shard.id,))
            kept = [(shard.id, os.fsencode(name)) for name in sorted(waiting)]
            run("INSERT INTO waiting VALUES (?, ?)", kept)
            update = "UPDATE shards SET stamp = ? WHERE id = ?"
            self._index.execute(update, (shard.stamp, shard.id))
            if not shard.folder:
                months = [(name,) for name in sorted(waiting) if MONTH.fullmatch(name)]
                run("INSERT OR IGNORE INTO shards (folder) VALUES (?)", months)

    def _enter(self, shard: Shard, fresh: Sequence[tuple[str, int]]) -> set[str]:
        """Take in runs, and return those that cannot be."""
        left_out: set[str] = set()
        for k in range(0, len(fresh), BATCH):
            batch = fresh[k : k + BATCH]
            read = list(self._read(shard, batch))  # nobody waits for this
            with whole(self._index):
                entered = {each.name for each in read if self._entered(shard, each)}
                failed = [(shard.id, name) for name, _ in batch if name not in entered]
                self._forget(failed)
            left_out |= {name for _, name in failed}
        return left_out

    def _forget(self, failed: Sequence[tuple[int, str]]) -> None:
        """Drop what was listed of runs that can no longer be read."""
        kept = [(shard, name) for shard, name in failed if _is_text(name)]
        self._index.executemany("DELETE FROM runs WHERE shard = ? AND name = ?", kept)

    def _read(self, shard: Shard, batch: Sequence[tuple[str, int]]) -> Iterator[Read]:
        # Where nothing is new, nothing needs to be read: listing does without what reading needs.
        from equipoise.io.documents.run_file import read_run

        for name, stamp in batch:
            folder = self._folder / shard.folder / name
            try:
                run = read_run(folder)
                yield Read(name, stamp, run, _utc(run.made_at, folder), self._testbed(run, folder))
            except InputError as error:
                self.unread.append(str(error))

    def _testbed(self, run: LoggedRun, folder: Path) -> str:
        """Return the text of a testbed that the index has not yet; else nothing."""
        query = "SELECT 1 FROM configurations WHERE hash = ?"
        if run.configuration in self._texts or _first(self._index, query, run.configuration):
            return ""
        text = read_configuration(folder)
        if text:
            self._texts.add(run.configuration)
        return text

    def _entered(self, shard: Shard, read: Read) -> bool:
        """Enter a run; False, and a sentence, for what an index cannot hold."""
        # A run may come from anywhere: whatever is wrong with it costs the list that run alone.
        self._index.execute("SAVEPOINT one")
        try:
            self._insert(shard, read)
        except (ValueError, ArithmeticError, sqlite3.DataError) as error:
            self._index.execute("ROLLBACK TO one")
            self.unread.append(f"{self._folder / shard.folder / read.name}: {error}")
            self._texts.discard(read.run.configuration)
            return False
        finally:
            self._index.execute("RELEASE one")
        return True

    def _insert(self, shard: Shard, read: Read) -> None:
        index, run, key = self._index, read.run, (shard.id, read.name)
        query = "SELECT 1 FROM runs WHERE shard = ? AND name = ? AND stamp = ?"
        if _first(index, query, *key, read.stamp):
            return  # another program was faster
        index.execute("DELETE FROM runs WHERE shard = ? AND name = ?", key)
        build = _id(index, "builds", platform=run.platform, configuration=run.configuration)
        values = (*key, read.stamp, read.utc, build, *(getattr(run, name) for name in OWN),
                  json.dumps(dict(run.provenance)))  # fmt: skip
        names = ("shard", "name", "stamp", "utc", "build", *OWN, "provenance")
        entered = index.execute(_insertion("runs", names), values).lastrowid
        for part, name in PARTS.items():
            if numbers := getattr(run, name):
                form = form_of((p.name, p.unit, p.observable) for p in numbers)
                cell = (entered, part, _id(index, "forms", text=form), packed(numbers))
                index.execute("INSERT INTO numbers VALUES (?, ?, ?, ?)", cell)
        if read.testbed:
            known = (run.configuration, run.platform, read.testbed)
            index.execute("INSERT OR IGNORE INTO configurations VALUES (?, ?, ?)", known)


def _id(index: sqlite3.Connection, table: str, **key: str) -> int | None:
    """Return the number of a row, which is made if need be."""
    query = f"SELECT id FROM {table} WHERE {' AND '.join(f'{name} = ?' for name in key)}"
    found: int | None = _first(index, query, *key.values())
    if found is None:
        index.execute(_insertion(table, tuple(key)), tuple(key.values()))
        found = _first(index, query, *key.values())
    return found


def _insertion(table: str, names: Sequence[str]) -> str:
    return f"INSERT INTO {table} ({', '.join(names)}) VALUES ({', '.join('?' * len(names))})"


def _first(index: sqlite3.Connection, query: str, *values: object) -> Any:
    """Return the first value of the first row; None if there is none."""
    row = index.execute(query, values).fetchone()
    return None if row is None else row[0]


def _is_text(name: str) -> bool:
    """Return whether a folder's name is text; a system may keep other bytes."""
    return not any("\ud800" <= letter <= "\udfff" for letter in name)


def _utc(made_at: str, folder: Path) -> float:
    """Return a time as s since 1970; InputError for one at which no run was made."""
    where = f"{folder}: made_at"
    try:
        utc = datetime.fromisoformat(made_at).astimezone().timestamp()
    except (ValueError, ArithmeticError, OSError) as error:
        raise InputError(where, str(error), A_TIME) from error
    if not 0 <= utc < LATEST:
        raise InputError(where, f"'{made_at}'", A_TIME)
    return utc
