"""TMCL: bytes of the public manuals, worked out by hand; what every board does: ``test_boards``.

Checked against Trinamic's own package, which the driver does not need.
"""

from dataclasses import replace

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from equipoise.hardware.boards.tmcl.driver import Tmcl
from equipoise.hardware.boards.tmcl.settings import disagreement, guards, questions, speed_value
from equipoise.hardware.boards.tmcl.talk import Answer, Talk
from equipoise.hardware.boards.tmcl.words import Reply, Request, packed, replies_in
from equipoise.hardware.emulated.tmcl import EmulatedTmcl
from equipoise.hardware.transport.conversation import Tally
from equipoise.model.units import MM
from tests.support import thorough
from tests.support.board_wire import BED, TURN, Wire, board_of

BOARD = board_of("tmcl")
SPEED = 6400  # microsteps/s: 8 mm/s of 800 steps
hexed = bytes.fromhex


@pytest.mark.parametrize(
    ("request_", "data"),
    [
        # 1 + 1 + 1 + 0x5e = 0x61
        (Request(1, 0, 0, 350), "01 01 00 00 00 00 01 5e 61"),
        # 1 + 3 + 2 = 6
        (Request(3, 0, 2), "01 03 00 02 00 00 00 00 06"),
        # -1000 is ff ff fc 18; 1 + 4 + 1 + 255 + 255 + 252 + 24 = 792 = 3 * 256 + 0x18
        (Request(4, 0, 1, -1000), "01 04 00 01 ff ff fc 18 18"),
        # 6400 is 19 00; 1 + 5 + 4 + 2 + 0x19 = 0x25
        (Request(5, 4, 2, 6400), "01 05 04 02 00 00 19 00 25"),
        # 1 + 6 + 1 = 8
        (Request(6, 1, 0), "01 06 01 00 00 00 00 00 08"),
        # 1 + 13 + 2 + 5 = 0x15
        (Request(13, 2, 5), "01 0d 02 05 00 00 00 00 15"),
        # 1 + 136 + 1 = 0x8a
        (Request(136, 1, 0), "01 88 01 00 00 00 00 00 8a"),
    ],
)
def test_requests_are_the_manuals_bytes_and_those_of_trinamics_package(request_, data):
    tmcl = pytest.importorskip("pytrinamic.tmcl", reason="the extra trinamic is not installed")
    assert packed(request_) == hexed(data)
    own = tmcl.TMCLRequest(1, request_.command, request_.type, request_.motor, request_.value)
    assert bytes(own.to_buffer()) == hexed(data)


@given(
    command=st.integers(0, 255),
    type_=st.integers(0, 255),
    motor=st.integers(0, 255),
    value=st.integers(-(2**31), 2**31 - 1),
    status=st.sampled_from([100, 101, 1, 2, 3, 4, 5, 6]),
)
def test_all_datagrams_agree_with_trinamics_package(command, type_, motor, value, status):
    tmcl = pytest.importorskip("pytrinamic.tmcl", reason="the extra trinamic is not installed")
    own = tmcl.TMCLRequest(1, command, type_, motor, value)
    assert packed(Request(command, type_, motor, value)) == bytes(own.to_buffer())
    reply = bytes(tmcl.TMCLReply(2, 1, status, command, value).to_buffer())
    assert replies_in(reply) == ([Reply(status, command, value)], 0, b"")


# The manuals' example of an answer to GAP: position 711; 2 + 1 + 100 + 6 + 2 + 0xc7 = 0x136.
POSITION = hexed("02 01 64 06 00 00 02 c7 36")


def test_the_manuals_answer_is_understood():
    assert replies_in(POSITION) == ([Reply(100, 6, 711)], 0, b"")
    # -1 is ff ff ff ff; 2 + 1 + 100 + 6 + 4 * 255 = 1129 = 4 * 256 + 0x69
    assert replies_in(hexed("02 01 64 06 ff ff ff ff 69")) == ([Reply(100, 6, -1)], 0, b"")


@pytest.mark.parametrize(
    "broken",
    [
        POSITION[:-1] + b"\x37",  # the checksum
        b"\x03" + POSITION[1:-1] + b"\x37",  # for another host
        b"\x02\x02" + POSITION[2:-1] + b"\x37",  # of another module
        hexed("02 01 07 06 00 00 02 c7 d9"),  # a status that there is not: 310 - 93 = 217
    ],
)
def test_what_is_no_answer_is_dropped_and_the_next_one_found(broken):
    found, breaks, rest = replies_in(broken + POSITION + POSITION[:4])
    assert (found, breaks, rest) == ([Reply(100, 6, 711)], 1, POSITION[:4])


def test_an_answer_is_found_behind_any_number_of_broken_bytes():
    for k in range(1, 20):
        assert replies_in(b"\x55" * k + POSITION) == ([Reply(100, 6, 711)], 1, b"")


