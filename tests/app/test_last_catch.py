"""An error that nobody has foreseen is one sentence, a crash file without data, and code 3."""

import hashlib
import os
import stat
import subprocess
import sys
import weakref
from pathlib import Path

import pytest

from equipoise import __version__
from equipoise.app.console.crash_file import KEPT, crash_of
from tests.support import failing_program

CELL = "0.123456789 \x1b]0;t\x07 secret_word"
FRAMES = {"recursion": "deep", "worker": "work", "thread": "work", "type": "chained"}
WAYS = sorted(failing_program.WAYS)


@pytest.fixture
def fail(tmp_path):
    """Return a function that runs the program with a command that fails."""
    (tmp_path / "run.csv").write_text(f"time_s,{CELL},1")

    def call(way: str, state: str = str(tmp_path), *more: str) -> subprocess.CompletedProcess[str]:
        words = ["fail", "run.csv", "--way", way, *more]
        return subprocess.run(
            [sys.executable, "-m", "tests.support.failing_program", *words],
            cwd=tmp_path, capture_output=True, text=True, check=False,
            env={**os.environ, "XDG_STATE_HOME": state, "PYTHONPATH": os.pathsep.join(sys.path)},
        )  # fmt: skip

    return call


def files_in(state: Path) -> list[Path]:
    return sorted((state / "equipoise" / "crashes").iterdir())


@pytest.mark.parametrize("way", WAYS)
def test_what_nobody_has_foreseen_is_one_sentence_and_a_file(fail, tmp_path, way):
    done = fail(way)
    assert done.returncode == 3
    assert done.stdout == ""
    lines = [line for line in done.stderr.splitlines() if line and not line.endswith("...")]
    assert len(lines) == 1
    assert lines[0].startswith("equipoise: unexpected error (")
    assert not {"\x1b", "\x07"} & set(done.stderr)
    (path,) = files_in(tmp_path)
    assert str(path) in lines[0]


@pytest.mark.parametrize("way", WAYS)
def test_a_crash_file_holds_what_a_maintainer_needs_and_no_data(fail, tmp_path, way):
    fail(way, str(tmp_path), "--to=run.csv")
    (path,) = files_in(tmp_path)
    text, record = path.read_text(encoding="utf-8"), tmp_path / "run.csv"
    for word in CELL.split():
        assert word not in text
    for wanted in (f"equipoise {__version__}", "arguments: fail run.csv --way", "Python 3", "numpy",
                   "tests/support/failing_program.py", FRAMES.get(way, way)):  # fmt: skip
        assert wanted in text.replace("\\", "/")
    digest = hashlib.sha256(record.read_bytes()).hexdigest()
    assert text.count(f"run.csv, {record.stat().st_size} bytes, sha256 {digest}") == 2
    assert "XDG" not in text


def test_a_crash_file_is_its_owners_alone(fail, tmp_path):
    fail("value")
    (path,) = files_in(tmp_path)
    assert stat.S_IMODE(path.stat().st_mode) == (0o600 if os.name == "posix" else 0o666)


def test_where_no_file_can_be_written_it_stands_on_the_terminal(fail, tmp_path):
    (tmp_path / "taken").write_text("")
    done = fail("type", str(tmp_path / "taken"))
    assert done.returncode == 3
    assert "no crash file could be written" in done.stderr
    assert "caused by: builtins.ValueError" in done.stderr
    assert "failing_program.py" in done.stderr
    assert not {"\x1b", "\x07"} & set(done.stderr)


def test_the_newest_crash_files_are_kept(tmp_path, monkeypatch):
    monkeypatch.setenv("XDG_STATE_HOME", str(tmp_path))
    paths = [crash_of(ValueError("x"), ["a"]).path for _ in range(KEPT + 3)]
    assert files_in(tmp_path) == paths[3:]


def test_a_place_that_is_not_absolute_does_not_count(tmp_path, monkeypatch):
    """As the standard of these places has it; the folder in which one works stays clean."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("XDG_STATE_HOME", "state")
    monkeypatch.setenv("HOME", str(tmp_path / "home"))
    path = crash_of(ValueError("x"), []).path
    assert path is not None
    assert path.is_relative_to(tmp_path / "home")


@pytest.mark.parametrize("name", ["pipe", "folder", "\0", "none", "x" * 5000])
def test_only_files_that_are_there_are_described(tmp_path, monkeypatch, name):
    monkeypatch.setenv("XDG_STATE_HOME", str(tmp_path))
    if name == "pipe" and hasattr(os, "mkfifo"):
        os.mkfifo(tmp_path / "pipe")
    (tmp_path / "folder").mkdir()
    crash = crash_of(ValueError("x"), [str(tmp_path / name)])
    assert crash.path is not None
    assert "\nfile: " not in crash.text


def test_what_the_frames_hold_is_let_go():
    """A program that ran out of memory has some again to say so."""

    class Large:
        pass

    def work():
        kept = Large()
        remembered.append(weakref.ref(kept))
        raise MemoryError

    remembered = []
    with pytest.raises(MemoryError) as caught:
        work()
    crash_of(caught.value, [])
    assert remembered[0]() is None
