"""Grbl: transcripts of its public documentation; what every board does is in ``test_boards``."""

from dataclasses import replace

import pytest

from equipoise.hardware.boards.grbl.report import (
    Code,
    Greeting,
    MachineState,
    Setting,
    Status,
    Word,
    parsed,
)
from equipoise.hardware.boards.grbl.settings import disagreement
from equipoise.model.reasons.board_faults import BoardFault
from equipoise.model.units import MM
from tests.support.board_wire import BED, Wire, board_of

BOARD = board_of("grbl")


def test_the_documented_lines_are_understood():
    """The wiki's examples of status, settings, errors, alarms and the welcome."""
    assert parsed(b"<Idle|MPos:0.000,0.000,0.000|FS:0.0,0>") == Status(
        MachineState.IDLE, machine=(0.0, 0.0, 0.0), feed=0.0
    )
    assert parsed(b"<Hold:1|WPos:-5.529,0.560,7.000|WCO:1.000,0.000,-2.000>") == Status(
        MachineState.HOLD, work=(-5.529, 0.56, 7.0), offset=(1.0, 0.0, -2.0), detail=1
    )
    assert parsed(b"ok") is Word.OK
    assert parsed(b"error:9") == Code(False, 9)
    assert parsed(b"ALARM:1") == Code(True, 1)
    assert parsed(b"$110=500.000 (x max rate, mm/min)") == Setting(110, 500.0)
    assert parsed(b"Grbl 1.1h ['$' for help]") == Greeting("Grbl 1.1h ['$' for help]", old=False)
    for broken in (b"<Idle|MPos:0.0,nan,0.0>", b"<Idle|MPos", b"rror:9", b"$1x=3", b"\xff\xfe"):
        assert parsed(broken) is None


def test_it_homes_by_its_own_cycle_or_is_unlocked():
    assert b"$H\n" in Wire("grbl").at_home().sent
    sent = Wire("grbl", board_of("grbl", homing=False)).at_home().sent
    assert b"$X\n" in sent
    assert b"$H" not in sent


def test_a_way_goes_by_jogs_in_machine_coordinates_of_its_zero():
    """From home, -17 mm, 4 mm out is -13 mm; 8 mm/s are 480 mm/min."""
    wire = Wire("grbl").at_home()
    wire.sent = b""
    wire.driver.go({"x": 4 * MM}, wire.t)
    state = wire.run(1.5)
    assert (state.phase, state.position["x"]) == ("ready", pytest.approx(4 * MM, abs=2e-6))
    assert b"$J=G53 G21 G90 X-15.0000 F480.00\n" in wire.sent  # the first quarter of a second
    assert b"$J=G53 G21 G90 X-13.0000 F480.00\n" in wire.sent
    assert wire.legs[-1].displacement == pytest.approx(4 * MM, abs=1e-9)


def test_a_reversed_axis_counts_down():
    axes = tuple(replace(axis, reversed=axis.mass == "x") for axis in BOARD.axes)
    wire = Wire("grbl", replace(BOARD, axes=axes)).at_home()
    wire.driver.go({"x": 4 * MM}, wire.t)
    wire.run(1.5)
    assert b"X-21.0000" in wire.sent


SETTINGS = {13: 0, 20: 1, 22: 1} | {
    base + k: value for base, value in ((100, 800.0), (110, 480.0), (130, 40.0)) for k in range(3)
}


@pytest.mark.parametrize(
    ("key", "value", "said"),
    [
        (13, 1, "inches"),
        (22, 0, "homing is off"),
        (20, 0, "soft limits are off"),
        (101, 400.0, r"\$101=400 steps per mm of Y; the testbed says 800"),
        (112, 400.0, r"\$112=400 mm/min at most of Z; mass z is to go with 480"),
        (130, 30.0, r"mass x needs -32 to -2 mm"),
    ],
)
def test_settings_that_differ_from_the_testbed_are_named(key, value, said):
    assert disagreement(BOARD, BED.masses, SETTINGS) == ""
    with pytest.raises(AssertionError, match=said):
        raise AssertionError(disagreement(BOARD, BED.masses, SETTINGS | {key: value}))


def test_a_board_that_is_set_otherwise_is_a_fault():
    wire = Wire("grbl")
    wire.remote.board.settings[100] = 80.0
    state = wire.run(2.0)
    assert state.phase == "fault"
    assert "$100=80 steps per mm" in state.sentence


def test_a_status_that_lost_an_axis_is_broken_and_changes_nothing():
    """A cable ate ',-17.000' of a whole line: found by noise at random moments of a balancing."""
    wire = Wire("grbl").at_home()
    before, corrupt = wire.driver.state, wire.driver.counts.corrupt
    wire.driver.feed(b"<Idle|MPos:-17.000,-17.000|FS:0,0>\r\n", wire.t + 0.01)
    assert wire.driver.state == before
    assert wire.driver.counts.corrupt == corrupt + 1
    wire.driver.go({"z": 1 * MM}, wire.t)
    assert wire.run(1.0).position["z"] == pytest.approx(1 * MM, abs=2e-6)


def test_masses_that_stand_on_their_way_are_a_fault(monkeypatch):
    """A board that refuses every jog moves nothing, however often it answers."""
    wire = Wire("grbl").at_home()
    monkeypatch.setattr(wire.remote.board, "_jog", lambda _line: b"error:8\r\n")
    wire.driver.go({"x": 4 * MM}, wire.t)
    state = wire.run(6.0, until="fault")
    assert state.fault is not None
    assert state.fault.code is BoardFault.STALLED
    assert state.fault.numbers["waited"] == pytest.approx(5.0, abs=0.2)


def test_a_way_of_less_than_half_a_step_is_over_at_once():
    """A step is 1.25 um here: 0.5 um are none, and 1 um is one."""
    wire = Wire("grbl").at_home()
    wire.driver.go({"x": 0.5e-6}, wire.t)
    assert wire.run(1.0, until="ready").goal["x"] == 0.5e-6
    assert wire.true("x") == pytest.approx(0.0, abs=1e-9)
    wire.driver.go({"x": 1e-6}, wire.t)
    wire.run(1.0, until="ready")
    assert wire.true("x") == pytest.approx(1.25e-6, abs=1e-9)
