"""A logbook with more runs than can be checked each time: what is not listed, and what is noticed.

Months are as old as their last run, so that they count as settled.
"""

import os
import shutil
import sqlite3
import time
from contextlib import closing, contextmanager
from functools import cache

import pytest

from equipoise.app.arguments.run_filter import WantedRuns, choice_of
from equipoise.io.documents import logbook_update, run_file, run_shards
from equipoise.io.documents.logbook import INDEX, Choice, open_logbook
from equipoise.io.documents.run_file import text_of_run
from equipoise.io.documents.run_folder import announce
from equipoise.io.documents.run_shards import month_of
from equipoise.model.estimate import COM, INERTIA
from equipoise.model.logged_run import RUN
from tests.io.documents.killed_writer import put, run
from verification.many_runs import made, run_of, write_runs

COUNT = 1200
MONTHS = 120  # ten years, by hand
AGO = 3600.0  # s


@pytest.fixture(scope="module")
def many(tmp_path_factory):
    """Return a folder of runs of ten years; no test changes it."""
    folder = tmp_path_factory.mktemp("many")
    write_runs(folder, range(COUNT), COUNT)
    listed(folder)
    age(folder)
    listed(folder)
    return folder


def listed(folder):
    with open_logbook(folder) as book:
        return [entry.name for entry in book.runs()]


def age(*folders):
    """Let folders have changed an hour ago."""
    for folder in folders:
        os.utime(folder, (time.time() - AGO,) * 2)


@contextmanager
def watched(monkeypatch):
    """Lend what is listed, and of what files and folders the time is taken."""
    folders, paths = [], []
    with monkeypatch.context() as patch:
        scan, stamp = os.scandir, run_shards.stamp_of
        patch.setattr(os, "scandir", lambda path: folders.append(path) or scan(path))
        for module in (run_shards, logbook_update):
            patch.setattr(module, "stamp_of", lambda path: paths.append(path) or stamp(path))
        yield folders, paths


@pytest.fixture
def months(tmp_path):
    """Return a logbook of three settled runs, of two months and of none."""
    for name in ("flat", "2026-01/a", "2026-02/b"):
        put(tmp_path, name, run())
    age(tmp_path, tmp_path / "2026-01", tmp_path / "2026-02")
    assert sorted(listed(tmp_path)) == ["2026-01/a", "2026-02/b", "flat"]
    age(tmp_path)
    listed(tmp_path)
    return tmp_path


# --- What is not done ----------------------------------------------------------------------------


def test_with_nothing_new_no_folder_is_listed(many, monkeypatch):
    """Times are taken of the folder, of each month twice (it could be a run), of the last runs."""
    with watched(monkeypatch) as (folders, paths):
        assert len(listed(many)) == COUNT
    assert folders == []
    assert len(paths) == 1 + 2 * MONTHS + logbook_update.RECENT


def test_with_one_new_run_its_month_is_listed(many, tmp_path, monkeypatch):
    runs = tmp_path / "runs"
    shutil.copytree(many, runs, copy_function=shutil.copy2)
    put(runs, "2020-05/new", run())
    with watched(monkeypatch) as (folders, paths):
        assert len(listed(runs)) == COUNT + 1
    assert folders == [str(runs / "2020-05")]
    assert len(paths) < 1 + 2 * MONTHS + logbook_update.RECENT + COUNT / 100


def test_an_index_comes_and_goes_without_a_trace_in_the_folder(months):
    """Else the folder of all runs, which may have many of old, would be listed each time."""
    before = months.stat().st_mtime_ns
    put(months, "2026-02/c", run())
    assert len(listed(months)) == 4
    assert months.stat().st_mtime_ns == before


def test_a_flat_folder_of_old_is_not_listed_either(tmp_path, monkeypatch):
    for k in range(30):
        put(tmp_path, f"run{k}", run())
    listed(tmp_path)
    age(tmp_path)
    listed(tmp_path)
    with watched(monkeypatch) as (folders, _):
        assert len(listed(tmp_path)) == 30
    assert folders == []


