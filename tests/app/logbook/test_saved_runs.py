"""Runs are kept with all that belongs to them, listed, compared, drawn, exported, set anew."""

import csv
import hashlib
import json
import os
import shutil
import sqlite3
from contextlib import closing
from dataclasses import replace
from datetime import datetime, timedelta

import numpy as np
import pypdfium2
import pytest

from equipoise.app.cli import run
from equipoise.io.documents import logbook_update
from equipoise.io.documents.run_file import read_run, text_of_run

INSIDE = {"report.html", "report.pdf", "report.json", "figures", "testbed.toml", "run.json"}


@pytest.fixture(scope="module")
def runs(tmp_path_factory, record_file):
    """Return a folder with a balancing that found its own place, and two identifications."""
    folder = tmp_path_factory.mktemp("here") / "my runs"
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("EQUIPOISE_RUNS", str(folder))
        assert run(["balance", "sputnix", "--seed", "3"]) in (0, 1)
        assert run(["identify", str(record_file), "--testbed", "sputnix"]) == 0
        assert run(["identify", str(record_file), "--testbed", "sputnix"]) == 0
    return folder


@pytest.fixture
def of(runs, equipoise, monkeypatch):
    """Return a function that asks the logbook of these runs."""
    monkeypatch.setenv("EQUIPOISE_RUNS", str(runs))
    return lambda *words: equipoise("logbook", *words)


def folders(runs, kind):
    return sorted(path for path in runs.glob("*/*") if kind in path.name)


def test_each_run_has_a_folder_of_its_own(runs):
    balanced, identified = folders(runs, "balance"), folders(runs, "identify")
    assert (len(balanced), len(identified)) == (1, 2)
    for path in (*balanced, *identified):
        assert {each.name for each in path.iterdir()} >= INSIDE
    assert (balanced[0] / "recording.csv").exists()
    assert not (identified[0] / "recording.csv").exists()  # it has a file of its own


def test_an_entry_holds_what_the_document_holds(runs):
    """The verdict's centre of mass, and which testbed file it was."""
    folder = folders(runs, "balance")[0]
    entry, document = read_run(folder), json.loads((folder / "balance.json").read_text())
    verdict = document["steps"][-1]["verdict"]
    assert entry.outcome == verdict["outcome"]
    assert [p.value for p in entry.standing] == pytest.approx(verdict["com_m"])
    testbed = (folder / "testbed.toml").read_bytes()
    assert entry.configuration == hashlib.sha256(testbed).hexdigest()


def test_what_was_kept_can_be_used_again(runs, equipoise):
    folder = folders(runs, "balance")[0]
    words = [folder / "recording.csv", "--testbed", folder / "testbed.toml"]
    assert equipoise("identify", *words).code == 0


def test_with_an_empty_name_nothing_is_kept(equipoise, tmp_path, record_file):
    assert equipoise("identify", record_file, "--testbed", "sputnix").code == 0
    assert list(tmp_path.iterdir()) == []


def test_where_runs_cannot_be_kept_it_is_said(equipoise, tmp_path, record_file, monkeypatch):
    (tmp_path / "file").write_text("")
    monkeypatch.setenv("EQUIPOISE_RUNS", "file")
    done = equipoise("identify", record_file, "--testbed", "sputnix")
    assert done.code == 0
    assert "this run is not kept" in done.err
    assert "EQUIPOISE_RUNS" in done.err


def test_the_list_has_one_line_per_run(of):
    done = of()
    assert done.code == 0
    lines = [line for line in done.out.splitlines() if "sputnix" in line.lower()]
    assert len(lines) == 3
    assert "balance" in lines[0]
    assert "measure_and_move" in lines[0]
    assert [line.split()[0] for line in lines] == ["1", "2", "3"]


