"""The runner: what it shows is what the bench gave, what is asked is done, limits hold."""

from dataclasses import replace

import numpy as np
import pytest

from equipoise.app.dashboard.protocol import requests
from equipoise.app.dashboard.protocol.data_folder import recordings
from equipoise.app.dashboard.protocol.series import series_of
from equipoise.app.dashboard.runner.benches import replayed, simulated
from equipoise.app.dashboard.runner.chart_rows import parts_of
from equipoise.app.live.live_estimate import LiveEstimate, grown
from equipoise.app.live.pace import Pace
from equipoise.estimation.tracker import tracker
from equipoise.io.recording.recording_file import read_recording, write_recording
from equipoise.io.testbed.presets import read_preset
from equipoise.maths.attitude import tilt, to_euler321
from equipoise.simulation.bench import SimulatedBench
from tests.app.dashboard.conftest import BALANCE, Room


def test_the_pages_numbers_are_the_recordings(room):
    """What is recorded while it is shown, read from the file: row by row the same."""
    room.request(requests.Record(True))
    room.turn(30)
    name = room.reported.state["recording"]
    room.request(
        requests.Jog(room.runner.station.testbed.mass_names[0], 0.004), requests.Record(False)
    )
    room.turn(20)
    kept = read_recording(room.folder / name)
    assert room.reported.state["recording"] is None
    first, last = kept.attitude.t[[0, -1]]
    assert last - first > 2.5
    for shown, channel in (("pose", kept.attitude), ("rate", kept.rate)):
        rows = room.reported.rows(shown)
        rows = rows[(rows[:, 0] > first - 1e-9) & (rows[:, 0] < last + 1e-9)]
        assert rows[:, 0] == pytest.approx(channel.t, abs=1e-9)
        assert rows[:, 1 : 1 + channel.values.shape[1]] == pytest.approx(channel.values, abs=1e-12)
    angles = np.stack(to_euler321(kept.attitude.values), axis=1)
    rows = room.reported.rows("attitude")
    assert rows[np.isin(np.round(rows[:, 0], 6), np.round(kept.attitude.t, 6)), 1:4] == (
        pytest.approx(angles, abs=1e-12)
    )


def test_every_series_has_the_columns_that_were_announced(room):
    room.turn(30)
    widths = {series.name: series.width for series in series_of(room.runner.station.testbed)}
    assert set(room.reported.parts) == set(widths)
    for name, width in widths.items():
        rows = room.reported.rows(name)
        assert rows.shape[1] == width
        assert np.all(np.diff(rows[:, 0]) >= 0), name


def test_the_live_estimate_is_that_of_the_whole_recording(nanosat):
    """Fed in tenths of a second with a move under way, or at once: to rounding."""
    bench, posterior = SimulatedBench(nanosat, 3), LiveEstimate(nanosat)
    parts = []
    for k in range(300):
        if k == 100:
            bench.move({nanosat.mass_names[0]: 0.01})
        rows = bench.read(0.1)
        parts.append(rows)
        posterior, _ = grown(posterior, rows)
    from equipoise.model.recording import joined

    whole = joined(parts)
    state = tracker.first_state(0.0, whole.attitude.values[0], nanosat)
    at_once = tracker.track(whole, nanosat, tracker.Params(), state).end
    assert posterior.state.t == at_once.t
    assert posterior.state.com == pytest.approx(at_once.com, rel=1e-6, abs=1e-12)
    assert posterior.covariance == pytest.approx(at_once.posterior.covariance, rel=1e-5, abs=1e-18)


