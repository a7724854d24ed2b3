"""The runner at a real bench: emulated devices behind real ports, on a clock of their own."""

import contextlib
from dataclasses import replace

import numpy as np
import pytest

from equipoise.app.dashboard.protocol import requests
from equipoise.app.dashboard.runner.benches import Station
from equipoise.io.testbed.presets import read_preset
from tests.app.dashboard.conftest import BALANCE, Room
from tests.support import emulated_lab, thorough
from tests.support.emulated_lab import over_tcp
from tests.support.faulty_wire import silent

BED = over_tcp(read_preset("nanosat"))
HELD = replace(BALANCE, held=True)


@contextlib.contextmanager
def shown(folder, bed=BED, seed=3):
    """Lend a room whose runner has the bench as the dashboard has it: watched, at rest."""
    found = emulated_lab.Lab(bed, seed)
    room = Room(Station("real", found.bench, f"{bed.name}, real"), folder)
    try:
        found.bench.watch()
        yield room, found
    finally:
        room.runner.close()
        found.keeper.close()
        found.emulated.close()


def notes(room):
    return [state["note"] for state in room.reported.states]


def in_turn(room, *words):
    """Say whether notes with these words came one after the other."""
    said = iter(notes(room))
    return all(any(word in note for note in said) for word in words)


@thorough.whole
def test_a_real_bench_is_practised_homed_let_go_and_balanced(tmp_path, monkeypatch):
    """The truth is where the verdict says, within 4 sd; the page's rows are the devices' own."""
    monkeypatch.setenv("EQUIPOISE_RUNS", "")
    with shown(tmp_path) as (room, found):
        room.turn(10)
        room.request(HELD)
        room.turn(2)
        assert in_turn(room, "Practice", "The masses move home: hold", "release the platform")
        words = [step["outcome"] for step in room.reported.steps]
        assert words[-1] == "passed", room.reported.steps[-1]
        truth = found.emulated.platform.truth().com
        posterior = room.reported.state["estimate"]
        sd = np.sqrt(np.diag(np.reshape(posterior["covariance"], (3, 3))))
        assert np.all(np.abs(np.array(posterior["com"]) - truth) < 4 * sd + 0.3e-6)
        assert np.all(np.abs(truth - HELD.target) < HELD.tolerance)
        t = room.reported.rows("pose")[:, 0]
        assert np.all(np.diff(t) > 0)
        late = t[t > t[-1] - 30.0]  # s: since it was let go
        assert np.ptp(late) / (len(late) - 1) == pytest.approx(1 / BED.attitude.rate, rel=0.01)


def test_a_stop_halts_a_real_bench(tmp_path, monkeypatch):
    monkeypatch.setenv("EQUIPOISE_RUNS", "")
    with shown(tmp_path) as (room, found):
        room.reported.when = lambda kind, what: (
            kind == "step" and what["of"] == "move" and room.request(requests.Stop())
        )
        room.request(HELD)
        room.turn(2)
        last = room.reported.steps[-1]
        assert (last["of"], last["outcome"]) == ("stop", "halted")
        assert "by hand" in last["sentence"]
        found.wait(0.2)
        where = found.emulated.platform.truth().com
        found.wait(2.0)
        assert found.emulated.platform.truth().com == pytest.approx(where, abs=1e-12)


@thorough.whole
def test_an_interlock_ends_a_balancing_and_is_shown(tmp_path, monkeypatch):
    """The IMU falls silent in the midst: the masses halt, and the page says why."""
    monkeypatch.setenv("EQUIPOISE_RUNS", "")
    with shown(tmp_path) as (room, found):

        def when(kind, what):
            if kind == "step" and what["of"] == "measurement":
                found.imu.wire.spoil = silent

        room.reported.when = when
        room.request(HELD)
        room.turn(2)
        assert room.reported.steps[-1]["outcome"] == "halted"
        assert "no sensor has delivered a row" in room.reported.state["trip"]
        assert room.reported.state["phase"] == "idle"


def test_a_mass_is_sent_by_hand_and_not_beyond_its_travel(tmp_path):
    free = replace(BED, tilt_limit=3.0)
    with shown(tmp_path, free) as (room, found):
        found.bench.start()
        found.bench.watch()
        room.request(requests.Jog("x", 4e-3))
        room.turn(20)
        assert room.reported.rows("masses")[-1, 1] == pytest.approx(4e-3, abs=2e-6)
        room.request(requests.Jog("x", 1.0))
        room.turn(5)
        assert "nothing was moved" in notes(room)[-1]
        assert room.reported.rows("masses")[-1, 1] == pytest.approx(4e-3, abs=2e-6)
