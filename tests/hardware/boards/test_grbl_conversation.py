"""Grbl's conversation: faults that a real board showed, each with its whole kind.

A real Grbl 1.1h with step pulses and a line of 115200 baud gave them; see the emulated firmware's
table for what it does.
"""

import copy

import numpy as np
import pytest

from equipoise.hardware.boards.grbl.halt import Halting, Wish
from equipoise.hardware.boards.grbl.report import MachineState, Status
from equipoise.hardware.boards.grbl.settings import late_to_stop, longest_homing
from equipoise.hardware.boards.grbl.talk import GrblTalk
from equipoise.hardware.boards.registry import BOARDS
from equipoise.hardware.transport.conversation import Tally
from equipoise.hardware.transport.driver_protocol import LEG, Phase
from equipoise.model.reasons.board_faults import BoardFault, BoardRemark
from equipoise.model.units import MM
from tests.support.board_wire import BED, Wire, board_of
from tests.support.grbl_dialect import DIALECTS, Dialect

QUICK = 0.002  # s, turns of a bench


class Talk:
    """A driver and a firmware that answers at once."""

    def __init__(self, dialect):
        self.driver = BOARDS["grbl"](board_of("grbl"), BED.masses)
        self.dialect, self.t = copy.deepcopy(dialect), 0.0
        self.driver.opened(0.0)

    def run(self, seconds, until=None):
        end = self.t + seconds
        while self.t < end and self.driver.state.phase is not until:
            self.t += 0.01
            self.driver.feed(self.dialect.answers(self.driver.due(self.t)), self.t)
        return self.driver.state


@pytest.mark.parametrize("name", sorted(DIALECTS))
def test_each_dialect_begins_homes_and_moves(name):
    talk = Talk(DIALECTS[name])
    assert talk.run(4.0, Phase.READY).phase is Phase.READY
    talk.driver.home(talk.t)
    state = talk.run(5.0, Phase.READY)
    assert (state.phase, state.sure) == (Phase.READY, True)
    assert state.position == pytest.approx({"x": 0.0, "y": 0.0, "z": 0.0}, abs=2e-6)
    talk.driver.go({"y": 2 * MM}, talk.t)
    assert talk.run(5.0, Phase.READY).position["y"] == pytest.approx(2 * MM, abs=2e-6)
    assert talk.dialect.at[1] == pytest.approx(-15.0)
    assert talk.driver.counts.corrupt <= 4  # boot chatter, at each reset


@pytest.mark.parametrize(
    ("greeting", "report"),
    [
        ("Grbl 0.9j ['$' for help]", "<{},MPos:0.000,0.000,0.000,WPos:0.000,0.000,0.000>"),
        ("", "<{},MPos:0.000,0.000,0.000,WPos:0.000,0.000,0.000>"),
    ],
)
def test_an_old_grbl_is_known_by_its_greeting_or_its_commas(greeting, report):
    state = Talk(Dialect(greeting, report)).run(4.5, Phase.FAULT)
    assert state.fault.code is BoardFault.OUTDATED
    assert "wanted Grbl 1.1" in state.sentence
    assert (greeting or "<Alarm,MPos") in state.sentence


def test_what_answers_but_is_no_grbl_is_quoted_and_not_called_unplugged():
    class Smoothie(Dialect):
        def answers(self, data):
            return b"Smoothie\r\nok\r\n" if data else b""

    state = Talk(Smoothie("", "")).run(6.0, Phase.FAULT)
    assert state.fault.code is BoardFault.NOT_ITS_KIND
    assert "'ok'" in state.sentence


def test_a_wrong_baud_rate_is_noise_and_no_silence():
    class Garbled(Dialect):
        def answers(self, data):
            return b"\xfe\x80\x00\xf8" * len(data)

    state = Talk(Garbled("", "")).run(6.0, Phase.FAULT)
    assert state.fault.code is BoardFault.NOT_ITS_KIND
    assert r"\xfe\x80" in state.sentence


