"""The name of a run's folder: none is written over, and it is found at once."""

from time import process_time

from equipoise.app.logbook.run_folder import free


def test_a_taken_name_gets_a_number(tmp_path):
    wanted = tmp_path / "run.1"
    found = []
    for _ in range(3):
        found.append(free(wanted).name)
        free(wanted).mkdir()
    assert found == ["run.1", "run.1_2", "run.1_3"]


def test_only_as_many_names_are_tried_as_it_takes(tmp_path):
    """It once made a million of them first: 5 s after every run."""
    start = process_time()
    free(tmp_path / "run")
    assert process_time() - start < 0.1