def test_the_shown_centre_of_mass_moves_with_the_masses(nanosat):
    """A mass m sent by d along its axis: the platform's centre of mass by m d / M at once.

    The move would throw it on its stop, which no tracker models: here it may turn over.
    """
    bench, posterior = SimulatedBench(replace(nanosat, tilt_limit=np.pi), 3), LiveEstimate(nanosat)
    mass, observed = nanosat.masses[0], []
    for k in range(200):
        if k == 100:
            bench.move({mass.name: 0.01})
        rows = bench.read(0.1)
        posterior, track = grown(posterior, rows)
        observed += [v for name, v in parts_of(rows, nanosat, posterior, track) if name == "com"]
    shown = np.vstack(observed)
    before, after = shown[shown[:, 0] < 10][-1], shown[-1]
    moved = mass.mass * mass.gain * 0.01 / nanosat.body.mass * mass.axis
    assert after[1:4] - before[1:4] == pytest.approx(moved, abs=3 * float(before[4:7].max()))
    assert np.linalg.norm(moved) > 30 * before[4:7].max()


def test_a_balance_passes_and_its_report_is_kept(room, monkeypatch):
    """The truth, which the runner does not know, is where the verdict says: within 4 sd."""
    monkeypatch.setenv("EQUIPOISE_RUNS", str(room.folder))
    room.request(BALANCE)
    room.turn(2)
    words = [step["outcome"] for step in room.reported.steps]
    assert words[-1] == "passed", room.reported.steps[-1]
    assert [step["index"] for step in room.reported.steps] == list(range(len(words)))
    assert {step["of"] for step in room.reported.steps} >= {
        "measurement",
        "estimate",
        "move",
        "verify",
    }
    assert room.reported.state["goal"]["target"] == [0.0, 0.0, -100e-6]
    posterior = room.reported.state["estimate"]
    sd = np.sqrt(np.diag(np.reshape(posterior["covariance"], (3, 3))))
    off = np.array(posterior["com"]) - room.runner.station.bench.truth().com
    assert np.all(np.abs(off) < 4 * sd + 0.3e-6)
    room.runner.phase = "paused"
    room.until(lambda: room.reported.state["kept"], 900)
    kept = room.folder / room.reported.state["kept"]
    assert {"report.html", "report.pdf", "run.json"} <= {path.name for path in kept.iterdir()}


def test_a_balance_is_kept_while_masses_stand_as_the_page_says(room):
    """Half a minute more; the word of the page comes as the first verdict does, and is a step."""
    room.reported.when = lambda kind, what: (
        kind == "step" and what["of"] == "verify" and room.request(requests.Stand(True))
    )
    room.request(replace(BALANCE, tolerance=(3e-6, 3e-6, 3e-6), keep=30.0))
    room.turn(2)
    of = [step["of"] for step in room.reported.steps]
    assert of[-1] == "verify"
    assert "held for 0.5 min" in room.reported.steps[-1]["sentence"]
    (stand,) = [step for step in room.reported.steps if step["of"] == "control"]
    assert "requests that masses stand still" in stand["sentence"]
    assert of.index("control") > of.index("verify")


def test_a_stop_halts_the_masses_and_ends_the_balance(room):
    room.reported.when = lambda kind, what: (
        kind == "step" and what["of"] == "move" and (room.request(requests.Stop()))
    )
    room.request(BALANCE)
    room.turn(2)
    last = room.reported.steps[-1]
    assert (last["of"], last["outcome"]) == ("stop", "halted")
    assert "by hand" in last["sentence"]
    bench = room.runner.station.bench
    where = bench.displacements
    bench.read(5.0)
    assert bench.displacements == pytest.approx(where)
    assert room.reported.state["phase"] == "idle"


def test_a_pause_in_a_balance_holds_its_time(room):
    observed = []

    def when(kind, what):
        if kind == "step" and what["of"] == "measurement" and not observed:
            observed.append(what["t"])
            room.request(requests.Pause(True))
        if kind == "state" and what["phase"] == "held":
            observed.append(what["t"])
            room.request(requests.Stop())

    room.reported.when = when
    room.request(BALANCE)
    room.turn(2)
    assert observed[1] - observed[0] < 0.11
    assert room.reported.steps[-1]["outcome"] == "halted"


def test_what_cannot_be_done_during_a_balance_is_refused(room):
    requested = []

    def when(kind, what):
        if kind == "step" and what["of"] == "measurement" and not requested:
            requested.append(True)
            room.request(
                requests.Jog("x", 0.001), requests.Anew(5), requests.Mark("a door"), requests.Stop()
            )

    room.reported.when = when
    room.request(BALANCE)
    room.turn(2)
    assert any("in progress" in state["note"] for state in room.reported.states)
    assert "a door" in [step["sentence"] for step in room.reported.steps]
    assert room.reported.state["seed"] == 1


