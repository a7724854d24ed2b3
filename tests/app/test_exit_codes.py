"""0: done and passed; 1: done and not; 2: wrong use; 130: by hand. Errors are one line."""

import signal
import subprocess
import sys

import numpy as np
import pytest

from equipoise.app.runs import balancing
from equipoise.model.step import Step
from equipoise.simulation.bench import SimulatedBench
from tests.support.outcomes import OBSERVED
from tests.support.outcomes import verdict as verdict_of

WRONG_USE = {
    "unknown command": ["frobnicate"],
    "unknown option": ["new", "sputnix", "--fource"],
    "missing option": ["simulate", "sputnix"],
    "not a number": ["simulate", "sputnix", "--out", "x.csv", "--duration-s", "long"],
    "negative duration": ["simulate", "sputnix", "--out", "x.csv", "--duration-s", "-3"],
    "duration without end": ["simulate", "sputnix", "--out", "x.csv", "--duration-s", "inf"],
    "negative seed": ["simulate", "sputnix", "--out", "x.csv", "--seed", "-1"],
    "seed with a fraction": ["simulate", "sputnix", "--out", "x.csv", "--seed", "1.5"],
    "moves with a fraction": ["balance", "sputnix", "--max-moves", "2.5"],
    "runs by words": ["compare", "reference-table", "--laws", "--runs", "many"],
    "unknown preset": ["new", "sputnik"],
    "neither file nor preset": ["balance", "sputnik"],
    "two numbers for three": ["balance", "sputnix", "--target-um", "1", "2"],
    "no tolerance": ["balance", "sputnix", "--tolerance-um", "0", "1", "1"],
    "target is not a number": ["balance", "sputnix", "--target-um", "nan", "0", "0"],
    "no bench time": ["balance", "sputnix", "--max-time-s", "0"],
    "fewer than no moves": ["balance", "sputnix", "--max-moves", "-1"],
    "unknown kind of table": ["simulate", "sputnix", "--out", "x.xls"],
    "move in no order": ["simulate", "sputnix", "--out", "x.csv", "--move", "x1=3 at 60"],
    "move of no mass": ["simulate", "sputnix", "--out", "x.csv", "--move", "60: x9=3"],
    "move by words": ["simulate", "sputnix", "--out", "x.csv", "--move", "60: x1=far"],
    "move off the rail": ["simulate", "sputnix", "--out", "x.csv", "--move", "60: x1=300"],
    "move after the end": ["simulate", "sputnix", "--out", "x.csv", "--move", "600: x1=3"],
}


def is_one_sentence(text: str) -> bool:
    """Progress may come before it; the last line is the sentence, and there is no traceback."""
    lines = [line for line in text.splitlines() if not line.endswith("...")]
    return len(lines) == 1 and lines[0].startswith("equipoise: ") and "Traceback" not in text


@pytest.mark.parametrize("words", WRONG_USE.values(), ids=WRONG_USE.keys())
def test_wrong_usage_is_reported_in_one_sentence(equipoise, tmp_path, words):
    done = equipoise(*words)
    assert done.code == 2
    assert is_one_sentence(done.err)
    assert done.out == ""
    assert list(tmp_path.iterdir()) == []


WRONG_IDENTIFY = {
    "method": (["--method", "guess"], "trajectory"),
    "held parameter": (["--hold", "inertia_zz"], "inertia_P_zz"),
    "term": (["--term", "vicsous"], "viscous"),
    "dialect": (["--dialect", "optitrak"], "optitrack"),
    "two ways to read": (["--dialect", "ros", "--columns", "map.toml"], "one of them"),
    "window": (["--from-s", "300"], "within 0 to 120 s"),
}


@pytest.mark.parametrize(("words", "wanted"), WRONG_IDENTIFY.values(), ids=WRONG_IDENTIFY.keys())
def test_options_of_identify_are_checked_before_anything_is_printed(
    equipoise, record_file, words, wanted
):
    done = equipoise("identify", record_file, "--testbed", "sputnix", *words)
    assert (done.code, done.out) == (2, "")
    assert is_one_sentence(done.err)
    assert wanted in done.err


WRONG_OBSERVE = {
    "held parameter": (["--hold", "inertia_zz"], "inertia_P_zz"),
    "term": (["--term", "vicsous"], "viscous"),
    "dialect": (["--dialect", "optitrak"], "optitrack"),
    "two ways to read": (["--dialect", "ros", "--columns", "map.toml"], "one of them"),
    "window": (["--from-s", "300"], "within 0 to 120 s"),
}


@pytest.mark.parametrize(("words", "wanted"), WRONG_OBSERVE.values(), ids=WRONG_OBSERVE.keys())
def test_options_of_observe_are_checked_before_anything_is_printed(
    equipoise, record_file, words, wanted
):
    done = equipoise("observe", record_file, "--testbed", "sputnix", *words)
    assert (done.code, done.out) == (2, "")
    assert is_one_sentence(done.err)
    assert wanted in done.err


def test_a_recording_that_shows_little_ends_with_0(equipoise, free_file):
    """What is unobservable is the answer, not a failure."""
    done = equipoise("observe", free_file, "--testbed", "sputnix")
    assert done.code == 0
    assert "unobservable" in done.out
    assert "scale" in done.out
    assert "ekf [w, J, mu]" in done.out
    assert "11 of 12" in done.out


