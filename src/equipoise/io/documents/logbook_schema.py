"""The tables of a logbook's index, and how an older index becomes one of today."""

import sqlite3

from equipoise.model.errors import InputError

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
