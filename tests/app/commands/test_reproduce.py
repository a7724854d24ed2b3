"""`equipoise reproduce`: every figure of a paper, one document, a verdict a row, and the items."""

import math
from functools import cache, partial
from pathlib import Path

import pytest

from equipoise.io.testbed.presets import read_preset
from equipoise.study.papers import ivanov_run, lee, review_run, table1
from equipoise.study.papers.items import ITEMS
from equipoise.study.papers.paper_row import Agreement
from tests.support import thorough

SHORT = 16.0  # s: the large slew has passed its singularity
FIGURES = {f"figure{k:02d}" for k in range(3, 19)}
WHOLE, JUDGED = lee.slew_from, lee.judged


@cache
def slew_of(start, seed):
    return WHOLE(read_preset("kau"), start, seed, SHORT)


@cache
def judged_of(start):
    return JUDGED(read_preset("kau"), start, slew_of(start, 3))


@pytest.fixture
def short(monkeypatch):
    """Short slews, worked out once."""
    monkeypatch.setattr(lee, "slew_from", lambda _, start, seed: slew_of(start, seed))
    monkeypatch.setattr(lee, "judged", lambda _bed, start, _slew: judged_of(start))


@pytest.mark.usefixtures("short")
def test_all_figures_and_one_document_are_written(equipoise, strict_json, tmp_path):
    done = equipoise("reproduce", "lee", "--seed", 3, "--json", "--out", "out")
    assert done.code == 0
    document = strict_json(done.out)
    assert strict_json((tmp_path / "out" / "reproduce.json").read_text("utf-8")) == document
    written = {path.name.split("_")[0] for path in (tmp_path / "out" / "figures").glob("*.svg")}
    assert written == FIGURES
    page = (tmp_path / "out" / "report.html").read_text("utf-8")
    assert "From (70, 30, -30) deg" in page
    assert all(f"Lee Fig. {k}." in page for k in range(3, 19))
    large, small = document["manoeuvres"]
    assert large["start_rad"] == pytest.approx([math.radians(a) for a in (70, 30, -30)])
    assert large["singular_s"] is not None
    assert small["singular_s"] is None
    assert set(large["estimates"]) == set(lee.COMPARED)
    for run in (large, small):
        assert all(
            run["least_sd"][name] <= run["least_sd_of_preset_sensors"][name] for name in lee.SOUGHT
        )


def test_an_unknown_paper_is_refused_with_those_that_are_known(equipoise):
    done = equipoise("reproduce", "leee")
    assert done.code == 2
    assert "lee" in done.err


@pytest.mark.usefixtures("short")
def test_the_table_has_truth_and_methods(equipoise):
    done = equipoise("reproduce", "lee", "--seed", 3)
    assert done.code == 0
    for word in ("truth", *lee.COMPARED, "J xx", "m r z", "Cramer-Rao", "singular from"):
        assert word in done.out


# --- The other papers, each with one seed ----------------------------------------------------


ROOT = Path(__file__).parents[3]
VERDICTS = {each.value for each in Agreement}


def checked(done, strict_json, paper):
    """Return the document of a reproduction, whose rows say all that a row has to."""
    assert done.code == 0, done.err
    document = strict_json(done.out)
    assert document["paper"] == paper
    for row in document["rows"]:
        assert row["agreement"] in VERDICTS
        assert row["place"]
        assert row["ours"]
        assert row["why"] or row["agreement"] != "differs"
    return document


@thorough.whole
def test_ivanov_has_all_figures_from_4_to_15(equipoise, strict_json, tmp_path, monkeypatch):
    """A hold of 20 s in place of half an hour."""
    monkeypatch.setattr(ivanov_run, "ivanov_run", partial(ivanov_run.ivanov_run, hold=20.0))
    done = equipoise("reproduce", "ivanov2021", "--runs", 1, "--seed", 3, "--json", "--out", "out")
    document = checked(done, strict_json, "ivanov2021")
    written = {path.name.split("_")[0] for path in (tmp_path / "out" / "figures").glob("*.svg")}
    assert written == {f"figure{k:02d}" for k in range(4, 16)}
    places = {row["place"] for row in document["rows"]}
    assert {"section 4", "Fig. 7", "Fig. 9a", "Fig. 13", "Figs. 14, 15", "section 5"} <= places


@thorough.whole
def test_the_review_has_its_null_vector_and_its_tables(equipoise, strict_json, monkeypatch):
    """By a method and a law of each row that a claim compares."""
    from equipoise.app.runs import comparison

    few = ("simplified", "kf_simplified", "ekf_6", "ukf_4")
    monkeypatch.setattr(comparison, "chosen_methods", lambda _: few)
    laws = {name: review_run.CARDS[name] for name in ("underactuated", "fully_actuated")}
    monkeypatch.setattr(review_run, "CARDS", laws)
    done = equipoise("reproduce", "dasilva2021", "--runs", 1, "--seed", 2, "--json")
    document = checked(done, strict_json, "dasilva2021")
    places = [row["place"] for row in document["rows"]]
    assert {"section 4.2, Fig. 3", "Table 2", "Table 3", "section 3"} == set(places)


def test_table_1_has_a_row_for_each_way_to_balance(equipoise, strict_json, monkeypatch):
    """Two of the thirteen, one of them balanced by hand; all of them in `make verify`."""
    two = tuple(entry for entry in table1.TABLE1 if entry.preset in ("unam", "aalto"))
    monkeypatch.setattr(table1, "TABLE1", two)
    done = equipoise("reproduce", "table1", "--runs", 1, "--json")
    document = checked(done, strict_json, "table1")
    assert len(document["rows"]) == 3


def test_items_and_papers_are_listed(equipoise, strict_json):
    done = equipoise("reproduce", "--json")
    assert done.code == 0
    document = strict_json(done.out)
    assert set(document["papers"]) == {"ivanov2021", "dasilva2021", "lee", "table1"}
    assert len(document["items"]) == 75


def test_each_item_names_a_test_or_a_decision_that_exists():
    names = [item.name for item in ITEMS]
    for letter, count in (("I", 25), ("R", 36), ("L", 14)):
        assert [name for name in names if name[0] == letter] == [
            f"{letter}{k}" for k in range(1, count + 1)
        ]
    missing = [item.name for item in ITEMS if not (ROOT / item.shown_by).is_file()]
    assert missing == []


def test_at_most_three_items_are_decided_against():
    assert sum(not item.works for item in ITEMS) <= 3


def test_a_folder_without_a_paper_is_refused(equipoise):
    done = equipoise("reproduce", "--out", "out")
    assert done.code == 2
    assert "ivanov2021" in done.err
