"""Several files are written all or not at all."""

import pytest

from equipoise.io.files import atomic_folder
from equipoise.io.files.atomic_folder import check_folder, write_folder
from equipoise.model.errors import InputError


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
    real = atomic_folder.write_whole

    def failing(path, content):
        if path.name == "y":
            raise OSError(28, "No space left on device")
        real(path, content)

    monkeypatch.setattr(atomic_folder, "write_whole", failing)
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