@pytest.mark.parametrize(
    ("words", "count"),
    [(["--kind", "identify"], 2), (["--kind", "balance"], 1), (["--platform", "SPUTNIX"], 3),
     (["--platform", "nobody"], 0), (["--method", "measure_and_move"], 1), (["--last", "1"], 1),
     (["--since", "2020-01-01"], 3), (["--until", "2020-01-01"], 0), (["--outcome", "usable"], 2)],
)  # fmt: skip
def test_runs_are_chosen(of, words, count, strict_json):
    assert len(strict_json(of(*words, "--json").out)["runs"]) == count


@pytest.mark.parametrize(
    ("words", "said"),
    [(["--kind", "balnace"], "balance"), (["--outcome", "good"], "undecided"),
     (["--since", "spring"], "2026-03-01"), (["--compare", "9"], "a number from 1 to 3"),
     (["--trend", "a.txt"], ".png .svg .pdf"), (["--export", "a.xls"], ".csv .parquet"),
     (["--trend", "none/a.png"], "none"), (["--builds", "--compare", "1"], "one of the two")],
)  # fmt: skip
def test_what_is_wrong_is_said(of, words, said):
    done = of(*words)
    assert done.code == 2
    assert said in " ".join(done.err.split())


def test_the_same_recording_gives_the_same_numbers(of, strict_json):
    deviations = strict_json(of("--compare", "2", "3", "--json").out)["sd_from_first"]
    assert all(
        value == 0 for each in deviations.values() for value in each.values() if value is not None
    )
    shown = of("--compare", "1", "2")
    assert shown.code == 0
    assert "com_x" in shown.out


def test_runs_are_compared_by_name(of, strict_json):
    """With the folder of the month, as the list has them, and without."""
    named = [run["name"] for run in strict_json(of("--json").out)["runs"]]
    for words in (named[1:], [name.partition("/")[2] for name in named[1:]]):
        compared = strict_json(of("--compare", *words, "--json").out)["runs"]
        assert [run["name"] for run in compared] == named[1:]


def test_a_name_of_two_runs_is_refused(equipoise, months):
    for month in ("2026-01", "2026-02"):
        shutil.copytree(months / "run-0", months / month / "twin")
    done = equipoise("logbook", months, "--compare", "twin", "run-0")
    assert done.code == 2
    assert "the name of 2 runs" in " ".join(done.err.split())
    assert equipoise("logbook", months, "--compare", "2026-01/twin", "2026-02/twin").code == 0


def test_beside_files_the_list_is_no_longer_than_usual(equipoise, tmp_path, months, strict_json):
    for k in range(20):
        shutil.copytree(months / "run-0", months / f"copy-{k}")
    done = equipoise("logbook", months, "--last", "0", "--export", "all.csv")
    assert "9 earlier runs are not shown" in done.err
    assert len((tmp_path / "all.csv").read_text().splitlines()) == 1 + 29
    both = equipoise("logbook", months, "--last", "0", "--export", "all.csv", "--json")
    assert len(strict_json(both.out)["runs"]) == 29


def test_a_table_holds_the_numbers(of, tmp_path, strict_json):
    """As CSV and as Parquet, beside what the JSON says."""
    assert of("--export", "runs.csv").code == 0
    assert of("--export", "runs.parquet").code == 0
    rows = list(csv.DictReader((tmp_path / "runs.csv").read_text().splitlines()))
    reported = strict_json(of("--json").out)["runs"]
    for row, each in zip(rows, reported, strict=True):
        assert (row["name"], row["outcome"]) == (each["name"], each["outcome"])
        known = {p["name"]: p["value"] for p in each["parameters"]}
        assert float(row["com_z_m"]) == pytest.approx(known["com_z"])
    from pyarrow import parquet

    table = parquet.read_table(tmp_path / "runs.parquet")
    assert table.column("com_z_m").to_pylist() == [float(row["com_z_m"]) for row in rows]


@pytest.fixture
def old(runs, tmp_path, monkeypatch):
    """Return a balancing of long ago: neither its month nor its file is checked again."""
    monkeypatch.setattr(logbook_update, "RECENT", 0)
    shutil.copytree(folders(runs, "balance")[0], tmp_path / "2026-01" / "mine")
    os.utime(tmp_path / "2026-01", (0, 0))
    return tmp_path / "2026-01" / "mine"


