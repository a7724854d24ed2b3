"""A service that stops and a terminal that is gone, in the middle of a move: halt, account, report.

Masses of 1 mm/s that are at home: the first move comes soon and lasts some seconds. A computer that
is busy may pause a device for so long that an interlock stops the masses, as it should; then the
command is tried again.
"""

import json
import signal
import time
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from equipoise.io.recording.recording_file import read_recording
from equipoise.io.testbed.presets import read_preset
from equipoise.io.testbed.testbed_file import write_testbed

pytest.importorskip("pty", reason="no pseudo terminals, no SIGHUP")
from tests.support import thorough
from tests.support.emulating_program import emulating
from tests.support.pseudo_terminal import PATIENCE, AtTerminal
from tests.support.recorded_events import events_of

SPEED = 1e-3  # m/s
INTO = 1.5  # s into a move
TRIES = 3


@pytest.fixture(scope="module")
def bench(tmp_path_factory):
    """Return the folder with the testbed file of a bench whose masses are slow."""
    folder, bed = tmp_path_factory.mktemp("slow"), read_preset("nanosat")
    masses = tuple(replace(mass, speed=SPEED) for mass in bed.masses)
    (board,) = bed.hardware.boards
    hardware = replace(bed.hardware, boards=(replace(board, homing=False),))
    # It swings from the start, since no homing holds it: where stops are the matter, it may.
    bed = replace(bed, masses=masses, hardware=hardware, tilt_limit=3.0)
    write_testbed(bed, folder / "slow.toml")
    with emulating(folder, "slow.toml", ended_with=signal.SIGTERM):
        yield folder


def move_of(record):
    """Return the time and the targets of the first move in a record, None before it."""
    moves = [e for e in events_of(record) if e.kind == "command" and e.sentence.startswith("go")]
    return moves[0] if moves else None


def in_a_move(bench, record):
    """Return a balancing at a terminal, some time into its first move unless it is over."""
    words = ("balance", "there.toml", "--bench", "--yes", "--record", record, "--out", record.stem)
    balancing, end = AtTerminal(bench, words), time.monotonic() + PATIENCE
    while not balancing.over and (not record.exists() or move_of(record) is None):
        if time.monotonic() > end:
            raise TimeoutError(balancing.written)
        time.sleep(0.1)
    time.sleep(INTO)
    return balancing


def hung_up(balancing):
    balancing.hang_up()
    return balancing.ended()


def terminated(balancing):
    """Tell every process, as a service manager does."""
    if not balancing.over:
        balancing.send_all(signal.SIGTERM)
    return balancing.ended()


STOPS = {"SIGHUP": (hung_up, 129), "SIGTERM": (terminated, 143)}


@thorough.whole
@pytest.mark.parametrize("name", STOPS)
def test_the_middle_of_a_move(bench, name):
    stop, wanted = STOPS[name]
    for k in range(TRIES):
        record = bench / f"{name}{k}.mcap"
        balancing = in_a_move(bench, record)
        stopped = not balancing.over
        code = stop(balancing)
        if stopped and [e.kind for e in events_of(record)].count("interlock") == 0:
            break
    assert code == wanted, balancing.written
    assert "Traceback" not in balancing.written
    reported = json.loads((bench / record.stem / "balance.json").read_text())
    assert reported["verdict"]["code"] == "stopped_by_signal"
    assert reported["verdict"]["reasons"][0]["parameters"][0] == name
    assert (bench / record.stem / "report.html").stat().st_size > 0
    check_stopped(record)


def check_stopped(record: Path) -> None:
    """The record is whole, the halt is in it, and masses came to rest far from their targets."""
    went, masses = move_of(record), read_recording(record).masses
    longest = max(went.data.values(), key=abs)
    assert abs(longest) / SPEED > 2 * INTO  # s: it was in the middle
    assert [e.sentence for e in events_of(record) if e.kind == "command"][-1] == "halt"
    order = read_recording(record).mass_names
    left = np.abs(masses.values[-1] - [went.data[name] for name in order])
    assert left.max() > 0.3 * abs(longest)
    assert {"health", "start"} <= {event.kind for event in events_of(record)}
