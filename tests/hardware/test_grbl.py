"""Grbl: transcripts of its public documentation, and the driver at the emulated firmware."""

from dataclasses import replace

import pytest

from equipoise.hardware.boards.grbl import Grbl
from equipoise.hardware.boards.grbl_report import Code, Ok, Setting, Status, Welcome, parsed
from equipoise.hardware.boards.grbl_settings import disagreement
from equipoise.hardware.boards.legs import next_leg
from equipoise.hardware.driver import LEG
from equipoise.hardware.emulated.grbl import EmulatedGrbl
from equipoise.io.presets import read_preset
from equipoise.model.errors import BenchStopped

BED = read_preset("nanosat")  # 8 mm/s, zero at -17 mm, 800 steps per mm
(BOARD,) = BED.hardware.boards
MM = 1e-3
TURN = 0.01  # s


class Wire:
    """A driver and the emulated firmware, turn by turn, and the way of every mass."""

    def __init__(self, board=BOARD):
        self.driver = Grbl(board, BED.masses)
        self.far = EmulatedGrbl(board, BED.masses)
        self.t, self.sent, self.legs, self.cut = 0.0, b"", [], False
        self.driver.opened(0.0)

    def run(self, seconds, listen=True):
        """Let time pass; ``listen=False`` is a computer that has died."""
        end = self.t + seconds
        while self.t < end - 1e-9:
            self.t = round(self.t + TURN, 9)
            said, legs = self.far.run(self.t)
            self.legs += legs
            if self.cut or not listen:
                continue
            self.driver.feed(said, self.t)
            told = self.driver.due(self.t)
            self.sent += told
            self.driver.feed(self.far.take(told, self.t), self.t)
        return self.driver.state

    def at_home(self):
        self.run(0.5)
        self.driver.home(self.t)
        assert self.run(12.0).phase == "ready"
        return self


def test_the_documented_lines_are_understood():
    """The wiki's examples of status, settings, errors, alarms and the welcome."""
    assert parsed(b"<Idle|MPos:0.000,0.000,0.000|FS:0.0,0>") == Status(
        "Idle", (0.0, 0.0, 0.0), None, None
    )
    assert parsed(b"<Hold:1|WPos:-5.529,0.560,7.000|WCO:1.000,0.000,-2.000>") == Status(
        "Hold", None, (-5.529, 0.56, 7.0), (1.0, 0.0, -2.0)
    )
    assert parsed(b"ok") == Ok()
    assert parsed(b"error:9") == Code(False, 9)
    assert parsed(b"ALARM:1") == Code(True, 1)
    assert parsed(b"$110=500.000 (x max rate, mm/min)") == Setting(110, 500.0)
    assert parsed(b"Grbl 1.1h ['$' for help]") == Welcome()
    for broken in (b"<Idle|MPos:0.0,nan,0.0>", b"<Idle|MPos", b"rror:9", b"$1x=3", b"\xff\xfe"):
        assert parsed(broken) is None


def test_it_homes_and_then_knows_where_masses_are():
    wire = Wire()
    assert wire.run(0.5).phase == "ready"
    assert not wire.driver.state.sure
    with pytest.raises(BenchStopped, match="position"):
        wire.driver.go({"x": 1 * MM}, wire.t)
    wire.driver.home(wire.t)
    state = wire.run(12.0)
    assert (state.phase, state.sure) == ("ready", True)
    assert state.position == pytest.approx({"x": 0.0, "y": 0.0, "z": 0.0}, abs=2e-6)
    assert b"$H\n" in wire.sent


def test_a_way_goes_by_jogs_in_machine_coordinates_of_its_zero():
    """From home, -17 mm, 4 mm out is -13 mm; 8 mm/s are 480 mm/min."""
    wire = Wire().at_home()
    wire.sent = b""
    wire.driver.go({"x": 4 * MM}, wire.t)
    state = wire.run(1.5)
    assert (state.phase, state.position["x"]) == ("ready", pytest.approx(4 * MM, abs=2e-6))
    assert b"$J=G53 G21 G90 X-15.0000 F480.00\n" in wire.sent  # the first quarter of a second
    assert b"$J=G53 G21 G90 X-13.0000 F480.00\n" in wire.sent
    assert wire.legs[-1].displacement == pytest.approx(4 * MM, abs=1e-9)