def test_a_jog_beyond_the_travel_is_refused_and_nothing_moves(room):
    mass = room.runner.station.testbed.masses[0]
    room.request(requests.Jog(mass.name, 2 * mass.travel[1]))
    room.turn(20)
    assert "nothing was moved" in room.reported.state["note"]
    assert not room.reported.rows("masses")[:, 1:].any()
    room.request(requests.Jog(mass.name, mass.travel[1] / 2))
    room.turn(30)
    assert room.reported.rows("masses")[-1, 1] == pytest.approx(mass.travel[1] / 2, abs=1e-4)


def test_another_platform_and_its_clock(room):
    room.turn(10)
    room.request(requests.Anew(7))
    room.turn(2)
    assert [about["clock"] for about in room.reported.about] == [1, 2]
    assert room.reported.state["seed"] == 7
    assert room.reported.state["phase"] == "paused"
    assert room.reported.parts == {}


def test_a_platform_that_falls_is_caught(room):
    room.until(lambda: room.reported.state["phase"] == "paused", 4000)
    assert "caught" in room.reported.state["note"]
    tilts = room.reported.rows("limits")[:, 1]
    assert np.nanmax(tilts) == pytest.approx(1.0, abs=0.02)  # at its stop, and not beyond


def test_identify_from_the_recorded_rows(room, monkeypatch):
    monkeypatch.setenv("EQUIPOISE_RUNS", str(room.folder))
    room.until(lambda: room.reported.state["phase"] == "paused", 4000)  # it has fallen
    room.request(requests.Identify("simplified"))
    room.until(lambda: room.reported.steps and room.reported.state["kept"], 900)
    assert "estimate" in {step["of"] for step in room.reported.steps}
    assert (room.folder / room.reported.state["kept"] / "recording.csv").is_file()


@pytest.mark.parametrize(
    "request_", [requests.Speed(-1.0), requests.Speed(float("nan")), requests.Speed(1e9)]
)
def test_a_speed_that_cannot_be_is_refused(room, request_):
    room.request(request_)
    room.turn()
    assert "speed: found" in room.reported.state["note"]


# --- Replay --------------------------------------------------------------------------------------


@pytest.fixture
def recording(nanosat, tmp_path):
    rows = SimulatedBench(nanosat, 2).read(90.0)
    write_recording(rows, tmp_path / "kept.csv")
    return rows


def test_a_replay_shows_the_recording_and_ends_with_it(room, nanosat):
    recording = SimulatedBench(nanosat, 2).read(10.0)
    write_recording(recording, room.folder / "kept.csv")
    room.request(requests.Replay("kept.csv"))
    room.until(lambda: room.reported.state["note"] == "The recording has ended.")
    rows = room.reported.rows("pose")
    assert rows[:, 0] == pytest.approx(recording.attitude.t, abs=1e-6)
    assert room.reported.about[-1]["bench"] == "replayed"


def test_going_to_a_time_shows_the_minute_before_it(room, recording, nanosat):
    room.request(requests.Replay("kept.csv"))
    room.turn(2)
    room.request(requests.Seek(80.0))
    room.turn(2)
    room.request(requests.Pause(False))
    room.turn(20)
    t = room.reported.rows("pose")[:, 0]
    assert t[0] == pytest.approx(20.0, abs=0.1)
    assert np.all(np.diff(t) > 0)
    assert 80.0 < t[-1] < 84.0
    limits = room.reported.rows("limits")
    q = recording.attitude.values[np.searchsorted(recording.attitude.t, limits[0, 0])]
    assert limits[0, 1] == pytest.approx(tilt(q, nanosat.up) / nanosat.tilt_limit, abs=1e-6)