@pytest.mark.parametrize("late", np.arange(0.0, 0.12, 0.01))
def test_homing_waits_for_its_own_answer_while_a_listing_still_prints(late):
    """55 ms of settings are on the line when somebody says home; their ok is not that of $H."""
    wire = Wire("grbl", turn=QUICK)
    wire.run(5.0, until=Phase.CONNECTING if late == 0 else Phase.READY)
    wire.run(late)
    wire.driver.home(wire.t)
    wire.run(0.03)
    wire.driver.home(wire.t)  # and once more
    state = wire.run(40.0, until=Phase.READY)
    assert (state.phase, state.sure) == (Phase.READY, True)
    assert [wire.true(name) for name in "xyz"] == pytest.approx([0.0] * 3, abs=2e-6)


@pytest.mark.parametrize("late", np.arange(0.0, 0.6, 0.017))
def test_a_halt_at_any_moment_of_a_way_leaves_a_board_that_moves_again(late):
    """Also in the moments in which a jog begins, ends, or is taken: 0x85 may suspend the board."""
    wire = Wire("grbl", turn=QUICK).at_home()
    wire.driver.go({"x": 3 * MM}, wire.t)
    wire.run(late)
    wire.driver.halt(wire.t)
    halted = wire.t
    state = wire.run(2.0, until=Phase.READY)
    assert (state.phase, state.sure) == (Phase.READY, True)
    assert wire.true("x", halted + 0.2) == wire.true("x", halted + 5.0)
    wire.driver.go({"x": -1 * MM}, wire.t)
    assert wire.run(3.0, until=Phase.READY).position["x"] == pytest.approx(-1 * MM, abs=2e-6)
    assert wire.true("x") == pytest.approx(-1 * MM, abs=2e-6)


@pytest.mark.parametrize("into", [0.055, 0.085])
def test_a_board_that_is_suspended_by_a_second_cancel_is_freed(into):
    """Idle is reported and no line is answered: an empty line shows it, a reset frees it."""
    wire = Wire("grbl", turn=QUICK).at_home()
    wire.driver.go({"x": 14 * MM}, wire.t)
    wire.run(0.4)
    wire.driver.halt(wire.t)
    wire.run(into)
    wire.remote.board.take(b"\x85", wire.t)  # as from a hand unit on the same board
    state = wire.run(2.0, until=Phase.READY)
    assert (state.phase, state.sure) == (Phase.READY, True)
    wire.driver.go({"x": 0.0}, wire.t)
    assert wire.run(3.0, until=Phase.READY).position["x"] == pytest.approx(0.0, abs=2e-6)


def test_a_board_that_is_suspended_on_its_way_goes_on_by_itself():
    wire = Wire("grbl", turn=QUICK).at_home()
    wire.driver.go({"x": 2 * MM}, wire.t)
    wire.run(0.02)
    board = wire.remote.board
    board.take(b"!", wire.t)  # somebody holds and resumes: the jog is thrown away
    wire.run(0.06 + 0.02)
    board.take(b"\x85", wire.t)
    state = wire.run(4.0, until=Phase.READY)
    assert state.sure
    assert state.position["x"] == pytest.approx(wire.true("x"), abs=2e-6)


def running(turn=QUICK):
    """Return a board on a way that has become state Run, on its way to 6 mm."""
    wire = Wire("grbl", turn=turn).at_home()
    for late in np.arange(0.5, 0.56, 0.002):
        wire.driver.go({"x": 0.0, "y": 0.0}, wire.t)
        wire.run(3.0, until=Phase.READY)
        wire.run(0.2)
        wire.driver.go({"x": 4 * MM}, wire.t)
        wire.run(late)
        wire.driver.go({"x": 6 * MM}, wire.t)
        for _ in range(40):
            wire.run(QUICK)
            if wire.remote.board._state == "Run":
                return wire
        wire.run(3.0, until=Phase.READY)
    raise AssertionError("no jog has become a run")