# --- What is noticed -----------------------------------------------------------------------------


def test_a_folder_that_changed_a_moment_ago_is_listed_again(months, monkeypatch):
    put(months, "2026-01/new", run())
    listed(months)
    with watched(monkeypatch) as (folders, _):
        listed(months)
    assert folders == [str(months / "2026-01")]


def test_a_run_that_goes_and_a_month_that_goes(months):
    shutil.rmtree(months / "2026-01/a")
    assert sorted(listed(months)) == ["2026-02/b", "flat"]
    shutil.rmtree(months / "2026-02")
    assert listed(months) == ["flat"]
    put(months, "2026-02/b", run())
    assert sorted(listed(months)) == ["2026-02/b", "flat"]


@pytest.mark.skipif(os.name == "nt", reason="links take rights there")
def test_a_month_that_cannot_be_listed_is_reported_and_stays(months):
    """Here a link to itself; a drive that is gone for a moment is another."""
    (months / "2026-02").rename(months / "else")
    (months / "2026-02").symlink_to("2026-02")
    for _ in range(2):
        with open_logbook(months) as book:
            assert len(book.runs()) == 3
            assert "2026-02" in book.unread[0]
    (months / "2026-02").unlink()
    assert len(listed(months)) == 2


def test_a_run_that_is_copied_piece_by_piece_is_noticed_when_it_is_whole(months):
    """The month's time does not change when the last file comes."""
    folder = months / "2026-01" / "slow"
    folder.mkdir()
    age(months / "2026-01")
    assert len(listed(months)) == 3
    stamp = (months / "2026-01").stat().st_mtime_ns
    (folder / RUN).write_text(text_of_run(run()))
    assert (months / "2026-01").stat().st_mtime_ns == stamp
    assert "2026-01/slow" in listed(months)


def test_a_broken_run_is_reported_each_time_until_it_is_mended(months):
    path = months / "2026-01" / "broken" / RUN
    put(months, "2026-01/broken", run())
    path.write_text("{")
    age(months / "2026-01")
    for _ in range(3):
        with open_logbook(months) as book:
            assert "broken" in book.unread[0]
            assert len(book.runs()) == 3
    path.write_text(text_of_run(run()))
    with open_logbook(months) as book:
        assert book.unread == []
        assert len(book.runs()) == 4


def test_a_run_that_breaks_is_listed_no_more(months):
    (months / "flat" / RUN).write_text("{")
    assert sorted(listed(months)) == ["2026-01/a", "2026-02/b"]


@pytest.fixture
def with_old_one(months, monkeypatch):
    """Return a logbook whose run a is not among those that are checked each time."""
    monkeypatch.setattr(logbook_update, "RECENT", 1)
    os.utime(months / "2026-02/b" / RUN, (time.time() + 10,) * 2)
    listed(months)
    return months


def test_a_late_run_that_is_rewritten_is_noticed(with_old_one):
    rewritten(with_old_one / "2026-02/b")
    assert methods(with_old_one) == {"2026-02/b": "other"}


def test_an_old_run_that_is_rewritten_is_noticed_once_it_is_announced(with_old_one):
    """As this program does when it writes into a folder that is there; the limit is documented."""
    rewritten(with_old_one / "2026-01/a")
    assert methods(with_old_one) == {}
    announce(with_old_one / "2026-01/a")
    assert methods(with_old_one) == {"2026-01/a": "other"}


def rewritten(folder):
    (folder / RUN).write_text(text_of_run(run(method="other")))


def methods(folder):
    """Return the methods of runs that are not the usual one."""
    with open_logbook(folder) as book:
        return {r.name: r.method for r in book.runs(Choice("method <> ?", ["measure_and_move"]))}


def test_runs_of_one_name_in_two_months_are_two(months):
    put(months, "2026-02/a", run(method="other"))
    assert methods(months) == {"2026-02/a": "other"}
    with open_logbook(months) as book:
        assert len(book.numbers("2026-01/a", "home")) == 2
        assert len(book.numbers("2026-02/a", "home")) == 2
        assert book.numbers("a", "home") == ()


