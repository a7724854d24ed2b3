"""The database of a bag of ROS 2 (.db3; public: rosbag2's design pages), read by SQLite itself.

A database may hold more than rows: a view or a computed column makes rows without end, and values
of any size, of nothing. So the two tables have to be tables, no value is larger than what is left,
and SQLite is stopped where the time is over. What SQLite says of a broken one need not be text:
Python raises UnicodeDecodeError then.
"""

import sqlite3
from collections.abc import Iterator
from contextlib import closing
from pathlib import Path
from typing import Any

from equipoise.io.files.broken_bytes import as_broken, each_unbroken
from equipoise.io.files.reading_budget import Meter
from equipoise.io.logs.log_topics import PART, TopicReader, Topics
from equipoise.io.logs.ros.ros_messages import is_known
from equipoise.io.logs.ros.ros_types import BROKEN, ros_decoder
from equipoise.io.logs.unpacking_work import Work
from equipoise.model.errors import InputError

STEPS = 100_000  # of SQLite's machine, between two looks at the time (chosen: some ms)
LONGEST = 1_000_000_000  # bytes of a value, SQLite's own limit
TABLES = """SELECT count(*) FROM sqlite_master WHERE type = 'table'
    AND name IN ('messages', 'topics') AND sql NOT LIKE 'CREATE VIRTUAL%'"""
TOPICS = "SELECT id, name, type, serialization_format FROM topics ORDER BY id"
COUNTS = "SELECT topic_id, count(*) FROM messages GROUP BY topic_id"
ROWS = """SELECT topic_id, timestamp, data FROM messages
    WHERE topic_id IN (SELECT id FROM topics WHERE type IN ({})) ORDER BY timestamp"""
Known = dict[int, TopicReader]  # by the number of a topic


def add_database(path: Path, topics: Topics, packed: Work | None = None) -> None:
    """Add every topic of a database, those of known types with their rows.

    ``packed``: each message is, and what unpacking them may take. InputError if all of it is too
    much, or if it is broken.
    """
    with as_broken(topics.meter.source, *BROKEN):
        database = connected(path, topics.meter)
    with closing(database):
        _add(database, topics, packed)


def connected(path: Path, meter: Meter) -> sqlite3.Connection:
    """Return a database that is only read, whose values fit and whose queries end in time."""
    database = sqlite3.connect(f"{path.resolve().as_uri()}?mode=ro&immutable=1", uri=True)
    database.setlimit(sqlite3.SQLITE_LIMIT_LENGTH, max(min(meter.left, LONGEST), 1))
    database.set_progress_handler(lambda: _is_over(meter), STEPS)
    database.text_factory = _text
    database.execute("PRAGMA trusted_schema = OFF")
    return database


def _text(data: bytes) -> str:
    return data.decode(errors="replace")


def _is_over(meter: Meter) -> bool:
    try:
        meter.check(0)
    except InputError:
        return True
    return False


def _answers(
    database: sqlite3.Connection, meter: Meter, query: str, *words: str
) -> Iterator[tuple[Any, ...]]:
    """Yield the rows of an answer; InputError if it cannot be read, or takes too much."""
    broken = meter.source, *BROKEN
    try:
        with as_broken(*broken):
            cursor = database.execute(query, words)
        yield from each_unbroken(cursor, *broken)
    except InputError:
        meter.check(0)  # it may have been stopped
        raise


def _add(database: sqlite3.Connection, topics: Topics, packed: Work | None) -> None:
    if next(_answers(database, topics.meter, TABLES)) != (2,):
        raise InputError(topics.meter.source, "no tables of topics and messages", BROKEN[1])
    known = _known(database, topics)
    kinds = sorted({each.kind for each in known.values()})
    places = ",".join("?" * len(kinds))
    for number, logged, raw in _answers(database, topics.meter, ROWS.format(places), *kinds):
        if number in known and isinstance(logged, int) and isinstance(raw, bytes):
            topics.read(known[number], logged, raw, packed)


def _known(database: sqlite3.Connection, topics: Topics) -> Known:
    """Declare every topic, and return those whose type is known."""
    counts, known = dict[object, int](_answers(database, topics.meter, COUNTS)), Known()
    for number, name, kind, form in _answers(database, topics.meter, TOPICS):
        topics.meter.take(PART)
        topics.declare(str(name), str(kind), counts.get(number, 0))
        if is_known(str(kind)) and form == "cdr":
            decoder = ros_decoder(str(kind), True, topics.meter.source)
            known[number] = TopicReader(str(name), str(kind), decoder)
    return known
