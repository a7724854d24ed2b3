"""`precompile` runs what compiles; afterwards nobody waits."""

import shlex

import pytest

from equipoise.app.cli import app
from equipoise.app.runs import kernel_rehearsal
from tests.support import thorough

LINES = [*kernel_rehearsal.RECORDS, *kernel_rehearsal.COMMANDS]


@pytest.mark.parametrize("line", LINES)
def test_every_line_is_a_command(line):
    """Whether it also runs takes minutes to say: below."""
    command, *_ = app.parse_args(shlex.split(line), exit_on_error=False, print_error=False)
    assert command.__name__ == line.split()[0]


def test_every_record_that_is_read_was_made():
    made = {words[words.index("--out") + 1] for words in map(str.split, kernel_rehearsal.RECORDS)}
    read = {word for line in kernel_rehearsal.COMMANDS for word in line.split() if ".csv" in word}
    assert read == made


def test_a_command_that_fails_is_named(equipoise, monkeypatch):
    monkeypatch.setattr(kernel_rehearsal, "RECORDS", ("simulate nonesuch --out a.csv",))
    done = equipoise("precompile", "--workers", 1)
    assert done.code == 2
    assert "equipoise simulate nonesuch --out a.csv" in done.err
    assert "exit code 2" in done.err


def test_no_workers_are_refused(equipoise):
    done = equipoise("precompile", "--workers", 0)
    assert done.code == 2
    assert "--workers" in done.err


@thorough.whole
def test_all_lines_run(equipoise):
    done = equipoise("precompile")
    assert done.code == 0
    assert int(done.out.split()[0]) > len(LINES)
