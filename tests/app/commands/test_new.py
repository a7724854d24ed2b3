"""``equipoise new`` without a preset: five questions, their defaults, and what the answers make."""

import io
import shlex
import sys

import numpy as np
import pytest

from equipoise.app.arguments import first_questions
from equipoise.app.console import questions
from equipoise.io.testbed.testbed_file import read_testbed
from tests.support.pseudo_terminal import AtTerminal, stripped

CAD = """\
<mujoco><worldbody><body name="table"><inertial pos="0 0 -0.0002" mass="12.0"
 diaginertia="0.3 0.4 0.5"/></body></worldbody></mujoco>
"""


@pytest.fixture
def answering(equipoise, monkeypatch):
    """Return a function that runs ``equipoise new`` with a person who types these lines."""

    def call(*lines, words=()):
        typed = iter(lines)

        def type_next():
            try:
                return next(typed)
            except StopIteration:
                raise EOFError from None

        monkeypatch.setattr(questions, "is_person_there", lambda: True)
        monkeypatch.setattr("builtins.input", type_next)
        done = equipoise("new", *words)
        assert next(typed, None) is None, "an answer that nobody asked for"
        return done

    return call


def test_the_defaults_make_a_platform_by_hand(equipoise):
    """A box of 0.4 x 0.4 x 0.3 m and 10 kg: m (b^2 + c^2) / 12."""
    assert equipoise("new", "--yes").code == 0
    bed = read_testbed("my.toml")
    np.testing.assert_allclose(np.diag(bed.body.inertia_C), [2.5 / 12, 2.5 / 12, 3.2 / 12])
    assert bed.inertia_sd == pytest.approx(0.3)
    assert bed.mass_names == ("x", "y", "z")
    assert [mass.mass for mass in bed.masses] == pytest.approx([0.1] * 3)
    np.testing.assert_allclose([mass.axis for mass in bed.masses], np.eye(3))
    np.testing.assert_allclose(
        [mass.home for mass in bed.masses], [[0, 0.2, 0], [0, 0, 0.15], [0.2, 0, 0]]
    )
    np.testing.assert_allclose([mass.travel for mass in bed.masses], [[-0.03, 0.03]] * 3)
    assert bed.attitude is not None
    assert bed.gyro is not None
    assert bed.truth is not None


def test_enter_five_times_is_yes(answering, equipoise, tmp_path):
    assert answering("", "", "", "", "").code == 0
    assert equipoise("new", "--yes", "--out", "yes.toml").code == 0
    assert (tmp_path / "my.toml").read_text() == (tmp_path / "yes.toml").read_text()


def test_the_next_command_of_the_defaults_runs(equipoise):
    done = equipoise("new", "--yes")
    simulating, identifying = (
        line.split("equipoise ")[1] for line in done.out.splitlines() if line.startswith("  ")
    )
    assert simulating == 'simulate my.toml --out run.csv --duration-s 60 --move "30: z=-15"'
    assert identifying == "identify run.csv --testbed my.toml"
    assert equipoise(*shlex.split(simulating)).code == 0


def test_answers_decide_the_file(answering, tmp_path):
    (tmp_path / "table.xml").write_text(CAD)
    (tmp_path / "my log.csv").write_text("t,a\n")
    done = answering("14.2", "table.xml", "0", "camera", "my log.csv")
    assert done.code == 0
    bed = read_testbed("my.toml")
    assert bed.body.mass == 14.2
    np.testing.assert_allclose(np.diag(bed.body.inertia_C), [0.3, 0.4, 0.5])
    np.testing.assert_allclose(bed.body.com, [0, 0, -0.0002])
    assert bed.inertia_sd == pytest.approx(0.1)
    assert (bed.masses, bed.gyro, bed.truth) == ((), None, None)
    assert bed.attitude.noise == pytest.approx(np.radians(0.2))
    assert "equipoise import 'my log.csv' --testbed my.toml --out run.csv" in done.out
    assert "equipoise identify run.csv --testbed my.toml --prior" in done.out


def test_a_hostile_name_of_a_file_stays_a_remark(answering, tmp_path):
    name = 'a"b\nmass_kg = 1.xml'
    (tmp_path / name).write_text(CAD)
    assert answering("14.2", name, "0", "camera", "simulate").code == 0
    assert read_testbed("my.toml").body.mass == 14.2


def test_six_masses_stand_opposite_each_other(answering):
    done = answering("8", "300x200x100", "6, 50, 20", "gyro", "bench")
    assert done.code == 0
    bed = read_testbed("my.toml")
    home = np.array([mass.home for mass in bed.masses])
    np.testing.assert_allclose(home[:3], -home[3:])
    assert bed.attitude is None
    assert bed.accelerometer is not None
    assert "equipoise check my.toml" in done.out


BAD = {
    "mass": (0, "heavy"),
    "mass of nothing": (0, "0"),
    "no such file": (1, "drawing.txt"),
    "two edges": (1, "400 300"),
    "four masses": (2, "4 100 30"),
    "no travel": (2, "3 100"),
    "sensor": (3, "sextant"),
    "recording": (4, "nowhere.csv"),
}


@pytest.mark.parametrize(("number", "answer"), BAD.values(), ids=BAD.keys())
def test_an_answer_that_cannot_be_read_leads_to_the_question_again(answering, number, answer):
    lines = [""] * 5
    lines.insert(number, answer)
    done = answering(*lines)
    assert done.code == 0
    assert f"{number + 1}. " in done.err
    assert done.err.count("equipoise: ") == 1
    assert done.err.count(f"{number + 1}. ") >= 2


def test_the_end_of_the_input_writes_nothing(answering, tmp_path):
    done = answering("12")
    assert done.code == 2
    assert "the end of the input" in done.err
    assert list(tmp_path.iterdir()) == []


def test_without_a_terminal_the_error_names_what_to_type(equipoise, tmp_path, monkeypatch):
    monkeypatch.setattr(sys, "stdin", io.StringIO())
    done = equipoise("new")
    assert done.code == 2
    assert "--yes" in done.err
    assert "equipoise new sputnix" in done.err
    assert list(tmp_path.iterdir()) == []


def test_a_file_that_is_there_stays(equipoise):
    assert equipoise("new", "--yes").code == 0
    assert equipoise("new", "--yes").code == 2
    assert equipoise("new", "--yes", "--force").code == 0


def test_every_question_has_a_default_that_can_be_read():
    found = [
        each for each in vars(first_questions).values() if isinstance(each, questions.Question)
    ]
    assert len(found) == 5
    for question in found:
        question.read(question.default)


def test_at_a_terminal_each_question_shows_its_default(tmp_path):
    terminal = AtTerminal(tmp_path, ["new"])
    for number, default in ((1, "10"), (2, "400 400 300"), (3, "3 100 30"), (4, "imu"),
                            (5, "simulate")):  # fmt: skip
        terminal.wait_for(f"[{default}]: ")
        assert f"{number}. " in stripped(terminal.written)
        terminal.type("\n")
    assert terminal.ended() == 0
    assert (tmp_path / "my.toml").exists()
