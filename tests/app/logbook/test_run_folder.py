"""The name of a run's folder: none is written over, and it is found at once."""

from pathlib import Path

from equipoise.app.logbook.run_folder import free


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
