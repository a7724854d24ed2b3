"""Whatever is made of rows for people fails alone; guard and pace go on, and the page says so."""

from dataclasses import replace

import numpy as np
import pytest

from equipoise.app.dashboard.protocol import requests
from equipoise.app.dashboard.runner import display
from equipoise.app.dashboard.runner.benches import simulated
from equipoise.app.dashboard.runner.outbox import Post
from equipoise.io.recording.recording_file import read_recording, write_recording
from equipoise.simulation.bench import SimulatedBench
from tests.app.dashboard.conftest import BALANCE
from tests.support.recorded_events import events_of

limited_files = pytest.importorskip("tests.support.limited_files", reason="no RLIMIT_FSIZE")
FULL = 30_000  # bytes: two seconds of a recording


def fails(*_what):
    raise ZeroDivisionError("in the view")


def recorded_until_full(room):
    """Record until the disk is full; return the file, and what the page was told then."""
    room.request(requests.Record(True))
    room.turn()
    name = room.reported.state["recording"]
    with limited_files.files_of_at_most(FULL):
        room.until(lambda: room.reported.state["recording"] is None, 2000)
    return room.folder / name


def test_a_full_disk_ends_the_recording_alone_and_the_page_says_so(room):
    """State and sentence: nothing is recorded, which file it was, up to when rows are kept."""
    path = recorded_until_full(room)
    note, ended = room.reported.state["note"], room.runner.station.bench.time
    assert "recording stopped" in note
    assert str(path) in note
    assert [step["sentence"] for step in room.reported.steps] == [note]
    said = float(note.partition("by ")[2].partition(" s")[0])
    kept = read_recording(path).attitude.t
    assert said - kept[-1] == pytest.approx(0.0, abs=0.06)  # s: a row is 0.05 s after another
    assert 0 <= ended - said <= 1.0
    room.turn(20)
    assert room.reported.rows("pose")[-1, 0] > ended + 1.5


def test_a_platform_is_caught_though_the_disk_is_full(room):
    recorded_until_full(room)
    assert room.reported.state["phase"] == "idle"
    room.until(lambda: room.reported.state["phase"] == "paused", 4000)
    assert "caught" in room.reported.state["note"]


def test_a_platform_is_caught_whatever_of_the_view_has_failed(room):
    room.runner._watched._onlookers.hand_on(fails)
    room.until(lambda: room.runner.phase == "paused", 4000)
    assert "caught" in room.runner.note


def test_a_platform_whose_attitude_is_no_number_is_caught(room):
    rows = room.runner.station.bench.read(0.2)
    lost = replace(rows.attitude, values=np.full_like(rows.attitude.values, np.nan))
    room.runner._guard(replace(rows, attitude=lost))
    assert room.runner.phase == "paused"


def test_the_pace_is_kept_whatever_of_the_view_has_failed(room):
    """At 0.05 of real time a slice is due 2 s after the one before."""
    room.runner._watched._onlookers.hand_on(fails)
    room.runner.pace.at(0.05)
    rows = room.runner.station.bench.read(0.1)
    before = room.runner._due
    room.runner._guard(rows)
    room.runner._guard(rows)
    assert room.runner._due - before > 1.9


def test_another_recording_may_be_begun_after_a_full_disk(room):
    recorded_until_full(room)
    room.request(requests.Record(True))
    room.turn(20)
    name = room.reported.state["recording"]
    assert name is not None
    room.request(requests.Record(False))
    room.turn()
    t = read_recording(room.folder / name).attitude.t
    assert t[-1] - t[0] > 1.5


def test_charts_that_fail_end_alone_and_page_and_record_say_so(room, monkeypatch):
    room.request(requests.Record(True))
    room.turn(5)
    name = room.reported.state["recording"]
    monkeypatch.setattr(display, "parts_of", fails)
    room.turn(20)
    assert "the charts: failed" in room.reported.state["note"]
    room.request(requests.Record(False))
    room.turn()
    kept = [event.sentence for event in events_of(room.folder / name)]
    assert kept == [room.reported.steps[-1]["sentence"]]
    assert "in the view" in kept[0]
    t = read_recording(room.folder / name).attitude.t
    assert t[-1] - t[0] > 2.0
    assert len(room.runner._display.observed) > 20


def test_an_estimate_that_fails_again_and_again_is_reported_once(room, monkeypatch):
    monkeypatch.setattr(display, "grown", fails)
    room.turn(20)
    assert [step["sentence"] for step in room.reported.steps] == [
        "The live estimate restarts: in the view"
    ]
    assert len(np.unique(room.reported.rows("pose")[:, 0])) > 30


def test_a_series_that_changes_its_columns_is_refused_when_it_is_given():
    post = Post(lambda kind, what: None)
    post.rows(0.0, [("pose", np.zeros((2, 5)))])
    with pytest.raises(ValueError, match="series pose"):
        post.rows(0.1, [("pose", np.zeros((2, 4)))])


def test_a_full_disk_does_not_end_a_balancing(room):
    """A recording that a person began is no condition; what was asked for is done."""
    room.request(requests.Record(True))
    room.turn()
    with limited_files.files_of_at_most(FULL):
        room.request(BALANCE)
        room.turn(2)
    assert room.reported.state["recording"] is None
    stopped, *_ = [step for step in room.reported.steps if step["of"] == "note"]
    assert "recording stopped" in stopped["sentence"]
    assert room.reported.steps[-1]["outcome"] == "passed"


def test_a_folder_that_cannot_be_made_is_named_and_the_bench_goes_on(room):
    (room.folder / "recordings").write_text("in the way")
    room.request(requests.Record(True))
    room.turn(10)
    assert room.reported.state["recording"] is None
    assert str(room.folder) in room.reported.state["note"]


# --- A recording ends with its platform ----------------------------------------------------------


def begun(room):
    room.request(requests.Record(True))
    room.turn(20)
    return room.reported.state["recording"]


def check_ended(room, name):
    """The file holds the first platform alone, and the page says that nothing is recorded."""
    assert room.reported.state["recording"] is None
    first = room.reported.steps[0]["sentence"]
    assert first.startswith(f"{name}: the recording ended")
    room.turn(20)
    t = read_recording(room.folder / name).attitude.t
    assert 1.5 < t[-1] - t[0] < 2.5
    assert np.all(np.diff(t) > 0)


@pytest.mark.parametrize("seed", [2, 3])
def test_a_recording_ends_with_its_platform(room, seed):
    name = begun(room)
    room.request(requests.Anew(seed))
    room.turn(2)
    check_ended(room, name)


def test_a_recording_ends_where_another_is_shown(room, nanosat):
    write_recording(SimulatedBench(nanosat, 2).read(10.0), room.folder / "kept.csv")
    name = begun(room)
    room.request(requests.Replay("kept.csv"))
    room.turn(2)
    check_ended(room, name)


def test_a_recording_that_cannot_be_ended_keeps_no_platform_from_being_shown(room, nanosat):
    begun(room)
    with limited_files.files_of_at_most(100):
        room.runner.show(simulated(nanosat, 5))
    assert room.reported.state["seed"] == 5
    assert "recording stopped" in room.reported.state["note"]
