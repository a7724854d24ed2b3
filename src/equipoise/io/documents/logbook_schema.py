"""The tables of a logbook's index: a script for each version, and the way from one to the next."""

import sqlite3
from collections.abc import Generator
from contextlib import contextmanager

from equipoise.io.documents.logbook_numbers import FormOfOld, PackedOfOld
from equipoise.model.errors import InputError

# What was published once is never changed, only followed. From version 3 on: runs stand in
# folders of months (``shards``, the folder of all runs is one); what a run shares with others
# (build, names of numbers) is kept once; its numbers are doubles in one cell.
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
    """
    CREATE TABLE shards (
        id INTEGER PRIMARY KEY, folder TEXT NOT NULL UNIQUE, stamp INTEGER
    );
    INSERT INTO shards VALUES (0, '', NULL);
    CREATE TABLE waiting (
        shard INTEGER NOT NULL REFERENCES shards (id) ON DELETE CASCADE, name BLOB NOT NULL,
        PRIMARY KEY (shard, name)
    ) WITHOUT ROWID;
    CREATE TABLE builds (
        id INTEGER PRIMARY KEY, platform TEXT NOT NULL, configuration TEXT NOT NULL,
        UNIQUE (platform, configuration)
    );
    INSERT INTO builds (platform, configuration)
        SELECT DISTINCT platform, configuration FROM runs;
    CREATE TABLE forms (id INTEGER PRIMARY KEY, text TEXT NOT NULL UNIQUE);
    CREATE TABLE sharded (
        id INTEGER PRIMARY KEY, shard INTEGER NOT NULL REFERENCES shards (id) ON DELETE CASCADE,
        name TEXT NOT NULL, stamp INTEGER NOT NULL, utc REAL NOT NULL,
        build INTEGER NOT NULL REFERENCES builds (id), kind TEXT NOT NULL, outcome TEXT NOT NULL,
        method TEXT NOT NULL, bench TEXT NOT NULL, made_at TEXT NOT NULL, temperature REAL,
        sentence TEXT NOT NULL, provenance TEXT NOT NULL, UNIQUE (shard, name)
    );
    INSERT INTO sharded
        SELECT NULL, 0, name, stamp, utc, builds.id, kind, outcome, method, bench, made_at,
            temperature, sentence, provenance
        FROM runs JOIN builds USING (platform, configuration) ORDER BY utc;
    CREATE TABLE numbers (
        run INTEGER NOT NULL REFERENCES sharded (id) ON DELETE CASCADE, part TEXT NOT NULL,
        form INTEGER NOT NULL REFERENCES forms (id), data BLOB NOT NULL, PRIMARY KEY (run, part)
    ) WITHOUT ROWID;
    CREATE TEMP TABLE packed AS
        SELECT sharded.id AS run, part, form(e.name, unit, observable) AS form,
            packed(value, sd) AS data
        FROM (SELECT * FROM estimates ORDER BY run, part, place) AS e
        JOIN sharded ON sharded.name = e.run GROUP BY e.run, part;
    INSERT INTO forms (text) SELECT DISTINCT form FROM packed;
    INSERT INTO numbers
        SELECT run, part, forms.id, data FROM packed JOIN forms ON forms.text = packed.form;
    DROP TABLE packed;
    DROP TABLE estimates;
    DROP TABLE runs;
    ALTER TABLE sharded RENAME TO runs;
    CREATE INDEX runs_by_time ON runs (utc, build, kind, outcome, method);
    CREATE INDEX runs_by_build ON runs (build, utc, kind, outcome, method);
    CREATE INDEX runs_by_stamp ON runs (stamp);
    """,
)


def migrate(index: sqlite3.Connection, source: str) -> None:
    """Bring an index to today's version, in one transaction.

    Raises InputError for one that is newer than this program.
    """
    if _version(index) == len(MIGRATIONS):
        return
    # The declared types know sums of whole numbers alone.
    index.create_aggregate("packed", 2, PackedOfOld)  # pyright: ignore[reportArgumentType]
    index.create_aggregate("form", 3, FormOfOld)  # pyright: ignore[reportArgumentType]
    with whole(index):  # of two programs one waits, and finds the work done
        version = _version(index)
        if version > len(MIGRATIONS):
            wanted = f"an index of version {len(MIGRATIONS)} or older: update equipoise"
            raise InputError(source, f"version {version}", wanted)
        for script in MIGRATIONS[version:]:
            for statement in filter(str.strip, script.split(";")):
                index.execute(statement)
        index.execute(f"PRAGMA user_version = {len(MIGRATIONS)}")


def _version(index: sqlite3.Connection) -> int:
    return index.execute("PRAGMA user_version").fetchone()[0]


@contextmanager
def whole(index: sqlite3.Connection) -> Generator[None]:
    """Carry out all of a block, or nothing of it."""
    index.execute("BEGIN IMMEDIATE")
    try:
        yield
    except BaseException:
        index.execute("ROLLBACK")
        raise
    index.execute("COMMIT")