@pytest.mark.parametrize("name", ["../kept.csv", "/etc/hostname", "nothing.csv"])
def test_a_recording_outside_of_the_data_folder_is_not_shown(room, name):
    room.request(requests.Replay(name))
    room.turn(2)
    assert "a file within" in room.reported.state["note"]
    assert room.reported.about[-1]["bench"] == "simulated"


def test_what_is_past_is_not_balanced(nanosat, recording, tmp_path):
    room = Room(replayed(nanosat, recording, "kept"), tmp_path)
    room.request(BALANCE)
    room.turn(2)
    assert "cannot be moved" in room.reported.state["note"]


def test_back_to_the_simulation(nanosat, recording, tmp_path):
    room = Room(replayed(nanosat, recording, "kept"), tmp_path)
    room.request(requests.Replay(""))
    room.turn(2)
    assert room.reported.about[-1]["bench"] == "simulated"


def test_a_real_bench_is_not_balanced_unless_somebody_holds_it(nanosat, tmp_path):
    from dataclasses import replace

    room = Room(replace(simulated(nanosat, 1), kind="real"), tmp_path)
    room.request(BALANCE)
    room.turn(2)
    assert "a person who holds it" in room.reported.state["note"]
    room.request(requests.Anew(2))
    room.turn(2)
    assert "a separate dashboard" in room.reported.state["note"]


# --- Pace ----------------------------------------------------------------------------------------


def test_time_is_held_to_the_wall_and_what_is_late_is_forgotten(monkeypatch):
    now = [100.0]
    monkeypatch.setattr("equipoise.app.live.pace.time.monotonic", lambda: now[0])
    pace = Pace(2.0)
    assert pace.wait(0.1) == pytest.approx(0.05)
    now[0] += 0.02
    assert pace.wait(0.1) == pytest.approx(0.08)  # 0.1 s of the wall for 0.2 s of the bench
    now[0] += 60.0
    assert pace.wait(0.1) == 0.0
    assert sum(pace.wait(0.1) == 0.0 for _ in range(100)) < 12  # half a second is made up for
    pace.at(0.0)
    assert pace.wait(1e9) == 0.0


def test_a_request_that_fails_as_nobody_foresaw_ends_nothing(room, crash_folder):
    """A mass that is no mass: whatever is raised is a note, with a crash file."""
    before = set(crash_folder.glob("*"))
    room.runner.station.bench.move = {}.__getitem__
    room.request(requests.Jog(room.runner.station.testbed.mass_names[0], 0.001))
    room.turn(2)
    assert "unexpected error" in room.reported.state["note"]
    assert len(set(crash_folder.glob("*")) - before) == 1
    shown = len(room.reported.rows("pose"))
    room.turn(10)
    assert len(room.reported.rows("pose")) > shown


def test_recordings_of_one_second_have_names_of_their_own(room):
    names = []
    for _ in range(3):
        room.request(requests.Record(True))
        room.turn(1)
        names.append(room.reported.state["recording"])
        room.request(requests.Record(False))
        room.turn(1)
    assert len(set(names)) == 3
    assert sorted(recordings(room.folder)) == sorted(names)


@pytest.mark.parametrize(
    ("preset", "series", "device"),
    [("georgia-tech", "gimbals", "a"), ("reference-table", "wheels", "rw_x")],
)
def test_what_devices_report_is_drawn(preset, series, device):
    """Angles of gimbals as the recording has them, as the speeds of wheels."""
    bed = read_preset(preset)
    bench = SimulatedBench(bed, 1)
    bench.drive({device: 0.005})
    rows = bench.read(2.0)
    drawn = dict(parts_of(rows, bed, LiveEstimate(bed), None))[series]
    (announced,) = [each for each in series_of(bed) if each.name == series]
    kind = {"gimbals": "gimbal", "wheels": "wheel"}[series]
    names = [f"{kind}:{name}" for name in announced.columns]
    where = [rows.device_names.index(name) for name in names]
    np.testing.assert_array_equal(drawn[:, 1:], rows.devices.values[:, where])
    assert abs(drawn[-1, 1 + names.index(f"{kind}:{device}")]) > 0.003
