"""What the viewer gets of a recording: every row of it, and the steps."""

import numpy as np
import pytest

from equipoise.app.arguments.recorded_run import RecordedRun
from equipoise.app.dashboard.runner import whole_recording as module
from equipoise.app.dashboard.runner.whole_recording import whole_recording
from equipoise.app.live.live_estimate import LiveEstimate, grown
from equipoise.model.errors import InputError
from equipoise.model.recorded_step import RecordedStep
from equipoise.model.recording import joined, rows_between
from equipoise.simulation.bench import SimulatedBench
from tests.app.dashboard.conftest import decoded


@pytest.fixture(scope="module")
def run(nanosat):
    """Four seconds of a simulated platform, and two steps in the wrong order."""
    rows = SimulatedBench(nanosat, 1).read(4.0)
    steps = (RecordedStep("verify", 3.9, "Passed.", "passed"), RecordedStep("move", 1.0, "Moved."))
    return RecordedRun(nanosat, rows, "a run", steps)


def test_every_row_is_there_as_it_was_recorded(run):
    t, parts = decoded(whole_recording(run).rows)
    assert t == pytest.approx(run.recording.span[1])
    for name, channel in (("pose", run.recording.attitude), ("rate", run.recording.rate)):
        assert parts[name][:, 0] == pytest.approx(channel.t)
        assert parts[name][:, 1 : 1 + channel.values.shape[1]] == pytest.approx(channel.values)


def test_the_estimate_is_that_of_the_whole_recording_at_once(run):
    """Masses stand at home: the centre of mass is the tracker's own."""
    _, parts = decoded(whole_recording(run).rows)
    _, track = grown(LiveEstimate(run.testbed), run.recording)
    assert parts["com"][-1, 1:4] == pytest.approx(track.com[-1], rel=1e-6, abs=1e-9)
    assert parts["com"][-1, 4:7] == pytest.approx(track.com_sd[-1], rel=1e-6)


def test_times_never_decrease(run):
    _, parts = decoded(whole_recording(run).rows)
    assert {name for name, rows in parts.items() if (np.diff(rows[:, 0]) < 0).any()} == set()


def test_steps_come_in_order_of_time_with_what_came_of_them(run):
    document = whole_recording(run).document
    steps = [(step["index"], step["of"], step["t"], step["outcome"]) for step in document["steps"]]
    assert steps == [(0, "move", 1.0, None), (1, "verify", 3.9, "passed")]
    assert document["state"]["span"] == run.recording.span
    assert document["about"]["bench"] == "replayed"


def test_a_silence_of_the_sensors_is_left_as_it_is(run):
    parts = (rows_between(run.recording, -np.inf, 1.2), rows_between(run.recording, 2.6, np.inf))
    silent = RecordedRun(run.testbed, joined(parts), "a run", ())
    _, found = decoded(whole_recording(silent).rows)
    assert np.diff(found["pose"][:, 0]).max() > 1.3


def test_more_than_a_page_holds_is_refused_with_the_options_that_help(run, monkeypatch):
    monkeypatch.setattr(module, "MOST", 1000.0)
    with pytest.raises(InputError, match=r"--from-s and --to-s"):
        whole_recording(run)
