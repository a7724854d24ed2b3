"""`equipoise identify` of several recordings and the series that it takes, as people run them."""

import json
from pathlib import Path

import pytest

from equipoise.app.cli import run
from equipoise.app.text.blocks import Claim, Figure, document_of_text
from equipoise.app.text.json_document import finite

SHORT = ("--duration-s", "40", "--move", "20: z1=-50", "--move", "30: x1=-10")


@pytest.fixture(scope="module")
def runs(tmp_path_factory):
    """Three runs of one platform, and one of another."""
    folder = tmp_path_factory.mktemp("runs")
    assert run(["simulate", "sputnix", "--series", "3", "--out", str(folder), *SHORT]) == 0
    other = folder / "other.csv"
    assert run(["simulate", "sputnix", "--seed", "8", "--out", str(other), *SHORT]) == 0
    return sorted(folder.glob("run_*.csv")), other


def identify(equipoise, files, *words):
    return equipoise("identify", *files, "--testbed", "sputnix", *words)


def test_tables_and_the_two_sentences_that_count(runs, equipoise):
    done = identify(equipoise, runs[0])
    assert done.code == 0
    for part in (
        "Runs, each by itself",
        "run_03.csv",
        "Scatter over the runs",
        "sd between runs",
        "Centre of mass and inertia about P, masses at home",
        "3 runs are fitted jointly",
        "Passed: 3 runs scatter no more than their intervals allow",
    ):
        assert part in " ".join(done.out.split()), part


def test_the_document_holds_all_runs_and_the_report_the_box_plots(
    runs, equipoise, strict_json, tmp_path
):
    done = identify(equipoise, runs[0], "--json", "--out", "out")
    document = strict_json(done.out)
    assert document["schema"] == "equipoise/identify_runs/1"
    assert document["verdict"]["code"] == "runs_agree"
    assert [Path(each["name"]).name for each in document["runs"]] == [f.name for f in runs[0]]
    joint = {p["name"]: p["sd"] for p in document["estimate"]["parameters"]}
    for each in document["runs"]:
        assert all(p["sd"] > joint[p["name"]] for p in each["estimate"]["parameters"][:9])
    report = document_of_text((tmp_path / "out" / "report.json").read_text("utf-8"), "report")
    blocks = [block for section in report.sections for block in section.blocks]
    figures = [block.name for block in blocks if isinstance(block, Figure)]
    assert figures == ["figure09_runs"]
    assert (tmp_path / "out" / "figures" / "figure09_runs.svg").exists()
    claims = [block.text for block in blocks if isinstance(block, Claim)]
    assert claims == [document["estimate"]["outcome"]["sentence"], document["verdict"]["sentence"]]
    kept = json.loads((tmp_path / "out" / "identify_runs.json").read_text("utf-8"))
    assert kept == finite(document)


def test_a_run_of_another_platform_fails_and_is_named(runs, equipoise, strict_json):
    done = identify(equipoise, [*runs[0], runs[1]], "--json")
    document = strict_json(done.out)
    assert done.code == 1
    assert (document["verdict"]["code"], document["verdict"]["passed"]) == ("runs_scatter", False)
    assert document["estimate"]["outcome"]["code"] == "model_rejected"
    assert document["estimate"]["parameters"] == []
    assert len(document["runs"]) == 4


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (("--method", "momentum_laboratory"), "momentum_laboratory' with several recordings"),
        (("--plan", "plan.toml"), "--plan: found several recordings"),
    ],
)
def test_what_is_of_one_recording_is_refused(runs, equipoise, words, said):
    done = identify(equipoise, runs[0], *words)
    assert (done.code, done.out) == (2, "")
    assert said in " ".join(done.err.split())


def test_the_same_recording_twice_is_refused(runs, equipoise):
    done = identify(equipoise, [runs[0][0], runs[0][0]])
    assert done.code == 2
    assert "the same rows as" in " ".join(done.err.split())


def test_a_recording_of_another_bench_is_refused_by_its_name(runs, equipoise, tmp_path):
    text = runs[0][1].read_text("utf-8").replace("mass_x1_mm", "mass_left_mm")
    (tmp_path / "strange.csv").write_text(text, "utf-8")
    done = identify(equipoise, [runs[0][0], "strange.csv"])
    assert done.code == 2
    assert "strange.csv, header: found mass 'left'" in " ".join(done.err.split())


def test_a_series_needs_a_folder_and_writes_all_or_nothing(equipoise, tmp_path):
    done = equipoise("simulate", "sputnix", "--series", "2", "--out", "run.csv")
    assert done.code == 2
    assert "a folder for the series" in " ".join(done.err.split())
    done = equipoise("simulate", "sputnix", "--series", "0", "--out", "none")
    assert done.code == 2
    words = ("--duration-s", "10", "--move", "5: x1=-10", "--move", "3: x1=0")
    done = equipoise("simulate", "sputnix", "--series", "2", "--out", "none", *words)
    assert done.code == 2
    assert not list(tmp_path.iterdir())


def test_a_series_of_balancings_in_one_folder(equipoise, strict_json, tmp_path):
    """The first run is that of its seed alone; all are of one platform."""
    done = equipoise("balance", "sputnix", "--series", "2", "--seed", "3", "--max-moves", "1",
                     "--json", "--out", "balanced")  # fmt: skip
    document = strict_json(done.out)
    assert [each["seed"] for each in document["runs"]] == [3, 4]
    passed = all(each["verdict"]["passed"] for each in document["runs"])
    assert (document["verdict"]["passed"], done.code) == (passed, 0 if passed else 1)
    folder = tmp_path / "balanced"
    assert {f.name for f in folder.glob("run_*.csv")} == {"run_01.csv", "run_02.csv"}
    single = equipoise("balance", "sputnix", "--seed", "3", "--max-moves", "1", "--json")
    verdict = strict_json(single.out)["verdict"]
    assert document["runs"][0]["verdict"] == verdict


@pytest.mark.parametrize("words", [("--bench",), ("--manual",)])
def test_a_series_of_balancings_is_simulated_and_by_moving_masses(equipoise, words):
    done = equipoise("balance", "sputnix", "--series", "2", *words)
    assert (done.code, done.out) == (2, "")
    assert "--series" in done.err