def test_a_file_that_is_there_is_kept_unless_forced(equipoise, tmp_path):
    path = tmp_path / "my.toml"
    assert equipoise("new", "sputnix", "--out", path).code == 0
    path.write_text("mine")
    assert equipoise("new", "sputnix", "--out", path).code == 2
    assert path.read_text() == "mine"
    assert equipoise("new", "sputnix", "--out", path, "--force").code == 0
    assert path.read_text() != "mine"


def test_a_file_goes_before_a_preset_of_the_same_name(equipoise, tmp_path):
    (tmp_path / "sputnix").write_text("not a testbed")
    done = equipoise("simulate", "sputnix", "--out", "x.csv")
    assert done.code == 2
    assert "not a testbed" in done.err


def test_an_estimate_that_cannot_be_used_ends_with_1(equipoise, record_file):
    """Three rows of a 0.2 deg camera show nothing."""
    words = ("--from-s", "10", "--to-s", "10.5")
    done = equipoise("identify", record_file, "--testbed", "sputnix", *words)
    assert done.code == 1
    assert "Traceback" not in done.err


def verdict_step(passed: bool) -> Step:
    verdict = verdict_of(passed, np.zeros(3), np.full(3, 1e-6))
    return Step("verify", 1.0, verdict.reasons, verdict=verdict)


@pytest.mark.parametrize(("passed", "code"), [(True, 0), (False, 1)])
def test_the_verdict_is_the_exit_code(equipoise, monkeypatch, passed, code):
    monkeypatch.setattr(balancing, "balanced_by", lambda *_: iter([verdict_step(passed)]))
    assert equipoise("balance", "sputnix").code == code


def test_ctrl_c_halts_the_bench_and_says_so(equipoise, monkeypatch):
    halted = []

    def interrupted(law, bench, options, longest):
        yield Step("measurement", bench.time, OBSERVED, recording=bench.read(1.0))
        raise KeyboardInterrupt

    monkeypatch.setattr(balancing, "balanced_by", interrupted)
    monkeypatch.setattr(SimulatedBench, "stop", lambda bench: halted.append(bench.time))
    done = equipoise("balance", "sputnix", "--out", "here")
    assert done.code == 130
    assert halted == [1.0]
    assert "every mass was halted" in done.err


@pytest.mark.parametrize(("name", "code"), [("SIGTERM", 143), ("SIGHUP", 129)])
def test_a_service_or_a_terminal_that_ends_stops_as_ctrl_c_does(equipoise, monkeypatch, name, code):
    if not hasattr(signal, name):
        pytest.skip(f"no {name} here")
    halted = []

    def stopped(law, bench, options, longest):
        yield Step("measurement", bench.time, OBSERVED, recording=bench.read(1.0))
        signal.raise_signal(getattr(signal, name))

    monkeypatch.setattr(balancing, "balanced_by", stopped)
    monkeypatch.setattr(SimulatedBench, "stop", lambda bench: halted.append(bench.time))
    done = equipoise("balance", "sputnix", "--out", "here")
    assert (done.code, halted) == (code, [1.0])
    assert f"stopped by {name}: every mass was halted" in done.err


def test_unwritable_outputs_are_reported_before_any_work(equipoise, tmp_path, record_file):
    (tmp_path / "file").write_text("")
    for words in (
        ["simulate", "sputnix", "--out", tmp_path / "no" / "x.csv"],
        ["identify", record_file, "--testbed", "sputnix", "--out", tmp_path / "file"],
        ["identify", record_file, "--testbed", "sputnix", "--out", tmp_path / "file" / "in"],
        ["balance", "sputnix", "--out", tmp_path / "file"],
        ["demo", "--out", tmp_path / "file"],
        ["inspect", record_file, "--figure", tmp_path / "x.docx"],
        ["inspect", record_file, "--figure", tmp_path / "no" / "x.png"],
        ["new", "sputnix", "--out", tmp_path / "no" / "x.toml"],
    ):
        done = equipoise(*words)
        assert (done.code, done.out) == (2, ""), words
        assert is_one_sentence(done.err), words
    assert [path.name for path in tmp_path.iterdir()] == ["file"]


def test_holding_follows_balancing(equipoise):
    """The verdict of the hold is the last word."""
    done = equipoise("balance", "sputnix", "--seed", "3", "--hold-min", "0.5", "--max-time-s", "60")
    assert done.code in (0, 1)
    assert "0.5 min" in done.out


LATE = """
import atexit, signal, time
from equipoise.app.cli import main
signal.signal(signal.SIGINT, signal.default_int_handler)

def late():
    print("late", flush=True)
    time.sleep(60)

atexit.register(late)
main()
"""


def test_by_hand_when_all_is_written_ends_it_at_once_without_a_traceback():
    """As the system ends a program: what shells call 130."""
    pipe = subprocess.PIPE
    words = [sys.executable, "-c", LATE, "methods"]
    with subprocess.Popen(words, stdout=pipe, stderr=pipe, text=True) as program:
        assert any("late" in line for line in program.stdout)
        program.send_signal(signal.SIGINT)
        _, complained = program.communicate(timeout=30)
    assert (program.returncode, complained) == (-signal.SIGINT, "")
