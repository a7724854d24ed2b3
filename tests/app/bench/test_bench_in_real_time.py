"""The commands of a real bench as a person runs them: programs, pseudo terminals, the wall's clock.

The bench is `equipoise emulate` in a program of its own. A computer that is busy may pause a device
for so long that an interlock stops the masses, as it should; then the command is tried again.
"""

import json
import signal
import subprocess
import time

import pytest
from websockets.sync.client import connect

from equipoise.app.cli import BY_HAND
from equipoise.io.mcap.foxglove_server import ADDRESS
from equipoise.io.recording.recording_file import read_recording
from tests.support.recorded_events import events_of

pytest.importorskip("pty", reason="no pseudo terminals, no SIGINT")
from tests.support import thorough
from tests.support.emulating_program import emulating
from tests.support.pseudo_terminal import PROGRAM, AtTerminal, screen, stripped

TRIES, PATIENCE = 3, 120.0  # s
LET_GO = "let the platform go"


@pytest.fixture(scope="module")
def bench(tmp_path_factory):
    """Return the folder with the testbed file of a bench that is there."""
    folder = tmp_path_factory.mktemp("bench")
    with emulating(folder, "nanosat"):
        yield folder


def begun(folder, *words):
    """Return a command that has been started."""
    return subprocess.Popen(
        [*PROGRAM, *map(str, words)],
        cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
    )  # fmt: skip


def ended(command):
    """Return exit code and what it has said."""
    out, err = command.communicate(timeout=PATIENCE)
    return command.returncode, out, err


def test_check_finds_a_sound_bench_sound(bench):
    for _ in range(TRIES):
        code, out, _err = ended(begun(bench, "check", "there.toml", "--yes"))
        if code == 0:
            break
    problems = [line for line in out.splitlines() if "PROBLEM" in line]
    scattered = [line for line in problems if "intervals vary" in line]
    assert problems == scattered
    assert "board masses: answers, settings agree, x, y, z at home" in out
    assert [f"mass {name}: moved 1 mm and back" in out for name in "xyz"] == [True] * 3
    assert "messages" in out
    if scattered:
        pytest.skip("the computer was too busy for real time: rows came at odd intervals")


def offered(address):
    """Return the topics that a live view offers within some seconds."""
    end, topics = time.monotonic() + PATIENCE, set()
    while time.monotonic() < end:
        try:
            with connect(address, subprotocols=["foxglove.sdk.v1"]) as client:
                while {"/attitude", "/rate"} - topics:
                    reported = json.loads(client.recv(5.0))
                    topics |= {each["topic"] for each in reported.get("channels", [])}
                return topics
        except (OSError, TimeoutError):
            time.sleep(0.05)
    return topics


def test_record_writes_its_rows_while_other_clients_watch(bench):
    """Ctrl-C ends it early; the rows are kept, and how well each device communicated."""
    command = begun(bench, "record", "there.toml", "--out", "kept.mcap", "--foxglove",
                    "--duration-s", 600)  # fmt: skip
    assert {"/attitude", "/rate"} <= offered(ADDRESS)
    time.sleep(2.0)
    command.send_signal(signal.SIGINT)
    code, out, err = ended(command)
    assert (code, "wrote kept.mcap" in out) == (0, True)
    rows = read_recording(bench / "kept.mcap").attitude
    assert len(rows) > 40  # 40 Hz, stated
    assert "sensor imu: " in err
    assert {"health", "start"} <= {event.kind for event in events_of(bench / "kept.mcap")}


@thorough.whole
def test_record_shows_at_a_terminal_what_it_sees(bench):
    """Ctrl-C ends it early and leaves nothing of the live block on the screen."""
    words = ("record", "there.toml", "--out", "shown.mcap", "--duration-s", 600)
    observed = AtTerminal(bench, words)
    observed.wait_for(" deg, 4 s")
    observed.ctrl_c()
    assert observed.ended() == 0
    reported = stripped(observed.written)
    for text in ("% of 600 s  shown.mcap", "rows        attitude ", "deg/s", "recording ..."):
        assert text in reported
    left = screen(observed.written)
    assert left[-1] == "wrote shown.mcap"
    assert all(line.startswith(("board masses: ", "sensor imu: ")) for line in left[:-1])


def balancing(bench, record):
    """Return a balancing of which the platform has been let go for some seconds."""
    words = ("balance", "there.toml", "--bench", "--yes", "--record", record, "--out", record.stem)
    command = begun(bench, *words)
    for line in command.stderr:
        if LET_GO in line:
            break
    time.sleep(3.0)
    return command


@thorough.whole
def test_the_first_ctrl_c_stops_and_saves(bench):
    for k in range(TRIES):
        record = bench / f"first{k}.mcap"
        command = balancing(bench, record)
        command.send_signal(signal.SIGINT)
        code, out, err = ended(command)
        if "stopped by hand: every mass was halted" in (out + err).lower():
            break
    assert code == BY_HAND
    reported = json.loads((bench / record.stem / "balance.json").read_text())
    assert reported["verdict"]["code"] == "stopped_by_hand"
    assert "Stopped by the user: every mass was halted" in reported["verdict"]["sentence"]
    assert "seed" not in reported["provenance"]
    assert "command" in [event.kind for event in events_of(record)]
    assert read_recording(record).attitude.t[-1] > 2.0


@thorough.whole
def test_the_second_ctrl_c_leaves_at_once(bench):
    """While it draws what it saves; the record is there all the same."""
    for k in range(TRIES):
        record = bench / f"second{k}.mcap"
        command = balancing(bench, record)
        command.send_signal(signal.SIGINT)
        for line in command.stderr:
            if "drawing" in line:
                break
        command.send_signal(signal.SIGINT)
        code, out, err = ended(command)
        if "stopped by hand" in (out + err).lower():
            break
    assert code == BY_HAND, err
    assert not record.with_suffix("").exists()
    assert read_recording(record).attitude.t[-1] > 2.0


def test_an_unreachable_bench_is_reported_before_any_rehearsal(equipoise, tmp_path):
    reported = equipoise("balance", "nanosat", "--bench", "--yes")
    assert reported.code == 2
    assert "board masses cannot be reached: serial:/dev/ttyUSB0" in reported.err
    assert "practising" not in reported.err
    (tmp_path / "kept.mcap").write_text("a record")
    reported = equipoise("balance", "nanosat", "--bench", "--record", "kept.mcap")
    assert (reported.code, "a file that exists" in reported.err) == (2, True)
    reported = equipoise("balance", "kau", "--bench")
    assert (reported.code, "found no hardware" in reported.err) == (2, True)
    reported = equipoise("balance", "nanosat", "--foxglove")
    assert (reported.code, "--foxglove: found no --bench" in reported.err) == (2, True)
