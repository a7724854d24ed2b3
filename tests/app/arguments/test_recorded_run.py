"""What a recording, or the folder of a run, stands for."""

import json

import pytest

from equipoise.app.arguments.options import WHOLE, Reading
from equipoise.app.arguments.recorded_run import files_shown, is_recorded, recorded_run
from equipoise.io.documents.run_folder import RECORDING, TESTBED
from equipoise.io.documents.run_steps import BALANCE
from equipoise.io.recording.recording_file import write_recording
from equipoise.io.testbed.presets import preset_text, read_preset
from equipoise.model.errors import InputError
from equipoise.model.logged_run import RUN
from equipoise.simulation.bench import SimulatedBench

ENTRY = {
    "schema": "equipoise/run/1",
    "run": {
        "name": "x", "kind": "balance", "made_at": "2026-11-29T12:00:00+00:00", "platform": "x",
        "configuration": "0", "method": "m", "bench": "simulated", "outcome": "passed",
        "sentence": "Passed.",
    },
}  # fmt: skip
STEPS = {"steps": [{"kind": "move", "time_s": 1.0, "sentence": "Moved."}]}


@pytest.fixture
def folder(tmp_path):
    """The folder of a balancing: three seconds of a simulated platform."""
    (tmp_path / TESTBED).write_text(preset_text("nanosat"))
    write_recording(SimulatedBench(read_preset("nanosat"), 1).read(3.0), tmp_path / RECORDING)
    (tmp_path / RUN).write_text(json.dumps(ENTRY))
    (tmp_path / BALANCE).write_text(json.dumps(STEPS))
    return tmp_path


def test_the_folder_of_a_run_brings_testbed_recording_and_steps(folder):
    run = recorded_run(str(folder), None, WHOLE)
    assert run.testbed.name == read_preset("nanosat").name
    assert run.recording.span == pytest.approx((0.0, 3.0), abs=0.3)
    assert [(step.kind, step.time, step.sentence) for step in run.steps] == [
        ("move", 1.0, "Moved.")
    ]


def test_an_identification_brings_its_result_at_the_end(folder):
    (folder / BALANCE).unlink()
    (folder / RUN).write_text(json.dumps({**ENTRY, "run": {**ENTRY["run"], "kind": "identify"}}))
    run = recorded_run(str(folder), None, WHOLE)
    (step,) = run.steps
    assert (step.kind, step.sentence) == ("identify", "Passed.")
    assert step.time == run.recording.span[1]


def test_a_part_is_selected_by_its_times(folder):
    run = recorded_run(str(folder), None, Reading(from_s=1.0, to_s=2.0))
    first, last = run.recording.span
    assert first >= 1.0
    assert last <= 2.0


def test_a_run_of_a_file_elsewhere_names_what_to_type(folder):
    (folder / RECORDING).unlink()
    with pytest.raises(InputError, match=rf"--testbed .*{TESTBED}"):
        files_shown(str(folder), None)


def test_a_recording_needs_a_testbed(folder):
    file = str(folder / RECORDING)
    with pytest.raises(InputError, match="--testbed"):
        files_shown(file, None)
    assert files_shown(file, "nanosat") == (file, "nanosat")


def test_a_testbed_file_is_nothing_recorded(folder):
    found = {name: is_recorded(folder / name) for name in (TESTBED, RECORDING, "no-such-preset")}
    assert found == {TESTBED: False, RECORDING: True, "no-such-preset": False}
    assert is_recorded(folder)