def test_a_run_of_long_ago_that_is_made_anew_is_noticed(old, equipoise, record_file):
    """The writer sets the time of the month."""
    assert "balance" in equipoise("logbook", old.parents[1]).out
    words = (record_file, "--testbed", "sputnix", "--out", old)
    assert equipoise("identify", *words).code == 0
    listed = equipoise("logbook", old.parents[1]).out
    assert "identify" in listed
    assert "balance" not in listed


def test_a_lost_index_is_made_anew(of, runs, strict_json):
    before = strict_json(of("--json").out)
    for path in runs.glob("logbook.sqlite*"):
        path.unlink()
    assert strict_json(of("--json").out) == before


def test_an_index_that_cannot_be_read_is_named(of, runs):
    """Its words for what is wrong are no text."""
    of()
    index = runs / "logbook.sqlite"
    with closing(sqlite3.connect(index)) as opened:
        opened.execute("PRAGMA wal_checkpoint(TRUNCATE)")
    whole = index.read_bytes()
    index.write_bytes(whole.replace(b"TABLE runs (", b"TABLE runs  ").replace(b"runs", b"r\xe5ns"))
    done = of()
    index.write_bytes(whole)
    assert done.code == 2
    assert "delete it, and it is rebuilt" in " ".join(done.err.split())


def test_a_damaged_run_is_left_out_in_words(of, runs):
    broken = runs / "broken"
    broken.mkdir()
    (broken / "run.json").write_text("{")
    done = of()
    shutil.rmtree(broken)
    assert done.code == 0
    assert "left out" in done.err
    assert "broken" in done.err


@pytest.fixture
def months(runs, tmp_path):
    """Return a folder of nine runs, three weeks apart, rebuilt after the fifth, warmed since."""
    folder = tmp_path / "months"
    entry, rng = read_run(folders(runs, "identify")[0]), np.random.default_rng(1)
    for k in range(9):
        made = datetime(2026, 1, 5, 9, 0).astimezone() + timedelta(weeks=3 * k)
        moved = tuple(
            replace(p, value=p.value + p.sd * rng.standard_normal()) for p in entry.parameters
        )
        build = entry.configuration if k < 5 else "0" * 64
        name = f"run-{k}"
        (folder / name).mkdir(parents=True)
        one = replace(entry, name=name, made_at=made.isoformat(), parameters=moved,
                      configuration=build, temperature=20.0 + k)  # fmt: skip
        (folder / name / "run.json").write_text(text_of_run(one))
    return folder


def test_a_trend_is_drawn(equipoise, months, tmp_path):
    for name in ("trend.png", "trend.svg"):
        done = equipoise("logbook", months, "--trend", name)
        assert done.code == 0
        assert (tmp_path / name).stat().st_size > 10_000
    text = (tmp_path / "trend.svg").read_text()
    assert "build A" in text
    assert "build B" in text


def test_a_trend_of_one_run_is_none(of):
    done = of("--kind", "balance", "--trend", "a.png")
    assert done.code == 2
    assert "two or more" in done.err


@pytest.fixture
def rebuilt(runs, tmp_path):
    """Return a folder of three runs: the second one with a heavier first mass."""
    folder, entry = tmp_path / "rebuilt", read_run(folders(runs, "identify")[0])
    first = (folders(runs, "identify")[0] / "testbed.toml").read_text()
    second = first.replace("mass_g = 15.6", "mass_g = 16.6", 1)
    assert second != first
    for k, text in enumerate((first, second, f"# tidied\n{second}")):
        made = datetime(2026, 1, 5, 9, 0).astimezone() + timedelta(weeks=3 * k)
        one = replace(entry, name=f"run-{k}", made_at=made.isoformat(), configuration=f"c{k}")
        (folder / one.name).mkdir(parents=True)
        (folder / one.name / "testbed.toml").write_text(text)
        (folder / one.name / "run.json").write_text(text_of_run(one))
    return folder


