"""What reading a testbed had to set right is said by every command that reads one."""

import re
from pathlib import Path

import pytest

from equipoise.app import commands
from tests.app.commands.test_simulate import HIGH

BODY = HIGH.replace("HEIGHT", "-100.0")
FLATTER = BODY.replace(
    "0.5]]", "0.83]]\ninertia_sd_percent = 10.0"
)  # than a plate, whose moments are 0.4, 0.4, 0.8
READS = re.compile(r"\btestbed_(?:from|with_masses)\(")
SAID = re.compile(r"\bannounced\(testbed_(?:from|with_masses)\(")
FINDINGS = {"identify.py", "inspect.py", "assess.py"}  # list it among what they found
COPIES = {"convert.py"}  # takes the names of masses alone


@pytest.fixture
def flat(tmp_path) -> Path:
    path = tmp_path / "flat.toml"
    path.write_text(FLATTER, "utf-8")
    return path


def test_every_command_that_reads_a_testbed_says_it():
    for path in Path(commands.__file__).parent.glob("*.py"):
        text = path.read_text("utf-8")
        if path.name not in FINDINGS | COPIES:
            assert len(READS.findall(text)) == len(SAID.findall(text)), path.name


def test_a_body_that_cannot_be_is_said_once(equipoise, flat):
    done = equipoise("simulate", flat, "--out", "run.csv", "--duration-s", 5)
    assert done.code == 0
    assert done.err.count("the testbed's inertia is physically inconsistent") == 1
    for command in ("identify", "observe"):
        done = equipoise(command, "run.csv", "--testbed", flat)
        printed = (done.out + done.err).replace("\n", " ")
        assert printed.count("inertia is physically inconsistent") == 1


def test_a_body_that_can_be_is_taken_in_silence(equipoise, flat):
    flat.write_text(BODY, "utf-8")
    done = equipoise("simulate", flat, "--out", "run.csv", "--duration-s", 5)
    assert "~" not in done.err