def test_a_jog_that_runs_is_waited_for_and_the_way_goes_on():
    wire = running()
    state = wire.run(4.0, until=Phase.READY)
    assert (state.phase, state.sure) == (Phase.READY, True)
    assert wire.true("x") == pytest.approx(6 * MM, abs=2e-6)


def test_a_jog_that_is_refused_because_it_runs_is_sent_again():
    wire = running()
    wire.driver._talk.status = Status(MachineState.JOG)  # the last report was of before
    wire.driver.go({"x": -2 * MM}, wire.t)
    state = wire.run(5.0, until=Phase.READY)
    assert (state.phase, state.sure) == (Phase.READY, True)
    assert wire.true("x") == pytest.approx(-2 * MM, abs=2e-6)


def test_a_halt_in_a_run_holds_and_resets_and_nothing_goes_on():
    wire = running()
    wire.sent = b""
    wire.driver.halt(wire.t)
    halted = wire.t
    state = wire.run(2.0, until=Phase.READY)
    assert (state.phase, state.sure) == (Phase.READY, True)
    assert b"!" in wire.sent
    assert b"\x18" in wire.sent
    assert b"~" not in wire.sent
    at = wire.true("x")
    assert wire.true("x", halted + 0.2) == at
    assert state.position["x"] == pytest.approx(at, abs=2e-6)
    wire.run(2.0)
    assert wire.true("x") == at


@pytest.mark.parametrize("pause", [0.5, 2.0, 10.0])
@pytest.mark.parametrize("late", [0.0, 0.3, 0.61])
def test_a_host_that_pauses_blames_no_board_and_the_way_goes_on(pause, late):
    """Legs end meanwhile; what the board said while nobody listened is no silence."""
    wire = Wire("grbl", turn=QUICK).at_home()
    wire.driver.go({"x": 14 * MM}, wire.t)
    wire.run(late)
    paused = wire.t
    wire.pause(pause)
    assert max(leg.end for leg in wire.legs) < paused + 2 * LEG + 0.15
    state = wire.run(5.0, until=Phase.READY)
    assert (state.phase, state.sure) == (Phase.READY, True)
    assert wire.true("x") == pytest.approx(14 * MM, abs=2e-6)


def test_a_position_that_waited_for_the_host_is_not_stamped_with_its_return():
    """A report that was asked for before a pause of 2 s is older than that pause."""
    wire = Wire("grbl", turn=QUICK).at_home()
    wire.driver.go({"x": 14 * MM}, wire.t)
    wire.run(0.5)
    queried = wire.t
    wire.driver.due(queried + 0.06)  # a question, at the latest
    report = b"<Jog|MPos:-13.000,-17.000,-17.000|FS:480,0>\r\n"
    wire.driver.feed(report, queried + 2.0)
    assert wire.driver.state.position["x"] == pytest.approx(4 * MM)
    assert wire.driver.state.reported < queried + 0.2


@pytest.mark.parametrize(
    ("state", "code"),
    [("Check", BoardFault.LOCKED), ("Door:1", BoardFault.LOCKED), ("Alarm", BoardFault.LOCKED),
     ("Hold:0", BoardFault.LOCKED), ("Sleep", BoardFault.LOCKED), ("Tool", BoardFault.LOCKED)],
)  # fmt: skip
def test_a_state_in_which_nothing_moves_is_a_fault_that_names_it(state, code):
    wire = Wire("grbl").at_home()
    wire.run(0.3)
    wire.driver.due(wire.t)
    wire.driver.feed(f"<{state}|MPos:-17.000,-17.000,-17.000|FS:0,0>\r\n".encode(), wire.t + 0.2)
    found = wire.driver.state
    assert (found.phase, found.fault.code) == (Phase.FAULT, code)
    assert state.partition(":")[0] in found.sentence


