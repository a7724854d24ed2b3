"""The emulated Grbl 1.1h does what the firmware's documents say, state by state, byte by byte.

Table and transcripts: Grbl 1.1 wiki, "Interface" (real-time commands, states, errors, alarms),
"Jogging", "Commands"; what a cancel does while a jog ends is the published firmware's order of
flags (``protocol``: report, hold and cancel, cycle start, cycle stop).
"""

import re

import pytest

from equipoise.hardware.emulated.grbl.firmware import EmulatedGrbl
from equipoise.model.units import MM
from tests.support.board_wire import BED, board_of

JOG, BEYOND, LONG = b"$J=G53G21G90X-10F480\n", b"$J=G53G21G90X-250F480\n", b"x" * 90 + b"\n"
GREETING = rb"\r\nGrbl 1\.1h \['\$' for help\]\r\n"
LOCK = rb"\[MSG:'\$H'\|'\$X' to unlock\]\r\n"


class Machine:
    """An emulated board that has homed."""

    def __init__(self, **changes):
        self.board = EmulatedGrbl(board_of("grbl", **changes), BED.masses)
        self.t, self.legs = 0.0, []
        self.wait(2.0)

    def wait(self, seconds):
        """Let time pass; return what is said."""
        self.t = round(self.t + seconds, 9)
        said, legs = self.board.run(self.t)
        self.legs += legs
        return said

    def say(self, data, then=0.01):
        """Send bytes; return what is said to them within a moment."""
        return self.board.take(data, self.t) + self.wait(then)

    @property
    def state(self):
        """Return what it reports; None where it says nothing."""
        match = re.search(rb"<([^|]*)\|", self.say(b"?"))
        return match and match[1].decode()

    @property
    def x(self):
        """Return where the first axis is, mm."""
        return float(re.search(rb"MPos:([-.0-9]+)", self.say(b"?"))[1])

    def until(self, state, patience=30.0):
        """Wait for a state."""
        end = self.t + patience
        while self.state != state and self.t < end:
            self.wait(0.01)
        return self


def idle():
    machine = Machine()
    machine.say(b"$H\n", 30.0)
    return machine.until("Idle")


def jog():
    machine = idle()
    machine.say(JOG, 0.2)
    assert machine.state == "Jog"
    return machine


def run():
    """A jog that comes when 0.02 mm of the one before are left: at 8 mm/s, 2.5 ms."""
    machine = idle()
    assert machine.x == -1.0
    machine.say(b"$J=G53G21G90X-5F480\n", 0.0)
    machine.wait(0.02 + 0.5 - 0.004)
    assert machine.say(JOG, 0.1) == b"ok\r\n"
    assert machine.state == "Run"
    return machine


def held():
    machine = run()
    machine.say(b"!", 0.2)
    return machine


def homing():
    machine = Machine()
    machine.say(b"$H\n", 0.5)
    return machine


def alarm():
    return Machine()


def limit():
    machine = jog()
    machine.board.hit_limit()
    machine.wait(0.1)
    return machine


def check():
    machine = idle()
    machine.say(b"$C\n")
    return machine


def door():
    machine = idle()
    machine.board.open_door(True)
    machine.wait(0.1)
    return machine


def sleep():
    machine = idle()
    machine.say(b"$SLP\n")
    return machine


NOTHING = b""
TABLE = [
    # state, input, what is said, the state a moment later
    (idle, b"?", rb"<Idle\|MPos:.*\|FS:0,0.*>\r\n", "Idle"),
    (idle, b"!", NOTHING, "Hold:0"),
    (idle, b"~", NOTHING, "Idle"),
    (idle, b"\x85", NOTHING, "Idle"),
    (idle, b"\x18", GREETING, "Idle"),
    (idle, b"\n", rb"ok\r\n", "Idle"),
    (idle, JOG, rb"ok\r\n", "Jog"),
    (idle, BEYOND, rb"error:15\r\n", "Idle"),
    (idle, b"$J=G53G21G90X-10\n", rb"error:22\r\n", "Idle"),
    (idle, b"$J=G53G21G90X-10F0\n", rb"error:22\r\n", "Idle"),
    (idle, LONG, rb"error:11\r\n", "Idle"),
    (idle, b"$X\n", rb"ok\r\n", "Idle"),
    (idle, b"$C\n", rb"\[MSG:Enabled\]\r\nok\r\n", "Check"),
    (idle, b"$SLP\n", rb"ok\r\n", "Sleep"),
    (idle, b"$1=30\n", rb"ok\r\n", "Idle"),
    (idle, b"$77=30\n", rb"error:3\r\n", "Idle"),
    (jog, JOG, rb"ok\r\n", "Jog"),
    (jog, b"~", NOTHING, "Jog"),
    (jog, b"G0X-2\n", rb"error:9\r\n", "Jog"),
    (jog, b"$H\n", rb"error:8\r\n", "Jog"),
    (jog, b"$C\n", rb"error:8\r\n", "Jog"),
    (jog, b"$1=30\n", rb"error:8\r\n", "Jog"),
    (jog, b"$SLP\n", rb"error:8\r\n", "Jog"),
    (jog, b"\x18", rb"ALARM:3\r\n" + GREETING + LOCK, "Alarm"),
    (run, b"\x85", NOTHING, "Run"),
    (run, JOG, rb"error:8\r\n", "Run"),
    (run, b"$$\n", rb"error:8\r\n", "Run"),
    (run, b"!", NOTHING, "Hold:1"),
    (run, b"\x18", rb"ALARM:3\r\n" + GREETING + LOCK, "Alarm"),
    (held, b"?", rb"<Hold:0\|.*>\r\n", "Hold:0"),
    (held, JOG, NOTHING, "Hold:0"),
    (held, b"\x85", NOTHING, "Hold:0"),
    (held, b"~", NOTHING, "Run"),
    (held, b"\x18", GREETING, "Idle"),
    (homing, b"?", NOTHING, None),
    (homing, JOG, NOTHING, None),
    (homing, b"!", NOTHING, None),
    (homing, b"\x18", rb"ALARM:6\r\n" + GREETING + LOCK, "Alarm"),
    (alarm, JOG, rb"error:8\r\n", "Alarm"),
    (alarm, b"G0X-2\n", rb"error:9\r\n", "Alarm"),
    (alarm, b"!", NOTHING, "Alarm"),
    (alarm, b"~", NOTHING, "Alarm"),
    (alarm, b"$C\n", rb"error:8\r\n", "Alarm"),
    (alarm, b"$X\n", rb"\[MSG:Caution: Unlocked\]\r\nok\r\n", "Idle"),
    (alarm, b"$H\n", NOTHING, None),
    (alarm, b"\x18", GREETING + LOCK, "Alarm"),
    (limit, b"?", NOTHING, None),
    (limit, b"$X\n", NOTHING, None),
    (limit, b"\x18", GREETING + LOCK, "Alarm"),
    (check, JOG, rb"error:8\r\n", "Check"),
    (check, b"G0X-2\n", rb"ok\r\n", "Check"),
    (check, b"!", NOTHING, "Check"),
    (check, b"$C\n", GREETING, "Idle"),
    (door, b"?", rb"<Door:1\|.*>\r\n", "Door:1"),
    (door, JOG, NOTHING, "Door:1"),
    (door, b"~", NOTHING, "Door:1"),
    (sleep, b"?", rb"<Sleep\|.*>\r\n", "Sleep"),
    (sleep, JOG, NOTHING, "Sleep"),
    (sleep, b"\x18", GREETING + LOCK, "Alarm"),
]


