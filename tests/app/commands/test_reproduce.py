"""`equipoise reproduce lee`: every figure of the paper, one document, and a table."""

import math
from functools import cache

import pytest

from equipoise.io.testbed.presets import read_preset
from equipoise.study.papers import lee

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