def test_one_question_at_a_time_and_an_answer_to_another_is_foreign():
    tally = Tally()
    talk = Talk(tally)
    talk.say([Request(6, 1, 0), Request(6, 1, 1)])
    assert talk.due() == hexed("01 06 01 00 00 00 00 00 08")
    assert talk.due() == b""
    talk.feed(hexed("02 01 64 04 00 00 02 c7 34") + POSITION[:3], 0.1)  # to MVP
    assert talk.due() == b""
    talk.feed(POSITION[3:], 0.2)
    assert talk.due() == hexed("01 06 01 01 00 00 00 00 09")
    talk.feed(POSITION + POSITION, 0.3)
    assert talk.answers[Request(6, 1, 0)] == Answer(100, 711, True, 0.2)
    assert talk.queue.over
    assert (tally.counts.good, tally.counts.foreign, tally.counts.corrupt) == (2, 2, 0)


def test_what_is_pending_when_another_script_begins_is_not_taken_for_its_answer():
    talk = Talk(Tally())
    talk.say([Request(6, 1, 0)])
    talk.due()
    talk.say([Request(6, 1, 0)])
    assert talk.due() == b""
    talk.feed(POSITION, 0.1)
    assert (talk.queue.over, talk.answers) == (False, {})
    assert talk.due() != b""


def test_masses_are_sent_half_a_second_ahead_in_the_modules_steps():
    """From home, -17 mm at 800 a mm, 6400 microsteps/s: -13600 + 3200, then on to 14 mm, -2400."""
    wire = Wire("tmcl").at_home()
    wire.sent = b""
    wire.driver.go({"x": 14 * MM}, wire.t)
    wire.run(3.0)
    targets = [
        int.from_bytes(each[4:8], "big", signed=True)
        for each in (wire.sent[k : k + 9] for k in range(0, len(wire.sent), 9))
        if each[1:4] == b"\x04\x00\x00"
    ]
    assert targets[0] == -10400
    assert targets[-1] == -2400
    assert targets == sorted(targets)


def test_homing_is_the_modules_reference_search_and_else_a_position_that_is_set():
    sent = Wire("tmcl").at_home().sent
    for motor in range(3):
        assert packed(Request(13, 0, motor)) in sent
        assert packed(Request(5, 4, motor, SPEED)) in sent
    sent = Wire("tmcl", board_of("tmcl", homing=False)).at_home().sent
    assert packed(Request(13, 0, 0)) not in sent
    assert packed(Request(5, 1, 2, -13600)) in sent


def test_a_search_that_a_reset_ends_is_not_taken_for_found():
    """After a reset, too, a module says that no search is active."""
    wire = Wire("tmcl")
    wire.run(0.5)
    wire.driver.home(wire.t)
    wire.run(1.2)
    wire.remote.press_reset()
    state = wire.run(0.5)
    assert (state.phase, state.sure) == ("fault", False)
    assert "restarted" in state.sentence


def test_a_search_that_finds_no_switch_ends():
    wire = Wire("tmcl")
    for motor in wire.remote.board._motors:
        motor.stored[194] = motor.now[194] = 100  # microsteps/s: 136 s to the switch
    wire.run(0.5)
    wire.driver.home(wire.t)
    assert wire.run(59.0).phase == "homing"
    state = wire.run(3.0)
    assert "homing has not ended" in state.sentence
    at = wire.true("x")
    wire.run(1.0)
    assert wire.true("x") == at


def test_a_disabled_limit_switch_is_not_queried():
    wire = Wire("tmcl")
    for motor in wire.remote.board._motors:
        motor.stored[12] = motor.stored[13] = motor.now[12] = motor.now[13] = 1
    left = packed(Request(6, 11, 0))  # the one ahead on the way down from the search's end
    assert left not in wire.at_home().sent
    assert left in Wire("tmcl").at_home().sent


def test_a_way_away_from_a_pushed_switch_is_free():
    wire = Wire("tmcl").at_home()
    wire.remote.board._motors[0].pressed.add(11)
    wire.driver.go({"x": 4 * MM}, wire.t)
    assert wire.run(1.0).position["x"] == pytest.approx(4 * MM, abs=2e-6)
    wire.driver.go({"x": 0.0}, wire.t)
    assert "limit switch was hit (mass x)" in wire.run(0.5).sentence


@pytest.mark.parametrize(
    ("command", "status", "said"),
    [
        (4, 4, "it does not take a value (status 4 to command 4, type 0, motor 0)"),
        (4, 6, "it cannot do this now"),
        (6, 2, "it does not know a command"),
        (10, 1, "a request reached it garbled"),
        (6, 5, "its memory is locked"),
        (10, 3, "it does not have a parameter"),
    ],
)
def test_a_refusal_on_the_way_is_a_fault_in_words(command, status, said):
    wire = Wire("tmcl").at_home()
    obey = wire.remote.board._obey
    wire.remote.board._obey = lambda *all_: (status, 0) if all_[0] == command else obey(*all_)
    wire.driver.go({"x": 14 * MM}, wire.t)
    state = wire.run(0.5)
    assert (state.phase, state.sure) == ("fault", False)
    assert said in state.sentence
    at = wire.true("x")
    wire.run(1.0)
    assert wire.true("x") == at