def test_a_stopped_taking_in_is_gone_on_with(tmp_path, monkeypatch):
    """After five of nine, in batches of two: four are there, and five are left to read."""
    monkeypatch.setattr(logbook_update, "BATCH", 2)
    for k in range(9):
        put(tmp_path, f"2026-01/run{k}", run())
    read, read_one = [], run_file.read_run

    def stopped(folder):
        if len(read) == 5:
            raise KeyboardInterrupt
        read.append(folder.name)
        return read_one(folder)

    with monkeypatch.context() as patch:
        patch.setattr(run_file, "read_run", stopped)
        with pytest.raises(KeyboardInterrupt):
            listed(tmp_path)
    with closing(sqlite3.connect(tmp_path / INDEX)) as index:
        assert index.execute("SELECT count(*) FROM runs").fetchone() == (4,)
    monkeypatch.setattr(run_file, "read_run", lambda path: read.append(path.name) or read_one(path))
    assert listed(tmp_path) == [f"2026-01/run{k}" for k in range(9)]
    assert len(read) == 5 + 5


# --- What is chosen ------------------------------------------------------------------------------

WISHES = (
    WantedRuns(last=0),
    WantedRuns(platform="SPUT", last=7),
    WantedRuns(kind="balance", outcome="failed"),
    WantedRuns(method="batch", since="2020-01-01", last=0),
    WantedRuns(until="2017-01-01", platform="lab", last=3),
    WantedRuns(platform="nobody"),
)


@pytest.mark.parametrize("wanted", WISHES)
def test_a_choice_is_what_going_through_all_runs_gives(many, wanted):
    """In the order of time; with as many builds, and numbers, as these runs have."""
    chosen = [k for k in range(COUNT) if matches(k, wanted)]
    assert bool(chosen) == (wanted.platform != "nobody")
    last = chosen[-wanted.last :] if wanted.last else chosen
    with open_logbook(many) as book:
        choice = choice_of(wanted)
        assert [own_number(r.name) for r in book.runs(choice)] == last
        assert book.count(choice) == len(chosen)
        assert sum(build.runs for build in book.builds(choice)) == len(chosen)
        table = book.table(("name", "platform"), ("home", "standing"), choice)
    assert [own_number(name) for name in table.columns["name"]] == last
    home, standing = table.numbers("home", (*COM, *INERTIA)), table.numbers("standing", COM)
    assert home.value.tolist() == [[p.value for p in entry_of(k).parameters] for k in last]
    assert standing.there.all(axis=1).tolist() == [k % 3 == 0 for k in last]


@cache
def entry_of(k):
    return run_of(k, COUNT)


def own_number(name):
    return int(name.rpartition("_")[2])


def matches(k, wanted):
    """Return whether the k-th run is wanted, by the run itself."""
    entry, day = entry_of(k), f"{made(k, COUNT):%Y-%m-%d}"
    return (
        (wanted.platform or "").lower() in entry.platform.lower()
        and wanted.kind in (None, entry.kind)
        and wanted.outcome in (None, entry.outcome)
        and wanted.method in (None, entry.method)
        and (wanted.since or "") <= day < (wanted.until or "9")
    )


@pytest.mark.parametrize("wanted", WISHES)
def test_what_does_not_match_is_not_fetched(many, wanted):
    """Steps of SQLite's machine: a few for each run that is passed over, however many there are."""
    steps = []
    with open_logbook(many) as book:
        book._index.set_progress_handler(lambda: steps.append(1), 100)
        book.runs(choice_of(wanted)._replace(last=5))
        book.count(choice_of(wanted))
    assert len(steps) * 100 < 40 * COUNT


def test_a_run_of_now_goes_into_the_folder_of_its_month():
    assert month_of(made(0, COUNT)) == "2016-01"
