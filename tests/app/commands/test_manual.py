"""`balance --manual`: a simulated person, and a real one's session from recording to recording."""

import tomllib
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from equipoise.io.documents.manual_session import Piles
from equipoise.io.recording.recording_file import write_recording
from equipoise.io.testbed.presets import read_preset
from equipoise.model.units import UM
from equipoise.model.weights import unloaded
from equipoise.procedure.balancing.balance_manually import HandOptions, balance_by_hand
from equipoise.simulation.hands import SimulatedHands

BED = read_preset("weights-by-hand")
WORDS = ["balance", "weights-by-hand", "--manual"]


@pytest.fixture(scope="module")
def swings(tmp_path_factory):
    """Return the files of every swing that a simulated person made, and the steps it led to."""
    folder = tmp_path_factory.mktemp("swings")
    hands, files, steps = SimulatedHands(BED, 1), [], []
    for step in balance_by_hand(hands, HandOptions()):
        if step.recording is not None and step.kind == "measurement":
            files.append(folder / f"run{len(files) + 1}.csv")
            write_recording(step.recording, files[-1])
        steps.append(step)
    return files, steps


def reported(out: str) -> str:
    """Return a text without its line ends and the spaces of its tables."""
    return " ".join(out.split())


def test_a_simulated_person_balances_and_it_is_written_down(equipoise, tmp_path, strict_json):
    done = equipoise(*WORDS, "--seed", "1", "--out", "out")
    assert done.code == 0
    assert "Add " in done.out
    assert "Passed: the centre of mass is at" in done.out
    assert "da Silva et al. 2021" in done.out
    assert {p.name for p in (tmp_path / "out").iterdir()} >= {
        "report.html", "report.pdf", "balance.json", "testbed.toml", "run.json",
    }  # fmt: skip
    assert (tmp_path / "out" / "figures" / "rounds_com.svg").exists()
    document = strict_json((tmp_path / "out" / "balance.json").read_text(encoding="utf-8"))
    assert document["verdict"]["passed"]
    placing = next(s["placing"] for s in document["steps"] if s["kind"] == "place")
    assert placing["handled"] > 0
    off = np.array(document["truth"]["com_m"]) - [0, 0, -100 * UM]
    assert np.all(np.abs(off) <= np.array([2, 2, 3]) * UM)


def test_a_session_resumed_with_every_recording_is_the_run_in_one_go(equipoise, swings):
    """The same placings and the same verdict, from files written and read again."""
    files, steps = swings
    first = equipoise(*WORDS, "--session", "s.toml")
    assert first.code == 0
    assert "Hold the platform still" in first.out
    assert "--recording run1.csv" in first.out
    for file in files:
        last = equipoise(*WORDS, "--session", "s.toml", "--recording", file)
        assert last.code == 0
    placed = [step.placing.after for step in steps if step.placing is not None]
    kept = tomllib.loads(Path("s.toml").read_text(encoding="utf-8"))["round"]
    assert [each.get("placed") for each in kept] == [*map(Piles(BED).lines, placed), None]
    assert reported(steps[-1].verdict.sentence) in reported(last.out)
    again = equipoise(*WORDS, "--session", "s.toml")
    assert reported(steps[-1].verdict.sentence) in reported(again.out)
    over = equipoise(*WORDS, "--session", "s.toml", "--recording", files[0])
    assert over.code == 2


def test_the_session_file_may_be_corrected_to_the_actual_placement(equipoise, swings):
    """A pile that was not put on, and is taken out of the file: the next recording fits."""
    files, steps = swings
    equipoise(*WORDS, "--session", "s.toml", "--recording", files[0])
    text = Path("s.toml").read_text(encoding="utf-8")
    line = next(line for line in text.splitlines() if line.startswith("placed"))
    pile = line.split('"')[1]
    Path("s.toml").write_text(text.replace(f'"{pile}", ', ""), encoding="utf-8")
    hands = SimulatedHands(BED, 1)
    hands.swing()
    lines = [each for each in Piles(BED).lines(steps[2].placing.after) if each != pile]
    hands.place(Piles(BED).loading(lines, "here"))
    write_recording(hands.swing(), "next.csv")
    done = equipoise(*WORDS, "--session", "s.toml", "--recording", "next.csv")
    assert done.code == 0
    assert "is not where" not in reported(done.out)