def answers(motor0=(), **changes):
    """Return what a TMCM-6212 says of three motors, with changes to the first; None: refused."""
    usual = {1: 0, 140: 8, 5: 20 * SPEED, 12: 0, 13: 0, 153: None, 154: None, 255: 1}
    found = {}
    for question in questions(BOARD):
        value = (usual | dict(motor0) if question.motor == 0 else usual)[question.type]
        done = value is not None
        found[question] = Answer(100 if done else 3, value or 0, done, 0.0)
    return found


# 6400 = 16e6 v / (2^3 65536), v = 209.7: 210 is within a hundredth. 16e12 * 16 a / 2^(3 + 7 + 29)
# is 465.7 a microsteps/s^2; 64000 need a = 137.4.
TMC429 = {154: 3, 153: 7, 255: None, 5: 200}


def test_a_tmc429_counts_in_units_of_its_clock():
    said = answers(TMC429)
    assert disagreement(BOARD, BED.masses, said) == ""
    assert speed_value(BOARD.axes[0], BED.masses[0], said) == 210
    assert speed_value(BOARD.axes[1], BED.masses[1], said) == SPEED


@pytest.mark.parametrize(
    ("motor0", "said"),
    [
        ({140: None}, "it is no stepper module, or has no motor 0"),
        ({255: 0}, "motor 0 counts in units of its own"),
        ({5: 63000}, "mass x needs 64000 to stop within 0.1 s"),
        (TMC429 | {5: 130}, "changes its speed by 60536"),
        (TMC429 | {154: 7}, "wanted less"),  # 3355 is beyond 2047
        (TMC429 | {154: 14}, "has divisor 14 (154); wanted 0 to 13"),
        (TMC429 | {153: -1}, "has divisor -1 (153)"),
    ],
)
def test_settings_that_differ_from_the_testbed_are_named(motor0, said):
    assert disagreement(BOARD, BED.masses, answers()) == ""
    assert said in disagreement(BOARD, BED.masses, answers(motor0))


def test_a_speed_that_a_tmc429_meets_badly_is_named():
    """2 mm/s are 1600; without a pulse divisor a unit is 244 microsteps/s, 7 of them 1709."""
    slow = [replace(mass, speed=2 * MM) for mass in BED.masses]
    said = answers(TMC429 | {154: 0, 153: 10})
    assert "divisor 0 (154) cannot go at 1600" in disagreement(BOARD, slow, said)
    assert "wanted more" in disagreement(BOARD, slow, said)
    assert disagreement(BOARD, slow, answers(TMC429 | {154: 5})) == ""  # 209.7 of 7.63


def test_switches_guard_the_end_that_they_stand_at():
    assert guards(BOARD.axes[0], answers()) == {1: 10, -1: 11}
    assert guards(BOARD.axes[0], answers({12: 1})) == {-1: 11}


def test_a_module_that_is_set_otherwise_is_a_fault():
    wire = Wire("tmcl")
    wire.remote.board._motors[1].now[5] = 100
    state = wire.run(0.5)
    assert state.phase == "fault"
    assert "mass y needs 64000 to stop" in state.sentence


def test_a_module_answers_each_request_and_refuses_what_it_cannot():
    """The manual's replies: wrong checksum 1, unknown command 2, parameter 3, motor 4."""
    remote = EmulatedTmcl(BOARD, BED.masses)

    def status(data):
        return remote.take(data, 0.0)[2]

    assert status(packed(Request(6, 1, 0))) == 100
    assert status(packed(Request(6, 1, 0))[:-1] + b"\x00") == 1
    assert status(packed(Request(99, 0, 0))) == 2
    assert status(packed(Request(6, 250, 0))) == 3
    assert status(packed(Request(6, 1, 6))) == 4
    assert remote.take(b"\x07" + packed(Request(6, 1, 0))[1:], 0.0) == b""  # another module's


def frame(status, command, value):
    head = bytes([2, 1, status, command]) + value.to_bytes(4, "big")
    return head + bytes([sum(head) % 256])


frames = st.builds(
    frame,
    st.sampled_from([100, 100, 100, 101, 1, 3, 4]),
    st.sampled_from([6, 6, 10, 13, 136, 5, 9, 3, 4]),
    st.one_of(st.sampled_from([0, 1, 0x45515550]), st.integers(0, 2**32 - 1)),
)


