"""`equipoise laws` lists what there is; `balance --law` runs one, `compare --laws` many."""

import csv
import sys

import numpy as np
import pytest

from equipoise.app.runs import comparison
from equipoise.io.testbed.presets import read_preset
from equipoise.model.law_card import NEEDS
from equipoise.procedure.balancing.balance import BalanceOptions
from equipoise.procedure.balancing.catalogue import CARDS, OWN
from equipoise.study.compare_laws import Refusal, compared
from equipoise.study.law_run import LawRun, Task
from tests.support.outcomes import verdict as verdict_of

PID = CARDS["pid"]
NEEDLESS = "underactuated"  # masses alone, and soon begun


def reported_of(done):
    """All that was printed, its lines joined."""
    return " ".join(done.out.split())


def test_every_law_is_listed(equipoise):
    done = equipoise("laws")
    assert done.code == 0
    first = {line.split(" ")[0] for line in done.out.splitlines()}
    assert set(CARDS) <= first


def test_one_law_is_described_in_full(equipoise):
    done = equipoise("laws", "pid")
    assert done.code == 0
    for said in (PID.idea, PID.source, PID.leaves, PID.stable, *(NEEDS[n] for n in PID.needs)):
        assert said in reported_of(done)
    assert f"{PID.period:g} s between steps" in reported_of(done)


def test_a_law_that_does_not_exist_names_the_nearest(equipoise):
    for words in (("laws", "l1adaptive"), ("balance", "reference-table", "--law", "l1adaptive"),
                  ("compare", "reference-table", "--laws", "--only", "l1adaptive")):  # fmt: skip
        done = equipoise(*words)
        assert (done.code, done.out) == (2, "")
        assert "did you mean 'l1_adaptive'" in done.err


def test_cards_are_json(equipoise, strict_json):
    document = strict_json(equipoise("laws", "--json").out)
    assert document["schema"] == "equipoise/laws/2"
    assert [card["name"] for card in document["laws"]] == list(CARDS)
    one = strict_json(equipoise("laws", "pid", "--json").out)["laws"]
    assert [card["needs"] for card in one] == [list(PID.needs)]


def test_laws_on_a_testbed_say_what_they_lack_and_how_long_they_should_take(equipoise, strict_json):
    """The heavy table of gyros: minutes; the mock-up has neither gyro nor wheels."""
    done = equipoise("laws", "--testbed", "tas2")
    assert done.code == 0
    line = next(row for row in done.out.splitlines() if row.startswith("fully_actuated"))
    document = strict_json(equipoise("laws", "--testbed", "tas2", "--json").out)
    by_law = {each["law"]: each for each in document["prospects"]}
    assert list(by_law) == list(CARDS)
    expected = by_law["fully_actuated"]["expected_s"]
    assert 200 < expected < 600
    assert f"expected duration {expected / 60:.1f} min" in line
    assert by_law["planar_magnetic"]["missing"] == ["magnetorquers"]
    one = reported_of(equipoise("laws", "fully_actuated", "--testbed", "sputnix"))
    assert f"on {read_preset('sputnix').name} lacks {NEEDS['momentum']}, {NEEDS['gyro']}" in one
    assert CARDS["fully_actuated"].idea in one


def test_without_a_testbed_a_document_has_no_prospects(equipoise, strict_json):
    assert "prospects" not in strict_json(equipoise("laws", "pid", "--json").out)


@pytest.mark.parametrize("command", ["balance", "compare"])
@pytest.mark.parametrize(("law", "lacks"), [("fully_actuated", "momentum"), ("pid", "gyro")])
def test_a_testbed_without_the_devices_is_refused_in_one_sentence(equipoise, command, law, lacks):
    """The mock-up has masses and a camera."""
    requested = {"balance": ("--law", law), "compare": ("--laws", "--only", law)}[command]
    done = equipoise(command, "sputnix", *requested)
    assert (done.code, done.out) == (2, "")
    lines = [line for line in done.err.splitlines() if not line.endswith("...")]
    assert len(lines) == 1
    assert f"law {law}: found a testbed without" in lines[0]
    assert NEEDS[lacks] in lines[0]


def test_a_law_balances_and_its_steps_are_json(equipoise, strict_json):
    words = ("reference-table", "--law", NEEDLESS, "--json", "--max-time-s", "60", "--out", "here")
    done = equipoise("balance", *words)
    document = strict_json(done.out)
    assert done.code == (0 if document["verdict"]["passed"] else 1)
    kinds = [step["kind"] for step in document["steps"]]
    assert kinds[-2] == "control"
    assert kinds[-1] in ("verify", "stop")
    said = [step["sentence"] for step in document["steps"] if step["kind"] == "control"]
    assert NEEDLESS in said[-1]
    assert "report.html" in done.err


def test_the_same_seed_gives_the_same_run(equipoise, strict_json):
    words = ("balance", "reference-table", "--law", NEEDLESS, "--json", "--max-time-s", "50")
    first, again = (strict_json(equipoise(*words, "--seed", 7).out) for _ in range(2))
    assert first["verdict"] == again["verdict"]
    assert first["truth"] == again["truth"]


def test_a_hold_requires_a_law_whose_output_masses_can_follow(equipoise):
    done = equipoise("balance", "reference-table", "--law", "pid", "--hold-min", "1")
    assert (done.code, done.out) == (2, "")
    assert f"{OWN.name} or momentum_buildup" in done.err


# --- compare ---------------------------------------------------------------------------------

LITTLE = ("compare", "reference-table", "--laws", "--only", "pid", "--runs", "1", "--max-time-s",
          "60", "--workers", "1")  # fmt: skip