def test_a_fault_has_the_query_and_the_last_line_and_no_cause_that_nobody_observed():
    wire = Wire("grbl").at_home()
    wire.cut = True
    state = wire.run(3.0, until=Phase.FAULT)
    assert state.fault.code is BoardFault.SILENT
    assert "its state (?) was requested 1.5 s ago" in state.sentence
    assert "'<Idle|MPos:-17.000,-17.000,-17.000" in state.sentence
    assert "unplugged" not in state.sentence


def test_a_line_that_is_never_answered_is_a_fault_though_the_board_reports():
    """Life is not judged by one channel: questions are answered, the line is lost."""
    wire = Wire("grbl", turn=QUICK).at_home()
    board = wire.remote.board
    board._line = lambda _line: None
    wire.driver.go({"x": 1 * MM}, wire.t)
    state = wire.run(3.0, until=Phase.FAULT)
    assert state.fault.code is BoardFault.UNANSWERED
    assert state.sure  # it reports where it is
    assert "a jog ($J)" in state.sentence


def test_homing_as_slow_as_the_boards_own_settings_say_is_no_silence():
    """40 mm at 1 mm/s take 40 s for each of two rounds, without an answer to any question."""
    wire = Wire("grbl", turn=0.05)
    wire.remote.board.settings[25] = 60.0
    wire.run(5.0, until=Phase.READY)
    begun = wire.t
    wire.driver.home(wire.t)
    state = wire.run(200.0, until=Phase.READY)
    assert state.phase is Phase.READY
    assert wire.t - begun > 40.0


def test_the_longest_homing_is_worked_out_from_the_settings():
    """Three axes of 40 mm at 10 mm/s: 1.5 * 40 + 2 of pull-off is 6.2 s; 5 mm at 1 mm/s are 5 s."""
    settings = {24: 60.0, 25: 600.0, 26: 250.0, 27: 1.0} | {130 + k: 40.0 for k in range(3)}
    assert longest_homing(settings) == pytest.approx(3 * (6.2 + 5.0 + 1.0) + 10.0)


def test_an_acceleration_that_stops_late_is_remarked():
    """8 mm/s with 10 mm/s^2, as delivered, take 0.8 s; 80 mm/s^2 are wanted."""
    remarks = late_to_stop(board_of("grbl"), BED.masses, {120: 10.0, 121: 80.0, 122: 200.0})
    (remark,) = remarks
    assert remark.code is BoardRemark.SLOW_TO_STOP
    assert remark.parameters == ("x", "$120")
    assert remark.numbers["taken"] == pytest.approx(0.8)
    assert "set 80 mm/s^2 or more" in remark.sentence


def test_a_halt_cancels_once_for_a_report_and_not_while_the_board_slows_down():
    halting = Halting(480.0)
    slowing = [Status(MachineState.JOG, feed=feed) for feed in (300.0, 100.0, 0.0)]
    assert [halting.wish(status, quiet=True) for status in slowing] == [Wish.WAIT] * 3
    assert halting.wish(Status(MachineState.JOG, feed=480.0), quiet=True) is Wish.CANCEL
    assert halting.wish(Status(MachineState.IDLE, feed=0.0), quiet=False) is Wish.WAIT
    assert halting.wish(Status(MachineState.IDLE, feed=0.0), quiet=True) is Wish.SYNC
    assert halting.wish(Status(MachineState.IDLE, feed=0.0), quiet=True) is Wish.STANDS


