"""The name of a run's folder: none is written over, and it is found at once."""

import re
from pathlib import Path

from equipoise.app.logbook.run_folder import free, name_of, own_folder


def test_a_taken_name_gets_a_number(tmp_path):
    wanted = tmp_path / "run.1"
    found = []
    for _ in range(3):
        found.append(free(wanted).name)
        free(wanted).mkdir()
    assert found == ["run.1", "run.1_2", "run.1_3"]


def test_only_as_many_names_are_tried_as_it_takes(tmp_path, monkeypatch):
    """It once made a million of them first: 5 s after every run."""
    made, name_with = [], Path.with_name
    monkeypatch.setattr(Path, "with_name", lambda path, n: made.append(n) or name_with(path, n))
    (tmp_path / "run").mkdir()
    assert free(tmp_path / "run").name == "run_2"
    assert made == ["run_2"]


def test_a_run_has_a_folder_in_that_of_its_month(tmp_path, monkeypatch):
    monkeypatch.setenv("EQUIPOISE_RUNS", str(tmp_path / "runs"))
    folder = own_folder("balance", "my bed")
    assert folder.parent.parent == tmp_path / "runs"
    named = re.fullmatch(
        r"(\d{4}-\d\d)/(\d{4}-\d\d)-\d\d_\d\d-\d\d-\d\d_balance_(.*)", name_of(folder)
    )
    assert named[1] == named[2]
    assert "my" in named[3]
    assert not folder.exists()


def test_a_file_in_place_of_the_month_is_named(tmp_path, monkeypatch, capsys):
    monkeypatch.setenv("EQUIPOISE_RUNS", str(tmp_path))
    month = own_folder("balance", "bed").parent
    month.write_text("")
    assert own_folder("balance", "bed") is None
    assert month.name in capsys.readouterr().err