def test_a_reversed_axis_goes_the_other_way():
    axes = tuple(replace(a, reversed=a.letter == "X", zero=-0.017) for a in BOARD.axes)
    wire = Wire(replace(BOARD, axes=axes)).at_home()
    wire.sent = b""
    wire.driver.go({"x": 4 * MM}, wire.t)
    assert wire.run(1.5).position["x"] == pytest.approx(4 * MM, abs=2e-6)
    assert b"X-21.0000" in wire.sent


def test_each_mass_goes_at_its_own_speed_until_it_is_there():
    """1 mm and 4 mm at 8 mm/s: first both for 0.125 s, then one alone."""
    speed = dict.fromkeys("xy", 8 * MM)
    way = next_leg({"x": 0.0, "y": 0.0}, {"x": 1 * MM, "y": -4 * MM}, speed)
    assert way.duration == pytest.approx(0.125)
    assert way.to == pytest.approx({"x": 1 * MM, "y": -1 * MM})
    way = next_leg({"x": 1 * MM, "y": -1 * MM}, {"x": 1 * MM, "y": -4 * MM}, speed)
    assert way.duration == pytest.approx(LEG)
    assert way.to == pytest.approx({"y": -3 * MM})


def test_a_board_whose_computer_has_died_stands_within_half_a_second():
    wire = Wire().at_home()
    wire.driver.go({"x": 14 * MM}, wire.t)
    wire.run(0.6)
    died = wire.t
    wire.run(3.0, listen=False)
    last = wire.legs[-1].end
    assert died < last <= died + 2 * LEG + 0.05
    assert wire.legs[-1].displacement < 10 * MM


def test_a_halt_stops_at_once_and_the_position_stays_known():
    wire = Wire().at_home()
    wire.driver.go({"x": 14 * MM}, wire.t)
    wire.run(0.6)
    halted = wire.t
    wire.driver.halt(wire.t)
    state = wire.run(1.0)
    assert wire.legs[-1].end <= halted + 0.1
    assert (state.phase, state.sure) == ("ready", True)
    assert state.goal == state.position
    stands = [leg.displacement for leg in wire.legs if leg.mass == "x"][-1]
    assert state.position["x"] == pytest.approx(stands, abs=2e-6)
    wire.driver.go({"x": 0.0}, wire.t)
    assert wire.run(2.0).position["x"] == pytest.approx(0.0, abs=2e-6)


@pytest.mark.parametrize(
    ("trouble", "said"),
    [
        (lambda far: far.press_reset(), "position is lost"),
        (lambda far: far.hit_limit(), "a limit switch was hit"),
        (lambda far: far.switch(False), "unplugged, or without power"),
    ],
)
def test_trouble_in_a_way_is_a_fault_in_words_and_ends_with_homing(trouble, said):
    wire = Wire().at_home()
    wire.driver.go({"x": 14 * MM}, wire.t)
    wire.run(0.6)
    trouble(wire.far)
    state = wire.run(0.5)
    assert state.phase == "fault"
    assert said in state.sentence
    assert not state.sure
    with pytest.raises(BenchStopped, match=said):
        wire.driver.go({"x": 0.0}, wire.t)
    wire.far.switch(True)
    wire.run(0.2)
    wire.driver.home(wire.t)
    state = wire.run(12.0)
    assert (state.phase, state.sure) == ("ready", True)
    assert state.position["x"] == pytest.approx(0.0, abs=2e-6)


def test_a_board_without_switches_is_at_home_when_a_person_says_so():
    wire = Wire(replace(BOARD, homing=False))
    wire.run(0.5)
    wire.driver.home(wire.t)
    assert wire.run(1.0).sure
    wire.driver.go({"z": -2 * MM}, wire.t)
    wire.run(1.0)
    assert wire.legs[-1].displacement == pytest.approx(-2 * MM, abs=1e-9)
    assert b"$H" not in wire.sent


def test_nobody_at_the_other_end_is_told():
    driver = Grbl(BOARD, BED.masses)
    driver.opened(0.0)
    for k in range(500):
        driver.due(k * TURN)
    assert "does not answer" in driver.state.sentence


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
    wire = Wire()
    wire.far._settings[100] = 80.0
    state = wire.run(0.5)
    assert state.phase == "fault"
    assert "$100=80 steps per mm" in state.sentence
