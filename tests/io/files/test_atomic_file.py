"""Files are written whole or not at all."""

import os
import sys

import pytest

from equipoise.io.files import atomic_file
from equipoise.io.files.atomic_file import (
    check_folder,
    check_writable,
    whole_file,
    write_folder,
    write_whole,
)
from equipoise.model.errors import InputError


def test_content_arrives_and_nothing_else_is_left(tmp_path) -> None:
    """Text as UTF-8 with its line ends kept, bytes as they are."""
    write_whole(tmp_path / "a.txt", "µ\n")
    write_whole(tmp_path / "b.bin", b"\x00\x01")
    assert (tmp_path / "a.txt").read_bytes() == b"\xc2\xb5\n"
    assert (tmp_path / "b.bin").read_bytes() == b"\x00\x01"
    assert sorted(p.name for p in tmp_path.iterdir()) == ["a.txt", "b.bin"]


def half_written(path) -> None:
    """Break off in the middle of writing."""
    with whole_file(path) as temporary:
        temporary.write_text("half")
        raise KeyboardInterrupt


@pytest.mark.parametrize("old", [None, "old"])
def test_a_stopped_program_leaves_the_old_file_or_none(tmp_path, old) -> None:
    """Half a file never gets the name."""
    path = tmp_path / "a.txt"
    if old is not None:
        path.write_text(old)
    with pytest.raises(KeyboardInterrupt):
        half_written(path)
    assert [p.read_text() for p in tmp_path.iterdir()] == ([] if old is None else [old])


@pytest.mark.parametrize("write", [lambda p: write_whole(p, "x"), check_writable])
@pytest.mark.parametrize(("name", "found"), [("", "a directory"), ("no/a.txt", "no directory")])
def test_a_place_that_cannot_be_written_is_named(tmp_path, write, name, found) -> None:
    """A directory, or a name within a directory that is not there."""
    with pytest.raises(InputError, match=found):
        write(tmp_path / name)


@pytest.mark.skipif(
    sys.platform == "win32" or os.geteuid() == 0, reason="permissions do not bind this user"
)
def test_a_locked_directory_is_named(tmp_path) -> None:
    """No permission is an input error, not a traceback."""
    tmp_path.chmod(0o500)
    with pytest.raises(InputError, match="Permission denied"):
        write_whole(tmp_path / "a.txt", "x")
    tmp_path.chmod(0o700)


@pytest.mark.skipif(sys.platform == "win32", reason="Windows has no such modes")
def test_permissions_and_links_survive(tmp_path) -> None:
    """The file behind a link is replaced, with its mode; the link stays a link."""
    (tmp_path / "real.txt").write_text("old")
    (tmp_path / "real.txt").chmod(0o640)
    (tmp_path / "link.txt").symlink_to(tmp_path / "real.txt")
    write_whole(tmp_path / "link.txt", "new")
    assert (tmp_path / "link.txt").is_symlink()
    assert (tmp_path / "real.txt").read_text() == "new"
    assert (tmp_path / "real.txt").stat().st_mode & 0o777 == 0o640


@pytest.mark.skipif(sys.platform == "win32", reason="Windows has no /dev/null")
def test_a_device_is_written_and_not_replaced() -> None:
    """/dev/null stays what it is."""
    write_whole("/dev/null", "x")
    check_writable("/dev/null")


def test_files_come_into_a_new_folder(tmp_path):
    paths = write_folder(tmp_path / "a" / "b", {"x.txt": "ä", "y.bin": b"\x00"})
    assert [path.name for path in paths] == ["x.txt", "y.bin"]
    assert paths[0].read_text(encoding="utf-8") == "ä"
    assert {path.name for path in (tmp_path / "a" / "b").iterdir()} == {"x.txt", "y.bin"}


def test_other_files_stay(tmp_path):
    (tmp_path / "mine").write_text("mine")
    write_folder(tmp_path, {"x": "new"})
    assert {path.name for path in tmp_path.iterdir()} == {"mine", "x"}


def test_a_failure_half_way_leaves_nothing(tmp_path, monkeypatch):
    (tmp_path / "x").write_text("old")
    real = atomic_file.write_whole

    def failing(path, content):
        if path.name == "y":
            raise OSError(28, "No space left on device")
        real(path, content)

    monkeypatch.setattr(atomic_file, "write_whole", failing)
    for folder in (tmp_path, tmp_path / "new" / "one"):
        with pytest.raises(InputError, match="No space left"):
            write_folder(folder, {"x": "new", "y": "new"})
    assert (tmp_path / "x").read_text() == "old"
    assert [path.name for path in tmp_path.iterdir()] == ["x"]


@pytest.mark.parametrize("place", ["file", "file/below"])
def test_a_file_in_the_way_is_named(tmp_path, place):
    (tmp_path / "file").write_text("")
    with pytest.raises(InputError, match="folder"):
        check_folder(tmp_path / place)