@settings(max_examples=thorough.count(150, 50), deadline=None)
@given(said=st.lists(frames, max_size=80), begin=st.integers(0, 60))
def test_whatever_a_module_answers_nothing_raises(said, begin):
    """Whole datagrams with any content, from any point of a conversation on."""
    wire = Wire("tmcl")
    wire.run(begin * TURN)
    wire.driver.home(wire.t)
    for k, each in enumerate(said):
        wire.driver.due(wire.t + k * TURN)
        wire.driver.feed(each, wire.t + k * TURN)
    assert isinstance(wire.driver, Tmcl)
    assert wire.driver.counts.good <= len(said) + begin


def test_a_reversed_axis_counts_down():
    axes = tuple(replace(axis, reversed=axis.mass == "x") for axis in BOARD.axes)
    wire = Wire("tmcl", replace(BOARD, axes=axes)).at_home()
    wire.driver.go({"x": 4 * MM}, wire.t)
    wire.run(1.5)
    assert packed(Request(4, 0, 0, -16800)) in wire.sent  # -17 - 4 mm


def slowly_stopping(**changes):
    """Return the slowest ramps that are taken, 0.1 s, and the quickest conversation."""
    wire = Wire("tmcl", board_of("tmcl", **changes), turn=0.001)
    for motor in wire.remote.board._motors:
        motor.stored[5] = motor.now[5] = 64000
    return wire.at_home()


def test_a_module_is_ready_after_a_halt_when_its_masses_stand():
    wire = slowly_stopping()
    wire.driver.go({"x": 14 * MM}, wire.t)
    wire.run(0.4)
    wire.driver.halt(wire.t)
    wire.run(1.0, until="ready")
    at = wire.true("x")
    state = wire.run(0.5)
    assert wire.true("x") == at
    assert state.goal["x"] == state.position["x"] == pytest.approx(at, abs=2e-6)


def test_masses_on_their_way_stand_before_a_person_says_that_they_are_at_home():
    wire = slowly_stopping(homing=False)
    wire.driver.go({"x": 14 * MM}, wire.t)
    wire.run(0.4)
    wire.driver.home(wire.t)
    wire.sent = b""
    while packed(Request(5, 1, 0, -13600)) not in wire.sent:
        wire.run(0.001)
    at = wire.true("x")
    wire.run(0.01)
    assert wire.true("x") == at
    state = wire.run(2.0)
    assert (state.phase, state.position["x"]) == ("ready", pytest.approx(0.0, abs=2e-6))
    at = wire.true("x")
    assert at < 5 * MM
    wire.driver.go({"x": 1 * MM}, wire.t)
    wire.run(1.0)
    assert wire.true("x") == pytest.approx(at + 1 * MM, abs=2e-6)


def test_a_way_is_over_when_masses_are_there_and_not_later():
    wire = Wire("tmcl").at_home()
    wire.driver.go({"x": 4 * MM}, wire.t)
    assert wire.run(0.65).phase == "ready"


def test_a_mass_that_does_not_move_is_reported_short_of_its_goal():
    """The interlocks then say so."""
    wire = Wire("tmcl").at_home()
    obey = wire.remote.board._obey
    wire.remote.board._obey = lambda *all_: (100, 0) if all_[0] == 4 else obey(*all_)
    wire.driver.go({"x": 4 * MM}, wire.t)
    state = wire.run(1.0)
    assert (state.phase, state.goal["x"]) == ("ready", 4 * MM)
    assert state.position["x"] == pytest.approx(0.0, abs=2e-6)


def test_after_a_halt_a_mass_can_be_sent_where_it_was_going():
    wire = Wire("tmcl").at_home()
    wire.driver.go({"x": 4 * MM}, wire.t)
    wire.run(0.3)
    wire.driver.halt(wire.t)
    assert wire.run(0.5).position["x"] < 3 * MM
    wire.driver.go({"x": 4 * MM}, wire.t)
    assert wire.run(1.0).position["x"] == pytest.approx(4 * MM, abs=2e-6)


def test_a_module_that_falls_silent_during_its_settings_query_is_a_fault():
    """Nothing is asked again: an answer that came late would be taken for another motor's."""
    wire = Wire("tmcl")
    wire.run(0.1)
    wire.cut = True
    sent = len(wire.sent)
    assert "does not answer as TMCL" in wire.run(2.0).sentence
    assert len(wire.sent) <= sent + 9


@pytest.mark.parametrize("left", range(1, 9))
def test_a_module_in_the_middle_of_a_datagram_is_called_until_it_has_met_its_beginning(left):
    """A plug was pulled while bytes were on their way: some of them are in it still."""
    wire = Wire("tmcl")
    wire.remote.board.take(b"\x01\x06\x01\x00\x00\x00\x00\x00"[:left], 0.0)
    assert wire.run(6.0, until="ready").phase == "ready"