def test_a_comparison_is_one_document_and_a_line_a_run(equipoise, strict_json, tmp_path):
    done = equipoise(*LITTLE, "--json", "--out", "here")
    document = strict_json(done.out)
    assert strict_json((tmp_path / "here" / "compare.json").read_text("utf-8")) == document
    (law,) = document["laws"]
    assert (law["law"], law["runs"], document["seeds"]) == ("pid", 1, [1])
    assert law["torque_N_m"]["median"] == law["torque_N_m"]["most"] > 0
    assert done.code == (0 if law["within"] else 1)
    with (tmp_path / "here" / "laws.csv").open(encoding="utf-8", newline="") as file:
        (row,) = csv.DictReader(file)
    assert (row["law"], row["seed"]) == ("pid", "1")
    assert float(row["torque_uN_m"]) == pytest.approx(1e6 * law["torque_N_m"]["median"], rel=1e-4)
    aside = 1e-6 * np.hypot(float(row["offset_x_um"]), float(row["offset_y_um"]))
    assert aside == pytest.approx(law["aside_m"]["median"], rel=1e-4)
    assert float(row["time_s"]) == pytest.approx(law["time_s"]["median"], rel=1e-4)


SAID = verdict_of(False)


def made_up(law, seed, torque):
    offset, followed = np.array([3e-6, 4e-6, -9e-6]), torque / 2 if law == "l1_adaptive" else None
    return LawRun(law, seed, offset, torque, followed, 1e-3, 90.0, 0.02, False, SAID)


@pytest.fixture
def without_work(monkeypatch):
    """Findings in place of runs: pid leaves 5 uN m and more, l1_adaptive 2, another is refused."""

    torques = {"pid": 5e-6, "l1_adaptive": 2e-6}

    def finding(task):
        if task.law not in torques:
            return Refusal(task.law, "it does not like it")
        return made_up(task.law, task.seed, torques[task.law] * task.seed)

    def found(contest, cards, _spread):
        tasks = [Task(card.name, contest.scene.testbed, seed, BalanceOptions(), 60.0, 0.3)
                 for seed in contest.seeds for card in cards]  # fmt: skip
        return compared(tasks, cards, contest.goal.required, lambda *_: map(finding, tasks))

    monkeypatch.setattr(comparison, "run", found)


THREE = ("compare", "reference-table", "--laws", "--only", "pid", "--only", "slew_and_measure",
         "--only", "l1_adaptive", "--runs", "3")  # fmt: skip


@pytest.mark.usefixtures("without_work")
def test_the_table_has_the_least_torque_first_and_refusals_below(equipoise):
    done = equipoise(*THREE)
    assert done.code == 0
    assert done.out.index("l1_adaptive") < done.out.index("pid")
    assert "slew_and_measure was refused: it does not like it" in reported_of(done)
    assert "3 platforms of reference table" in reported_of(done)
    pid = next(line for line in done.out.splitlines() if line.startswith("pid")).split()
    # 5 um aside, 9 um high; 5, 10 and 15 uN m, of which two are within 10; no mass follows.
    assert pid[1:8] == ["5", "(5)", "9", "(9)", "10", "(14.5)", "-"]
    assert "67 %" in done.out
    other = next(line for line in done.out.splitlines() if line.startswith("l1")).split()
    assert other[5:9] == ["4", "(5.8)", "2", "(2.9)"]


@pytest.mark.usefixtures("without_work")
@pytest.mark.parametrize(("required", "code"), [("3.1e-6", 0), ("2.9e-6", 1)])
def test_it_ends_with_1_when_no_law_reaches_the_torque(equipoise, required, code):
    """The better law leaves 2, 4 and 6 uN m standing, and half of it following."""
    assert equipoise(*THREE, "--require-torque", required).code == code


@pytest.mark.usefixtures("without_work")
def test_it_ends_with_1_when_every_law_that_reaches_it_passed_what_is_wrong(equipoise, monkeypatch):
    """As the last line says: no law is to be recommended, however little torque it leaves."""
    monkeypatch.setattr(sys.modules[__name__], "SAID", verdict_of(True))
    done = equipoise(*THREE)
    assert "No law can be recommended" in reported_of(done)
    assert done.code == 1


def test_a_testbed_that_suits_no_law_is_refused(equipoise):
    """Gyros and sensors, and no mass to move."""
    done = equipoise("compare", "kau", "--laws", "--runs", "1")
    assert (done.code, done.out) == (2, "")
    assert "devices of none of the laws" in done.err


WRONG = {
    "nothing to compare": (["compare", "reference-table"], "--laws"),
    "no runs": (["compare", "reference-table", "--laws", "--runs", "0"], "--runs"),
    "no worker": (["compare", "reference-table", "--laws", "--workers", "0"], "--workers"),
    "no torque": (["compare", "reference-table", "--laws", "--require-torque", "0"], "--require"),
    "no testbed": (["compare", "reference", "--laws"], "reference-table"),
}


@pytest.mark.parametrize(("words", "wanted"), WRONG.values(), ids=WRONG.keys())
def test_wrong_usage_is_reported_in_one_sentence(equipoise, words, wanted):
    done = equipoise(*words)
    assert (done.code, done.out) == (2, "")
    assert wanted in done.err


def test_all_that_suit_the_testbed_are_taken_when_none_is_named():
    """The mock-up has neither gyro nor wheels."""
    suiting = [card.name for card in comparison.chosen(read_preset("sputnix"), ())]
    assert suiting == [OWN.name, "ivanov_25s"]
    table = [card.name for card in comparison.chosen(read_preset("reference-table"), ())]
    assert table == list(CARDS)