def test_a_report_is_as_old_as_the_oldest_question_that_is_open():
    """Queried at 0 s and again 0.25 s later: the first report answers the first of them."""
    talk = GrblTalk(Tally())
    talk.begin()
    list(talk.reports(b"Grbl 1.1h ['$' for help]\r\n", 0.0))
    queried = []
    for k in range(40):
        t = round(0.01 * k, 9)
        talk.clock.turn(t)
        if b"?" in talk.due(t, 0.1):
            queried.append(t)
    assert len(queried) == 2
    report = b"<Idle|MPos:0.000,0.000,0.000|FS:0,0>\r\n"
    list(talk.reports(report, 0.4))
    assert talk.queried == queried[0]
    list(talk.reports(report, 0.41))
    assert talk.queried == queried[1]
    list(talk.reports(report, 0.42))  # nobody queried: it may be as old as the one before
    assert talk.queried == pytest.approx(0.41)


def test_a_report_queried_before_a_halt_says_nothing_of_it():
    """It says Idle, of before the jog began: no line is sent to see whether masses stand."""
    wire = Wire("grbl", turn=QUICK).at_home()
    wire.driver.go({"x": 14 * MM}, wire.t)
    wire.run(0.1)
    wire.driver.halt(wire.t)
    wire.driver.feed(b"<Idle|MPos:-17.000,-17.000,-17.000|FS:0,0>\r\n", wire.t)
    assert wire.driver.due(wire.t + 1e-3) == b"\x85?"
    assert wire.driver.state.phase is Phase.HALTED


def test_an_ok_too_many_ends_no_homing():
    """A line came twice; masses are still on their way to their switches."""
    wire = Wire("grbl", turn=QUICK).at_home()
    wire.driver.go({"x": 10 * MM}, wire.t)
    wire.run(3.0, until=Phase.READY)
    wire.driver.home(wire.t)
    wire.sent = b""
    while b"$H\n" not in wire.sent:
        wire.run(QUICK)
    wire.driver.feed(b"ok\r\n<Idle|MPos:-7.000,-17.000,-17.000|FS:0,0>\r\n", wire.t)
    assert wire.run(1.0).phase is Phase.HOMING
    state = wire.run(40.0, until=Phase.READY)
    assert (state.phase, state.sure) == (Phase.READY, True)
    assert [wire.true(name) for name in "xyz"] == pytest.approx([0.0] * 3, abs=2e-6)


def test_masses_that_stand_are_elsewhere_only_when_two_reports_say_so():
    wire = Wire("grbl", turn=QUICK).at_home()
    old = b"<Idle|MPos:-10.000,-17.000,-17.000|FS:0,0>\r\n"
    wire.driver.feed(old, wire.t)
    assert wire.driver.state.position["x"] == pytest.approx(0.0, abs=1e-9)
    wire.driver.feed(old, wire.t)
    assert wire.driver.state.position["x"] == pytest.approx(7 * MM)


def test_a_refused_line_is_a_fault_with_its_number_and_what_was_refused():
    """A leg that leaves the travel moves nothing: the position stays known."""
    wire = Wire("grbl").at_home()
    wire.remote.board.settings[130] = 18.0
    wire.driver.go({"x": -8 * MM}, wire.t)
    state = wire.run(3.0, until=Phase.FAULT)
    assert (state.fault.code, state.sure) == (BoardFault.REFUSED, True)
    assert "(error:15 to a jog ($J))" in state.sentence


def test_an_alarm_is_called_by_its_whole_number():
    wire = Wire("grbl").at_home()
    wire.driver.go({"x": 14 * MM}, wire.t)
    wire.run(0.3)
    wire.remote.hit_limit()
    assert "(ALARM:1)" in wire.run(1.0, until=Phase.FAULT).sentence


def test_a_port_at_which_nothing_answers_is_reset_no_more_once_that_is_a_fault():
    """It may be that of another device."""
    talk = Talk(Dialect("", ""))
    talk.dialect.answers = lambda _data: b""
    sent, due = [], talk.driver.due

    def said(t):
        sent.append((t, due(t)))
        return sent[-1][1]

    talk.driver.due = said
    talk.run(12.0)
    resets = [t for t, data in sent if b"\x18" in data]
    assert len(resets) >= 2
    assert max(resets) < 4.5
