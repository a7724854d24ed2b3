"""`equipoise compare --methods`: tables, one document, a line a run, a page that stands alone."""

import csv
import re
from dataclasses import replace
from html.parser import HTMLParser

import pytest

from equipoise.app.runs import comparison as comparison_runs
from equipoise.estimation.methods.registry import METHODS
from equipoise.study.method_run import JUDGED, Cost
from tests.study.test_recommend import compared as compared_laws
from tests.support.synthetic_runs import comparison, made_up

MOVE = ("--move", "15: x1=50 z1=-50 z2=-50")
LITTLE = ("compare", "sputnix", "--methods", "--only", "trajectory,ekf_12", "--only", "tracker",
          "--runs", 2, "--duration-s", 30, *MOVE, "--workers", 1)  # fmt: skip
WEIGHT = Cost(0.02, 3_000_000)


class Balanced(HTMLParser):
    """Fails on a tag that is not closed in its place."""

    def __init__(self) -> None:
        super().__init__()
        self.open: list[str] = []

    def handle_starttag(self, tag, attrs):
        if tag not in {"meta", "img", "br"}:
            self.open.append(tag)

    def handle_endtag(self, tag):
        assert self.open.pop() == tag


def reported_of(done):
    """What was printed, lines joined."""
    return " ".join(done.out.split())


def test_methods_are_compared_and_written_down(equipoise, strict_json, tmp_path):
    done = equipoise(*LITTLE, "--json", "--out", "here")
    document = strict_json(done.out)
    folder = tmp_path / "here"
    assert strict_json((folder / "compare.json").read_text("utf-8")) == document
    assert document["parameters"] == list(JUDGED)
    assert document["seeds"] == [1, 2]
    assert document["moves"][0]["targets_m"]["z1"] == pytest.approx(-0.05)
    reported = {method["method"]: method for method in document["methods"]}
    assert list(reported) == ["trajectory", "ekf_12", "tracker"]
    assert reported["ekf_12"]["refused"] == 2
    assert reported["trajectory"]["memory_bytes"] > 1e5
    assert done.code == (0 if document["recommended"]["com"]["name"] else 1)
    with (folder / "methods.csv").open(encoding="utf-8", newline="") as file:
        rows = [row for row in csv.DictReader(file) if row["method"] == "trajectory"]
    assert [row["seed"] for row in rows] == ["1", "2"]
    squares = [float(row["com_z_error_um"]) ** 2 for row in rows]
    assert reported["trajectory"]["rmse"][2] == pytest.approx(
        1e-6 * (sum(squares) / 2) ** 0.5, rel=1e-4
    )
    page = (folder / "report.html").read_text("utf-8")
    assert "http" not in re.sub(r"data:image/svg[^']*", "", page)
    parser = Balanced()
    parser.feed(page)
    assert parser.open == []
    assert page.count("src='data:image/svg+xml") == len(list(folder.glob("figures/*.svg"))) == 2
    assert "report.html" in done.err


# --- made-up runs ------------------------------------------------------------------------------


def honest(method, error, seeds=range(20), **more):
    """Runs of errors of one sign or the other, with an sd of as much."""
    sizes = [error] * 3
    return [made_up([s * (-1) ** seed for s in sizes], sizes, [1.0] * 3, method=method, seed=seed,
                    cost=WEIGHT, **more) for seed in seeds]  # fmt: skip


@pytest.fixture
def without_work(monkeypatch):
    """Three methods in place of work: one good, one better that fails once, one refused."""
    failing = honest("smoother", 1.0)
    failing[3] = replace(failing[3], ending="unusable", why="Not so. It did not settle.")
    refused = [made_up(ending="refused", why="No gyro.", method="ekf_12", seed=k)
               for k in range(20)]  # fmt: skip
    runs = [*refused, *failing, *honest("tracker", 2.0, settled=12.0)]
    monkeypatch.setattr(comparison_runs, "run_methods", lambda *_: comparison(runs))
    laws = compared_laws(("pid", 8e-6, 0, 0))
    monkeypatch.setattr(comparison_runs, "run", lambda *_: laws)


@pytest.mark.usefixtures("without_work")
def test_the_table_has_honest_methods_first_and_reasons_below(equipoise):
    done = equipoise("compare", "sputnix", "--methods")
    assert done.code == 0
    lines = [line.split() for line in done.out.splitlines()]
    names = [line[0] for line in lines if line and line[0] in METHODS][:3]
    assert names == ["tracker", "smoother", "ekf_12"]
    # RMSE / bound 2; no inertia; errors of both signs: no bias; all hold; 20 ms, 3 MB.
    tracker = next(line for line in lines if line and line[0] == "tracker")
    assert tracker[1:4] == ["2", "-", "0"]
    assert tracker[4:6] == ["100", "%"]
    cost = [line.split() for line in done.out.splitlines() if line.startswith("tracker")][-1]
    assert cost == ["tracker", "20", "3", "12"]
    assert "Failed: ekf_12 (20): No gyro." in reported_of(done)
    assert "Failed: smoother (1): Not so. It did not settle." in reported_of(done)
    assert "For the centre of mass take tracker: RMSE 2 times the bound" in reported_of(done)