def test_builds_list_what_changed(equipoise, rebuilt, strict_json):
    """By the key; comments are no change. Every file's text can be had again."""
    found = strict_json(equipoise("logbook", rebuilt, "--builds", "--json").out)["builds"]
    assert [each["build"] for each in found] == ["A", "B", "C"]
    assert [each["changed"] for each in found] == [
        [], ["sliding_mass.x1.mass_g: 15.6 -> 16.6"], ["comments or layout alone"]]  # fmt: skip
    assert found[1]["text"] == (rebuilt / "run-1" / "testbed.toml").read_text()
    shown = equipoise("logbook", rebuilt, "--builds").out
    assert "mass_g: 15.6 -> 16.6" in " ".join(shown.split())


def test_builds_of_some_runs_keep_their_letters(equipoise, rebuilt, strict_json):
    late = ("--since", "2026-01-20", "--builds", "--json")
    found = strict_json(equipoise("logbook", rebuilt, *late).out)["builds"]
    assert [(each["build"], each["runs"]) for each in found] == [("B", 1), ("C", 1)]
    assert found[0]["changed"] == ["sliding_mass.x1.mass_g: 15.6 -> 16.6"]


# --- The report, set anew ------------------------------------------------------------------------


def test_a_report_set_anew_says_the_same(runs, equipoise, tmp_path):
    folder = tmp_path / "copy"
    shutil.copytree(folders(runs, "balance")[0], folder)
    page, words = (folder / "report.html").read_bytes(), text_of(folder / "report.pdf")
    (folder / "report.html").unlink()
    (folder / "report.pdf").unlink()
    assert equipoise("report", folder).code == 0
    assert (folder / "report.html").read_bytes() == page
    assert text_of(folder / "report.pdf") == words


def test_without_a_run_there_is_no_report(runs, equipoise, tmp_path):
    assert "report.json" in equipoise("report", tmp_path).err
    folder = tmp_path / "damaged"
    shutil.copytree(folders(runs, "identify")[0], folder)
    (folder / "report.json").write_text('{"title": 3')
    done = equipoise("report", folder)
    assert done.code == 2
    assert "equipoise/report/1" in " ".join(done.err.split())


def text_of(path):
    pages = pypdfium2.PdfDocument(path.read_bytes())
    return [page.get_textpage().get_text_range() for page in pages]


@pytest.mark.parametrize("kind", ["balance", "identify"])
def test_nothing_lies_beyond_the_paper(runs, kind):
    document = pypdfium2.PdfDocument((folders(runs, kind)[0] / "report.pdf").read_bytes())
    assert 2 < len(document) < 40
    for page in document:
        width, height = page.get_size()
        text = page.get_textpage()
        boxes = np.array([text.get_charbox(k) for k in range(text.count_chars())])
        observed = boxes[boxes[:, 2] > boxes[:, 0]]
        assert len(observed) > 20
        left, bottom, right, top = observed.T
        assert left.min() > 20
        assert bottom.min() > 15
        assert right.max() < width - 20
        assert top.max() < height - 15


@pytest.mark.parametrize("kind", ["balance", "identify"])
def test_a_report_states_its_provenance(runs, kind, record_file):
    folder = folders(runs, kind)[0]
    page = (folder / "report.html").read_text(encoding="utf-8")
    for section in ("Request", "Platform", "Mass properties", "What the data cannot show"):
        assert f"<h2>{section}</h2>" in page
    for word in ("command to repeat", "95 % interval", "sha256 of testbed.toml"):
        assert word in page
    assert ("Detection limit (95 %)" in page) == (kind == "balance")
    for path in (folder / "testbed.toml", folder / "recording.csv"):
        if path.exists():
            assert hashlib.sha256(path.read_bytes()).hexdigest() in page
    if kind == "identify":
        assert hashlib.sha256(record_file.read_bytes()).hexdigest() in page
