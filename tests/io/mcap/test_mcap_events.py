"""Events of a recording, read back: those that were written, at their times."""

import numpy as np
import pytest

from equipoise.io.mcap.live_recording import LiveRecording, Opening
from equipoise.io.recording.recording_events import read_events
from equipoise.model.recording import Recording, Samples

T = np.arange(0.0, 3.0, 0.1)
ROWS = Recording(attitude=Samples(T, np.tile([1.0, 0.0, 0.0, 0.0], (len(T), 1))))


def test_events_come_back_in_their_order_with_the_recordings_times(tmp_path):
    path = tmp_path / "run.mcap"
    with LiveRecording(path, Opening(10**18)) as file:
        file.rows(ROWS)
        file.event(2.5, "mark", "a door was opened", {})
        file.event(0.5, "start", "the platform is free", {"k": 1})
    events = read_events(path)
    assert [(event.kind, event.sentence) for event in events] == [
        ("start", "the platform is free"),
        ("mark", "a door was opened"),
    ]
    assert [event.time for event in events] == pytest.approx([0.5, 2.5], abs=1e-9)


def test_a_table_has_no_events(tmp_path):
    path = tmp_path / "run.csv"
    path.write_text("time_s,q_w,q_x,q_y,q_z\n0,1,0,0,0\n")
    assert read_events(path) == ()