@pytest.mark.usefixtures("without_work")
def test_table_2_of_the_review_is_measured(equipoise):
    done = equipoise("compare", "sputnix", "--methods")
    assert "As the review's Table 2, measured on Sputnix mock-up" in done.out
    row = next(line for line in done.out.splitlines() if line.startswith("EKF [33]")).split()
    # Of tracker and ekf_12: half of the runs failed; com settles after 12 s.
    assert row[-5:] == ["12", "50", "%", "0", "%"]
    assert "EKF [33]: ekf_12, tracker" in reported_of(done)


@pytest.mark.usefixtures("without_work")
def test_methods_and_laws_go_into_one_document(equipoise, strict_json, tmp_path):
    done = equipoise("compare", "reference-table", "--methods", "--laws", "--json", "--out", "here")
    document = strict_json(done.out)
    assert document["schema"] == "equipoise/compare/2"
    assert document["laws"]["recommended"]["name"] == "pid"
    assert document["methods"]["recommended"]["com"]["name"] == "tracker"
    written = {path.name for path in (tmp_path / "here").iterdir()}
    assert written >= {"report.html", "report.pdf", "compare.json", "methods.csv", "laws.csv"}
    assert (tmp_path / "here" / "figures" / "laws_torque.svg").exists()
    page = (tmp_path / "here" / "report.html").read_text("utf-8")
    assert page.index("take tracker") < page.index("<h2>")
    for words in ("As the review&#x27;s Table 3", "below 50 uN m or 1 um [9]", "Take pid"):
        assert words in page


@pytest.mark.usefixtures("without_work")
def test_table_3_keeps_rows_of_the_review_that_no_law_ran_for(equipoise):
    done = equipoise("compare", "reference-table", "--laws")
    lines = done.out.splitlines()
    assert any(line.startswith("manual [10,19,26]") for line in lines)
    row = next(line for line in lines if line.startswith("PID and L1"))
    assert "pid" in row
    assert "8" in row.split()


def test_it_ends_with_1_when_nobody_can_be_recommended(equipoise, monkeypatch):
    runs = honest("tracker", 2.0)[:19] + [made_up([30.0], [1.0], method="tracker", seed=19)]
    monkeypatch.setattr(comparison_runs, "run_methods", lambda *_: comparison(runs))
    done = equipoise("compare", "sputnix", "--methods")
    assert done.code == 1
    assert "no method can be recommended" in reported_of(done)
    assert "tracker is off by more than 5 sd in 1 of 20 runs" in reported_of(done)


def test_an_open_scale_is_reported(equipoise, monkeypatch):
    runs = [made_up((), (), [float("inf")] * 3, method="trajectory", seed=k) for k in range(3)]
    monkeypatch.setattr(comparison_runs, "run_methods", lambda *_: comparison(runs))
    done = equipoise("compare", "sputnix", "--methods")
    assert done.code == 1
    assert "give --move, --hold or --prior" in reported_of(done)


def test_names_go_to_their_kind():
    only = ("trajectory, pid", "tracker")
    assert comparison_runs.by_kind(only, methods=True, laws=True) == (
        ["trajectory", "tracker"],
        ["pid"],
    )
    assert comparison_runs.by_kind((), methods=True, laws=False) == ([], [])
    assert comparison_runs.chosen_methods([]) == tuple(METHODS)


WRONG = {
    "unknown": (["--methods", "--only", "trajektory"], "did you mean 'trajectory'?"),
    "a law": (["--methods", "--only", "pid"], "--only"),
    "a method": (["--laws", "--only", "trajectory"], "--only"),
    "a mass": (["--methods", "--move", "5: q=1"], "--move"),
    "no time": (["--methods", "--duration-s", "0"], "--duration-s"),
    "a late move": (
        ["--methods", "--duration-s", "9", "--move", "10: x1=1", "--workers", "1"],
        "moves",
    ),
    "a held name": (["--methods", "--hold", "mass"], "--hold"),
    "neither": ([], "--methods or --laws"),
}


@pytest.mark.parametrize(("words", "wanted"), WRONG.values(), ids=WRONG.keys())
def test_wrong_usage_is_reported(equipoise, words, wanted):
    done = equipoise("compare", "sputnix", *words)
    assert (done.code, done.out) == (2, "")
    assert wanted in done.err
