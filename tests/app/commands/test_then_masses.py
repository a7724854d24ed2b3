"""`balance --manual --then-masses`: simulated, and a real session from weights to masses."""

from contextlib import contextmanager
from pathlib import Path

import numpy as np
import pytest

from equipoise.app.commands import by_hand_then_masses
from equipoise.io.recording.recording_file import write_recording
from equipoise.io.testbed.presets import read_preset
from equipoise.model.units import UM
from equipoise.procedure.balancing.balance_manually import HandOptions
from equipoise.procedure.balancing.hands_then_masses import hands_then_masses
from equipoise.simulation.hands import SimulatedHands

BED = read_preset("two-level")
WORDS = ["balance", "two-level", "--manual", "--then-masses"]
SEED = 1


@pytest.fixture(scope="module")
def swings(tmp_path_factory):
    """Return the hands that loaded a platform, the files of their swings, and the last step."""
    folder = tmp_path_factory.mktemp("swings")
    hands, files = SimulatedHands(BED, SEED), []
    for step in hands_then_masses(hands, HandOptions(), lambda _: iter(())):
        if step.kind == "measurement":
            files.append(folder / f"run{len(files) + 1}.csv")
            write_recording(step.recording, files[-1])
    return hands, files, step


def reported(out: str) -> str:
    """Return a text without its line ends and the spaces of its tables."""
    return " ".join(out.split())


def test_both_levels_are_simulated_and_written_down_as_one(equipoise, tmp_path, strict_json):
    done = equipoise(*WORDS, "--seed", SEED, "--out", "out")
    assert done.code == 0
    text = reported(done.out)
    assert text.index("Weights first, to within (55, 55, 55) um") < text.index("Add ")
    assert text.index("can correct the rest") < text.index("Move (to target)")
    assert "placed or removed" in text
    assert "moves of masses" in text
    assert {p.name for p in (tmp_path / "out").iterdir()} >= {
        "report.html", "report.pdf", "balance.json", "testbed.toml", "run.json", "recording.csv",
    }  # fmt: skip
    figures = {p.name for p in (tmp_path / "out" / "figures").iterdir()}
    assert {"rounds_com.svg", "figure14_balancing.svg"} <= figures
    document = strict_json((tmp_path / "out" / "balance.json").read_text(encoding="utf-8"))
    kinds = [step["kind"] for step in document["steps"]]
    assert kinds.index("place") < kinds.index("move")
    assert kinds[-1] == "verify"
    assert document["verdict"] == document["steps"][-1]["verdict"]
    numbered = {name.split("_")[0] for name in figures if name.startswith("step")}
    assert numbered <= {f"step{k:02d}" for k in range(1, len(kinds) + 1)}
    assert len(numbered) == sum(name.startswith("step") for name in figures)
    (known,) = [step["known"] for step in document["steps"] if "known" in step]
    assert np.shape(known["covariance"]) == (9, 9)
    assert known["mass_kg"] > BED.body.mass
    off = np.array(document["truth"]["com_m"]) - [0, 0, -100 * UM]
    assert np.all(np.abs(off) <= np.array([2, 2, 3]) * UM)


def test_a_session_goes_on_with_the_masses_from_what_its_recordings_have_shown(
    equipoise, swings, monkeypatch, strict_json
):
    """A person's swings by file, then a bench; it gets the posterior of the swings."""
    hands, files, last = swings
    benches = []

    @contextmanager
    def let_go(bed, _requested):
        benches.append(bed)
        yield hands.released(bed)

    monkeypatch.setattr(by_hand_then_masses, "let_go", let_go)
    monkeypatch.setattr(by_hand_then_masses, "prepare", lambda *_: None)
    words = [*WORDS, "--session", "s.toml"]
    first = equipoise(*words)
    assert "--manual --then-masses --session s.toml --recording run1.csv" in reported(first.out)
    early = equipoise(*words, "--bench", "--yes")
    assert early.code == 2
    assert "still out of reach of its masses" in reported(early.err)
    for file in files:
        done = equipoise(*words, "--recording", file)
        assert done.code == 0
    assert "--then-masses --session s.toml --bench" in reported(done.out)
    waiting = strict_json(equipoise(*words, "--json").out)
    assert waiting["verdict"] is None
    done = equipoise(*words, "--bench", "--yes", "--out", "out")
    assert done.code == 0
    (known,) = benches
    np.testing.assert_allclose(known.body.com, last.known.body.com, atol=1e-3 * UM)
    np.testing.assert_allclose(known.body_covariance, last.known.body_covariance, rtol=1e-2,
                               atol=1e-2 * np.abs(last.known.body_covariance).min())  # fmt: skip
    document = strict_json(Path("out/balance.json").read_text(encoding="utf-8"))
    assert document["verdict"]["passed"]
    assert {"place", "move"} <= {step["kind"] for step in document["steps"]}
    assert document["provenance"]["session"] == "s.toml"
    off = hands.truth().com - [0, 0, -100 * UM]
    assert np.all(np.abs(off) <= np.array([2, 2, 3]) * UM)


def test_a_session_is_of_one_kind(equipoise):
    assert equipoise(*WORDS, "--session", "s.toml").code == 0
    other = equipoise(*WORDS[:3], "--session", "s.toml")
    assert other.code == 2
    assert "with which the session started" in reported(other.err)


WRONG = {
    "masses without hands": (["balance", "two-level", "--then-masses"], "--manual with them"),
    "a bench without a session": ([*WORDS, "--bench"], "--session FILE"),
    "a recording and a bench": (
        [*WORDS, "--session", "s.toml", "--recording", "a.csv", "--bench"], "first the recording",
    ),
    "a series": ([*WORDS, "--series", "3"], "weights are placed by a person first"),
    "no weights": (["balance", "sputnix", "--manual", "--then-masses"], "no weights to place"),
    "no masses": (["balance", "weights-by-hand", *WORDS[2:]], "no sliding masses"),
    "a law that needs a gyro": ([*WORDS, "--law", "pid"], "without a gyro"),
    "no such law": ([*WORDS, "--law", "pidd"], "pid"),
}  # fmt: skip


@pytest.mark.parametrize(("words", "wanted"), WRONG.values(), ids=WRONG.keys())
def test_wrong_usage_is_reported_in_one_sentence(equipoise, words, wanted):
    done = equipoise(*words)
    assert done.code == 2
    assert wanted in reported(done.err)
    assert "Traceback" not in done.err
    assert not Path("s.toml").exists()


def test_hands_that_give_up_end_with_1(equipoise, tmp_path):
    from dataclasses import replace

    from equipoise.io.testbed.testbed_file import write_testbed

    few = replace(BED, weights=(replace(BED.weights[0], count=1),))
    write_testbed(few, tmp_path / "few.toml")
    done = equipoise("balance", "few.toml", *WORDS[2:], "--max-rounds", "1", "--seed", "2")
    assert done.code == 1
    assert "All permitted rounds were made" in reported(done.out)
    assert "Move (" not in done.out