def test_lines_of_piles_read_back_as_the_same_loading():
    loading = unloaded(BED.grids, BED.weights)
    loading[[0, 7, 200], 0] = (3, 1, 8)
    piles = Piles(BED)
    np.testing.assert_array_equal(piles.loading(piles.lines(loading), "here"), loading)


SESSION = """testbed = "weights-by-hand"
target_um = [0.0, 0.0, -100.0]
tolerance_um = [2.0, 2.0, 3.0]
max_rounds = 4
"""
ROUND = """
[[round]]
recording = "run1.csv"
placed = ["{pile}"]
"""
WRONG = {
    "recording without a session": (["--recording", "run1.csv"], "--session FILE"),
    "session without manual": (None, "--manual"),
    "a law besides": (["--law", "pid"], "manual balancing moves nothing by itself"),
    "moves besides": (["--max-moves", "2"], "manual balancing moves nothing by itself"),
    "reading nothing": (["--from-s", "3"], "--recording FILE"),
    "no rounds": (["--max-rounds", "0"], "a number above 0"),
    "another target": (
        ["--session", "s.toml", "--target-um", "0", "0", "-50"],
        "with which the session started",
    ),
    "other rounds": (
        ["--session", "s.toml", "--max-rounds", "5"],
        "with which the session started",
    ),
    "no such recording": (["--session", "s.toml", "--recording", "no.csv"], "no.csv"),
}


@pytest.mark.parametrize(("words", "wanted"), WRONG.values(), ids=WRONG.keys())
def test_wrong_usage_is_reported_in_one_sentence(equipoise, words, wanted):
    Path("s.toml").write_text(SESSION, encoding="utf-8")
    before = Path("s.toml").read_text(encoding="utf-8")
    done = equipoise(*WORDS, *words) if words else equipoise(*WORDS[:2], "--session", "s.toml")
    assert done.code == 2
    assert wanted in reported(done.err)
    assert "Traceback" not in done.err
    assert Path("s.toml").read_text(encoding="utf-8") == before


@pytest.mark.parametrize(
    ("pile", "wanted"),
    [("three washers", "a line such as"), ("9" * 20 + " x washer at deck:A1", "a line such as"),
     ("3 x bolt at deck:A1", "'bolt'"),
     ("3 x washer at deck:Z9", "'deck:Z9'")],
)  # fmt: skip
def test_an_impossible_pile_is_reported_with_its_round(equipoise, swings, pile, wanted):
    text = SESSION + ROUND.format(pile=pile).replace("run1.csv", str(swings[0][0].as_posix()))
    Path("s.toml").write_text(text, encoding="utf-8")
    done = equipoise(*WORDS, "--session", "s.toml")
    assert done.code == 2
    assert wanted in reported(done.err)
    assert "round[1].placed" in reported(done.err)


def test_a_recording_that_is_there_already_or_has_changed_is_refused(equipoise, swings):
    file = swings[0][0]
    Path("run1.csv").write_bytes(file.read_bytes())
    equipoise(*WORDS, "--session", "s.toml", "--recording", "run1.csv")
    twice = equipoise(*WORDS, "--session", "s.toml", "--recording", "run1.csv")
    assert twice.code == 2
    assert "the recording of round 1 again" in reported(twice.err)
    lines = file.read_text(encoding="utf-8").splitlines()
    Path("run1.csv").write_text("\n".join(lines[:-5]) + "\n", encoding="utf-8")
    changed = equipoise(*WORDS, "--session", "s.toml")
    assert changed.code == 2
    assert "as it was when it was added" in reported(changed.err)


def test_a_platform_without_weights_is_sent_to_the_preset(equipoise):
    done = equipoise("balance", "sputnix", "--manual")
    assert done.code == 2
    assert "weights-by-hand" in reported(done.err)


def test_a_stock_that_does_not_suffice_ends_with_1(equipoise, tmp_path):
    from equipoise.io.testbed.testbed_file import write_testbed

    few = replace(BED, weights=(replace(BED.weights[0], count=3),))
    write_testbed(few, tmp_path / "few.toml")
    done = equipoise("balance", "few.toml", "--manual", "--max-rounds", "1", "--seed", "1")
    assert done.code == 1
    assert "do not reach the target" in reported(done.out)
