"""The index of a folder of runs: it says what the folders say, whatever happens to it."""

import math
import os
import sqlite3
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import pytest

from equipoise.io.documents import run_file
from equipoise.io.documents.logbook import INDEX, Choice, open_logbook
from equipoise.io.documents.logbook_schema import MIGRATIONS
from equipoise.io.documents.run_file import read_run
from equipoise.model.errors import InputError
from equipoise.model.logged_run import RUN
from equipoise.model.verdict import VerdictOutcome
from tests.io.documents import killed_writer
from tests.io.documents.killed_writer import put, run
from tests.support import thorough

KILLED = thorough.count(100, 10)


def listed(folder):
    with open_logbook(folder) as book:
        return [entry.name for entry in book.runs()]


def test_a_run_comes_back_with_its_numbers(tmp_path):
    put(tmp_path, "one", run(temperature=21.5))
    assert read_run(tmp_path / "one").parameters == run().parameters
    with open_logbook(tmp_path) as book:
        (entry,) = book.runs()
        assert (entry.name, entry.temperature, entry.provenance) == ("one", 21.5, {"seed": "1"})
        x, z = book.numbers("one", "home")
        assert (x.value, x.sd, x.observable) == (1.25e-6, 1e-7, True)
        assert (z.value, z.sd, z.observable) == (-1e-4, math.inf, False)
        assert [p.name for p in book.numbers("one", "standing")] == ["com_x"]
        assert book.configuration("c1") == "name = 'Mock-up'\n"
        assert book.configuration("c2") == ""


def test_runs_stand_in_the_order_of_time_wherever_they_were_made(tmp_path):
    """Noon in Tokyo is before noon in Paris."""
    put(tmp_path, "paris", run("2026-03-01T12:00:00+01:00"))
    put(tmp_path, "tokyo", run("2026-03-01T12:00:00+09:00"))
    put(tmp_path, "before", run("2026-02-28T23:00:00+00:00"))
    assert listed(tmp_path) == ["before", "tokyo", "paris"]


def test_it_knows_what_came_changed_or_went_since(tmp_path):
    put(tmp_path, "one", run())
    put(tmp_path, "two", run("2026-03-02T12:00:00+01:00"))
    assert listed(tmp_path) == ["one", "two"]
    (tmp_path / "two" / RUN).unlink()
    put(tmp_path, "three", run("2026-03-03T12:00:00+01:00"))
    put(tmp_path, "one", run("2026-03-04T12:00:00+01:00", outcome=VerdictOutcome.FAILED))
    os.utime(tmp_path / "one" / RUN, ns=(1, 1))
    with open_logbook(tmp_path) as book:
        assert [(r.name, r.outcome) for r in book.runs()] == [
            ("three", "passed"),
            ("one", "failed"),
        ]
        assert [r.name for r in book.runs(Choice("outcome = ?", ["failed"]))] == ["one"]
        assert len(book.numbers("one", "home")) == 2


def test_a_deleted_index_is_made_anew(tmp_path):
    for k in range(5):
        put(tmp_path, f"run{k}", run(f"2026-03-0{k + 1}T12:00:00+01:00"))
    before = listed(tmp_path)
    for path in tmp_path.glob(f"{INDEX}*"):
        path.unlink()
    assert listed(tmp_path) == before == [f"run{k}" for k in range(5)]


def test_other_files_and_folders_are_let_alone(tmp_path):
    (tmp_path / "notes").mkdir()
    (tmp_path / "notes.txt").write_text("mine")
    (tmp_path / ".hidden").mkdir()
    put(tmp_path, "one", run())
    assert listed(tmp_path) == ["one"]


@pytest.mark.parametrize("content", ["", "{}", "not JSON", '{"run": 3}'])
def test_an_invalid_entry_is_reported_and_the_others_are_listed(tmp_path, content):
    put(tmp_path, "one", run())
    put(tmp_path, "two", run())
    (tmp_path / "two" / RUN).write_text(content)
    for _ in range(2):  # it is reported each time
        with open_logbook(tmp_path) as book:
            assert [entry.name for entry in book.runs()] == ["one"]
            assert len(book.unread) == 1
            assert "two" in book.unread[0]


def test_an_invalid_time_is_reported(tmp_path):
    put(tmp_path, "one", run("yesterday"))
    with open_logbook(tmp_path) as book:
        assert book.runs() == []
        assert "yesterday" in book.unread[0]


def test_an_invalid_index_is_reported_in_words(tmp_path):
    put(tmp_path, "one", run())
    (tmp_path / INDEX).write_text("no database at all" * 100)
    with pytest.raises(InputError, match="delete it"), open_logbook(tmp_path):
        pass


def test_a_missing_folder_is_reported(tmp_path):
    with pytest.raises(InputError, match="no such folder"), open_logbook(tmp_path / "none"):
        pass


# --- Versions ------------------------------------------------------------------------------------


