"""Hidden folders of writers: gone with them, or with the next; never of others, never shown."""

import os
import subprocess
import sys
import time
from contextlib import contextmanager

import pytest

from equipoise.app.dashboard.protocol.data_folder import recordings
from equipoise.io.documents.logbook import open_logbook
from equipoise.io.files import atomic_file, staging
from equipoise.io.files.atomic_file import (
    check_folder,
    check_writable,
    whole_file,
    write_folder,
    write_whole,
)
from equipoise.model.errors import InputError

WRITER = """
import sys, time
from equipoise.io.files.atomic_file import whole_file
with whole_file(sys.argv[1]) as temporary:
    temporary.write_text("half")
    print("begun", flush=True)
    time.sleep(600)
"""
FOLDER_WRITER = """
import sys, time
from equipoise.io.files import atomic_file
def slow(path, content):
    print("begun", flush=True)
    time.sleep(600)
atomic_file.write_whole = slow
atomic_file.write_folder(sys.argv[1], {"recording.csv": "t_s", "run.json": "{}"})
"""
on_posix = pytest.mark.skipif(os.name == "nt", reason="no locks of folders")


@contextmanager
def writing(program, path):
    """Lend a process that is in the midst of writing."""
    words = [sys.executable, "-c", program, str(path)]
    with subprocess.Popen(words, stdout=subprocess.PIPE, text=True) as process:
        assert process.stdout.readline() == "begun\n"
        yield process
        process.kill()


def names(folder):
    return sorted(path.name for path in folder.iterdir())


@on_posix
@pytest.mark.parametrize("program", [WRITER, FOLDER_WRITER])
@pytest.mark.parametrize(
    "write",
    [
        lambda folder: write_whole(folder / "b.txt", "b"),
        lambda folder: write_folder(folder, {"b.txt": "b"}),
        lambda folder: check_writable(folder / "b.txt"),
        lambda folder: check_folder(folder / "b"),
    ],
)
def test_what_a_killed_writer_left_goes_with_the_next_one(tmp_path, program, write):
    """And not before: as long as it lives, its folder is its own."""
    with writing(program, tmp_path / "a.txt") as process:
        (hidden,) = names(tmp_path)
        write(tmp_path)
        assert hidden in names(tmp_path)
        process.kill()
        process.wait()
        write(tmp_path)
    assert set(names(tmp_path)) <= {"b.txt"}


def test_nothing_but_folders_of_our_name_goes(tmp_path):
    others = [
        ".equipoise-1234567",
        ".equipoise-123456789",
        ".equipoise-ABCDEF12",
        ".equipoise",
        ".12345678",
        "equipoise-12345678",
        ".a.12345678.txt",
        ".equipoise-1234567g",
    ]
    for name in others:
        (tmp_path / name).mkdir()
        (tmp_path / name / "mine").write_text("mine")
    (tmp_path / ".equipoise-aaaaaaaa").write_text("a file, not a folder")
    before = names(tmp_path)
    write_whole(tmp_path / "a.txt", "a")
    assert names(tmp_path) == sorted([*before, "a.txt"])
    assert all((tmp_path / name / "mine").is_file() for name in others)


@on_posix
def test_a_link_of_our_name_is_not_followed(tmp_path):
    (tmp_path / "precious").mkdir()
    (tmp_path / "precious" / "mine").write_text("mine")
    (tmp_path / "here").mkdir()
    (tmp_path / "here" / ".equipoise-12345678").symlink_to(tmp_path / "precious")
    write_whole(tmp_path / "here" / "a.txt", "a")
    assert (tmp_path / "precious" / "mine").read_text() == "mine"


@pytest.mark.parametrize(("age", "stays"), [(2 * 86400, False), (3600, True), (-3600, True)])
def test_without_locks_age_counts_and_a_clock_that_is_set_by_an_hour_does_not(
    tmp_path, monkeypatch, age, stays
):
    monkeypatch.setattr(staging, "_locked", lambda place: (None, False))
    old = tmp_path / ".equipoise-12345678"
    old.mkdir()
    then = time.time() - age
    os.utime(old, (then, then))
    write_whole(tmp_path / "a.txt", "a")
    assert old.exists() is stays


@on_posix
def test_a_name_that_was_swept_before_its_lock_was_had_is_drawn_again(tmp_path, monkeypatch):
    real, swept = staging._locked, []

    def late(place):
        if not swept:
            swept.append(place)
            place.rmdir()
        return real(place)

    monkeypatch.setattr(staging, "_locked", late)
    write_whole(tmp_path / "a.txt", "a")
    assert names(tmp_path) == ["a.txt"]


# --- Names that are shown ------------------------------------------------------------------------


def fail_naming(path, kind):
    """Fail in the middle of writing, as a library that names the file does."""
    with whole_file(path) as temporary:
        if kind == "system":
            raise OSError(f"Error writing bytes to file '{temporary}'")
        raise InputError(f"{temporary}: column q", f"{temporary} full", "room")


@pytest.mark.parametrize("kind", ["system", "input"])
def test_an_error_names_the_target(tmp_path, kind):
    path = tmp_path / "a.parquet"
    with pytest.raises(InputError, match=r"a\.parquet") as caught:
        fail_naming(path, kind)
    error = caught.value
    assert str(path) in str(error)
    assert ".equipoise-" not in " ".join([str(error), error.where, error.found, error.wanted])


def test_an_error_within_a_folder_names_the_file_where_it_is_to_be(tmp_path, monkeypatch):
    def full(stream):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(atomic_file.os, "fsync", full)
    for folder in (tmp_path, tmp_path / "new"):
        with pytest.raises(InputError, match="No space left") as caught:
            write_folder(folder, {"figures/a.png": b"a"})
        assert str(caught.value).startswith(f"{folder / 'figures' / 'a.png'}: ")
    assert names(tmp_path) == []


@on_posix
def test_a_run_that_is_being_written_is_in_no_list(tmp_path):
    with writing(FOLDER_WRITER, tmp_path / "2026-01-01_balance"):
        assert recordings(tmp_path) == []
        assert all(name.startswith(".") for name in names(tmp_path))
        with open_logbook(tmp_path) as book:
            assert book.runs() == []
            assert book.unread == []


@on_posix
def test_a_recording_that_is_being_written_is_in_no_list(tmp_path):
    (tmp_path / "recordings").mkdir()
    with writing(WRITER, tmp_path / "recordings" / "a.mcap"):
        assert recordings(tmp_path) == []


def test_a_new_folder_comes_whole(tmp_path, monkeypatch):
    observed, real = [], atomic_file.write_whole

    def observe(path, content):
        observed.append((tmp_path / "run").exists())
        real(path, content)

    monkeypatch.setattr(atomic_file, "write_whole", observe)
    write_folder(tmp_path / "run", {"a": "a", "figures/b": "b"})
    assert observed == [False, False]
    assert names(tmp_path / "run") == ["a", "figures"]


def test_files_come_into_the_folder_where_one_is(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    write_folder(".", {"a": "a"})
    assert names(tmp_path) == ["a"]