@pytest.mark.parametrize(
    ("state", "said", "reply", "after"),
    [pytest.param(*row, id=f"{row[0].__name__}-{row[1][:8]!r}") for row in TABLE],
)
def test_each_state_answers_each_input_as_the_documents_say(state, said, reply, after):
    machine = state()
    assert re.fullmatch(reply, machine.say(said), re.DOTALL)
    assert machine.state == after


def test_a_listing_has_every_setting_and_an_ok():
    said = idle().say(b"$$\n", 0.2).split(b"\r\n")
    assert said[-2:] == [b"ok", b""]
    assert {b"$1=25", b"$20=1", b"$100=800.000", b"$130=200.000"} <= set(said)


def test_a_cancelled_jog_stands_and_is_thrown_away():
    """8 mm/s with 160 mm/s^2: 0.05 s and 0.2 mm; then twice 25 ms, both still in state Jog."""
    machine = jog()
    machine.say(JOG.replace(b"-10", b"-12"))
    at = machine.x
    machine.say(b"\x85", 0.06)
    assert machine.state is None  # it waits for its motors
    machine.wait(0.08)
    assert machine.state == "Idle"
    assert machine.x == pytest.approx(at - 0.08 - 0.2, abs=0.03)
    machine.wait(2.0)
    assert machine.x == pytest.approx(at - 0.28, abs=0.03)


def test_a_cancel_while_a_cancelled_jog_ends_suspends_it_until_it_is_resumed():
    """It says Idle and takes no line: the 0x85 came in the second of the two waits."""
    machine = jog()
    machine.say(b"\x85", 0.05 + 0.025 + 0.01)
    machine.say(b"\x85", 0.05)
    assert machine.state == "Idle"
    at = machine.x
    assert machine.say(JOG, 1.0) == b""
    assert (machine.state, machine.x) == ("Idle", at)
    assert machine.say(b"~", 0.1) == b"ok\r\n"
    assert machine.state == "Jog"


def test_a_cancel_in_the_first_of_the_two_waits_does_nothing_more():
    machine = jog()
    machine.say(b"\x85", 0.05 + 0.01)
    machine.say(b"\x85", 0.1)
    assert machine.say(JOG, 0.05) == b"ok\r\n"


def test_homing_says_nothing_until_it_is_over_and_then_reports_once():
    machine = homing()
    machine.say(b"?")
    assert machine.wait(1.0) == b""
    said = machine.wait(30.0)
    assert re.fullmatch(rb"<Home\|MPos:-1.000,-1.000,-1.000.*>\r\nok\r\n", said)


def test_a_reset_in_motion_loses_steps_and_one_that_stands_does_not():
    machine = held()
    before = machine.x
    machine.say(b"\x18")
    assert machine.x == before
    machine.say(JOG, 0.2)
    machine.say(b"\x18")
    true = [leg.displacement for leg in machine.legs if leg.mass == "x"][-1]
    assert abs(true - (machine.x + 17.0) * MM) > 0.1 * MM


def test_a_board_that_is_switched_on_counts_from_where_it_stands():
    machine = idle()
    machine.board.switch(False)
    assert machine.say(b"?") == b""
    machine.board.switch(True)
    said = machine.wait(2.0)
    assert re.search(GREETING + LOCK, said)
    assert machine.x == 0.0


def test_what_arrives_while_a_setting_is_written_is_lost():
    machine = idle()
    assert machine.say(b"$1=30\n$X\n", 0.1) == b"ok\r\n"
    assert machine.say(b"\n", 0.1) == b"ok\r\n"