OF_OLD = (  # part, place, name, value, sd, whether it is observable; null was NaN
    ("home", 1, "com_z", -1e-4, math.inf, 0),
    ("home", 0, "com_x", 1.5e-6, None, 1),
    ("standing", 0, "com_y", 2e-6, 1e-7, 1),
)


@pytest.mark.parametrize("version", range(1, len(MIGRATIONS)))
def test_an_older_index_becomes_one_of_today(tmp_path, version):
    """With what it holds: the run whose folder has not changed is not read again."""
    put(tmp_path, "one", run())
    stamp = (tmp_path / "one" / RUN).stat().st_mtime_ns
    index = sqlite3.connect(tmp_path / INDEX)
    index.execute("PRAGMA journal_mode = WAL")  # as it was then
    for script in MIGRATIONS[:version]:
        index.executescript(script)
    index.execute(
        "INSERT INTO runs (name, stamp, utc, kind, made_at, platform, configuration, method, bench,"
        " outcome, sentence, provenance) VALUES ('one', ?, 0, 'balance', '', '', '', 'of old', '',"
        " 'passed', '', '{}')", (stamp,))  # fmt: skip
    index.executemany("INSERT INTO estimates VALUES ('one', ?, ?, ?, 'm', ?, ?, ?)", OF_OLD)
    index.execute(f"PRAGMA user_version = {version}")
    index.commit()
    index.close()
    with open_logbook(tmp_path) as book:
        assert [(entry.method, entry.temperature) for entry in book.runs()] == [("of old", None)]
        x, z = book.numbers("one", "home")
        assert (x.name, x.unit, x.value, x.observable) == ("com_x", "m", 1.5e-6, True)
        assert math.isnan(x.sd)
        assert (z.name, z.value, z.sd, z.observable) == ("com_z", -1e-4, math.inf, False)
        assert [(p.name, p.value) for p in book.numbers("one", "standing")] == [("com_y", 2e-6)]


def test_a_newer_index_is_refused(tmp_path):
    listed(tmp_path)
    index = sqlite3.connect(tmp_path / INDEX)
    index.execute("PRAGMA user_version = 99")
    index.close()
    with pytest.raises(InputError, match="version 99"), open_logbook(tmp_path):
        pass


def test_a_migration_that_fails_changes_nothing(tmp_path, monkeypatch):
    from equipoise.io.documents import logbook_schema

    listed(tmp_path)
    broken = (*MIGRATIONS, "CREATE TABLE more (x TEXT); NOT SQL;")
    monkeypatch.setattr(logbook_schema, "MIGRATIONS", broken)
    with pytest.raises(InputError, match="syntax error"), open_logbook(tmp_path):
        pass
    monkeypatch.undo()
    assert listed(tmp_path) == []
    index = sqlite3.connect(tmp_path / INDEX)
    assert index.execute("SELECT count(*) FROM sqlite_master WHERE name = 'more'").fetchone() == (
        0,
    )
    index.close()


# --- Several at once, and killed -----------------------------------------------------------------


def test_two_that_write_at_once_lose_nothing(tmp_path):
    def write(who):
        for k in range(40):
            put(tmp_path, f"{who}{k:02d}", run())
            listed(tmp_path)

    listed(tmp_path)
    script = (
        "from tests.io.documents.test_logbook import *\n"
        f"write_from_outside(Path({str(tmp_path)!r}))"
    )
    other = subprocess.Popen([sys.executable, "-c", script], cwd=Path(__file__).parents[3])
    with ThreadPoolExecutor(1) as pool:
        pool.submit(write, "here").result()
    assert other.wait(60) == 0
    assert len(listed(tmp_path)) == 80


def write_from_outside(folder):
    """What the other program does."""
    for k in range(40):
        put(folder, f"there{k:02d}", run())
        listed(folder)


@pytest.mark.skipif(os.name == "nt", reason="no SIGKILL, no fork")
def test_killed_while_writing_it_is_sound_and_complete(tmp_path):
    """Programs, each killed at a random moment: integrity, no half run, none missing."""
    script = Path(killed_writer.__file__)
    done = subprocess.run(
        [sys.executable, script, tmp_path, str(KILLED)], capture_output=True, text=True, check=True
    )
    lines = [line.split() for line in done.stdout.splitlines()]
    assert [line[1:] for line in lines] == [["True", "True"]] * KILLED
    assert int(lines[-1][0]) >= KILLED  # each wrote one, and was then killed at the next ones


def test_listing_again_reads_no_run(tmp_path, monkeypatch):
    """Ten thousand are listed at once (`make bench`) because only what changed is read."""
    for k in range(20):
        put(tmp_path, f"run{k:02d}", run())
    read, read_one = [], run_file.read_run
    monkeypatch.setattr(run_file, "read_run", lambda path: read.append(path.name) or read_one(path))
    assert len(listed(tmp_path)) == len(read) == 20
    read.clear()
    put(tmp_path, "later", run())
    assert len(listed(tmp_path)) == 21
    assert read == ["later"]
