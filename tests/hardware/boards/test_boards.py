"""What every driver of a motor board does, at its emulated counterpart."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from equipoise.hardware.boards.legs import next_leg
from equipoise.hardware.boards.registry import BOARDS
from equipoise.hardware.emulated.registry import FIRMWARES
from equipoise.hardware.links.row_buffer import RowBuffer
from equipoise.hardware.transport.driver_protocol import LEG
from equipoise.model.errors import BenchStopped, InputError
from equipoise.model.units import MM, UM
from tests.support.board_wire import BED, LETTERS, TURN, Wire, board_of

SPEED = 8 * MM


def coarse(kind, steps_per_mm):
    """Return a board whose motors make so many steps per mm."""
    board = board_of(kind)
    axes = tuple(replace(axis, steps_per_m=steps_per_mm / MM) for axis in board.axes)
    return replace(board, axes=axes)


every_board = pytest.mark.parametrize("kind", sorted(BOARDS))


def test_every_driver_has_a_remote_side_and_is_tested_here():
    assert set(BOARDS) == set(FIRMWARES) == set(LETTERS)


@every_board
def test_it_homes_and_then_knows_where_masses_are(kind):
    wire = Wire(kind)
    assert wire.run(5.0, until="ready").phase == "ready"
    assert not wire.driver.state.sure
    with pytest.raises(BenchStopped, match="position"):
        wire.driver.go({"x": 1 * MM}, wire.t)
    wire.driver.home(wire.t)
    state = wire.run(60.0, until="ready")
    assert (state.phase, state.sure) == ("ready", True)
    assert state.position == pytest.approx({"x": 0.0, "y": 0.0, "z": 0.0}, abs=2e-6)
    assert [wire.true(name) for name in "xyz"] == pytest.approx([0.0] * 3, abs=2e-6)


@every_board
def test_each_mass_goes_at_its_own_speed_until_it_is_there(kind):
    """1 mm takes an eighth of a second, 4 mm half of one: from a start that may be late."""
    wire = Wire(kind).at_home()
    begun = wire.t
    wire.driver.go({"x": 1 * MM, "y": -4 * MM}, begun)
    state = wire.run(1.5)
    assert (state.phase, state.sure) == ("ready", True)
    assert state.position == pytest.approx({"x": 1 * MM, "y": -4 * MM, "z": 0.0}, abs=2e-6)
    t = np.arange(begun, wire.t, 0.001)
    for name, goal in (("x", 1 * MM), ("y", -4 * MM)):
        way = np.abs([wire.true(name, k) for k in t])
        going = t[(way > 1e-7) & (way < abs(goal) - 1e-7)]
        assert going[0] - begun < 0.1
        assert going[-1] - going[0] == pytest.approx(abs(goal) / SPEED, abs=0.003)
        assert way[-1] == pytest.approx(abs(goal), abs=2e-6)


@every_board
def test_another_goal_on_the_way_is_taken_up_and_other_masses_go_on(kind):
    wire = Wire(kind).at_home()
    wire.driver.go({"x": 6 * MM, "y": 6 * MM}, wire.t)
    assert wire.run(0.4).phase == "moving"
    wire.driver.go({"x": -3 * MM, "z": 2 * MM}, wire.t)
    state = wire.run(4.0)
    assert state.phase == "ready"
    want = {"x": -3 * MM, "y": 6 * MM, "z": 2 * MM}
    assert state.position == pytest.approx(want, abs=2e-6)
    assert {name: wire.true(name) for name in want} == pytest.approx(want, abs=2e-6)


@every_board
def test_a_reversed_axis_goes_the_other_way_on_the_board_and_the_same_on_the_platform(kind):
    axes = tuple(replace(axis, reversed=axis.mass == "x") for axis in board_of(kind).axes)
    wire = Wire(kind, replace(board_of(kind), axes=axes)).at_home()
    wire.driver.go({"x": 4 * MM}, wire.t)
    assert wire.run(1.5).position["x"] == pytest.approx(4 * MM, abs=2e-6)
    assert wire.true("x") == pytest.approx(4 * MM, abs=2e-6)


@every_board
def test_a_board_whose_computer_has_died_stands_within_two_legs(kind):
    wire = Wire(kind).at_home()
    wire.driver.go(dict.fromkeys("xyz", 14 * MM), wire.t)
    wire.run(0.6)
    died = wire.t
    wire.run(3.0, listen=False)
    last = max(leg.end for leg in wire.legs)
    assert died < last <= died + 2 * LEG + 0.05
    assert wire.true("x") < 10 * MM


@every_board
@pytest.mark.parametrize("turn", [0.001, 0.02])
def test_a_long_way_is_gone_without_a_pause_between_legs(kind, turn):
    """At every speed of the conversation that a bench has, 12 mm take 1.5 s."""
    wire = Wire(kind, turn=turn).at_home()
    begun = wire.t
    wire.driver.go(dict.fromkeys("xyz", 12 * MM), begun)
    wire.run(3.0, until="ready")
    t = np.arange(begun, wire.t, 0.005)
    for name in "xyz":
        way = np.array([wire.true(name, k) for k in t])
        going = t[(way > 1e-7) & (way < 12 * MM - 1e-7)]
        assert going[-1] - going[0] == pytest.approx(1.5, abs=0.03)


@every_board
@pytest.mark.parametrize(
    ("um_s", "steps_per_mm", "turn"), [(20.0, 800.0, 0.01), (3.3, 800.0, 0.05), (3.3, 100.0, 0.05)]
)
def test_a_mass_creeps_when_a_way_is_slow(kind, um_s, steps_per_mm, turn):
    """60 um at 20 um/s take 3 s at least; never is a mass more than a leg or a step too far.

    At 3.3 um/s a step of 10 um takes twelve legs, and its rounding more than one.
    """
    wire = Wire(kind, coarse(kind, steps_per_mm), turn=turn).at_home()
    begun, way, speed, step = wire.t, 60 * UM, um_s * UM, MM / steps_per_mm
    wire.driver.go({"x": way, "y": -way}, begun, speed)
    state = wire.run(2 * way / speed, until="ready")
    assert state.phase == "ready"
    t = np.arange(begun, wire.t, 0.02)
    for name, sign in (("x", 1), ("y", -1)):
        gone = sign * np.array([wire.true(name, k) for k in t])
        assert np.all(gone <= speed * (t - begun + LEG) + (step if step > speed * LEG else 0.0))
        assert wire.true(name) == pytest.approx(sign * way, abs=max(step / 2, 2e-6))
    assert min(0.9 * way, way - step) < speed * (wire.t - begun) < 1.4 * way
    wire.driver.go({"x": 8.06 * MM}, wire.t)
    assert wire.run(1.5).position["x"] == pytest.approx(8.06 * MM, abs=2e-6)


@every_board
def test_slow_ways_in_a_row_all_arrive(kind):
    """As a hold sends them: another goal before the last is reached, in steps of motors."""
    wire = Wire(kind, turn=0.05).at_home()
    for k in range(1, 13):
        wire.driver.go({"x": 10 * k * UM, "z": -20 * k * UM}, wire.t, 3.3 * UM)
        wire.run(5.0)
    wire.run(30.0, until="ready")
    assert wire.true("x") == pytest.approx(120 * UM, abs=2e-6)
    assert wire.true("z") == pytest.approx(-240 * UM, abs=2e-6)


@every_board
@pytest.mark.parametrize("back_um", [0.0, 2.5, 5.0, 7.5, 10.0])
def test_a_mass_that_is_sent_where_it_just_passes_comes_back(kind, back_um):
    """It was sent further before: to be there at the moment is not to stay there."""
    wire = Wire(kind, turn=0.05).at_home()
    wire.driver.go({"x": 1 * MM}, wire.t, 10 * UM)
    wire.run(5.0)
    goal = wire.driver.state.position["x"] + back_um * UM - 5 * UM
    wire.driver.go({"x": goal, "z": 20 * UM}, wire.t, 10 * UM)
    assert wire.run(6.0, until="ready").phase == "ready"
    wire.run(1.0)
    assert wire.true("x") == pytest.approx(goal, abs=2e-6)


@every_board
def test_a_way_that_is_halted_as_it_begins_leaves_no_slowness(kind):
    """The module creeps, and may not have been told of its own speed when the halt comes."""
    wire = Wire(kind, turn=0.02).at_home()
    for turns in range(25):
        wire.driver.go(dict.fromkeys("xyz", wire.true("x") + 5 * UM), wire.t, 20 * UM)
        assert wire.run(2.0, until="ready").phase == "ready"
        goal = 0.0 if turns % 2 else 2 * MM
        for seconds in (turns * wire.turn, 1.5):
            wire.driver.go(dict.fromkeys("xyz", goal), wire.t)
            wire.run(seconds, until="ready")
            wire.driver.halt(wire.t)
            assert wire.run(1.0, until="ready").phase == "ready"
        assert [wire.true(name) for name in "xyz"] == pytest.approx([goal] * 3, abs=2e-6)


@every_board
def test_a_creeping_mass_halts_where_it_is(kind):
    wire = Wire(kind, turn=0.05).at_home()
    wire.driver.go({"x": 100 * UM}, wire.t, 3.3 * UM)
    wire.run(10.0)
    wire.driver.halt(wire.t)
    state = wire.run(1.0, until="ready")
    stood = wire.true("x")
    assert (state.phase, state.sure) == ("ready", True)
    assert 28 * UM < stood < 38 * UM
    wire.run(2.0)
    assert wire.true("x") == stood
    assert state.position["x"] == pytest.approx(stood, abs=2e-6)


@every_board
@pytest.mark.parametrize("turn", [0.002, 0.01])
def test_a_halt_stops_at_once_and_the_position_stays_known(kind, turn):
    """It says that it is ready when the masses stand."""
    wire = Wire(kind, turn=turn).at_home()
    wire.driver.go({"x": 14 * MM, "z": -14 * MM}, wire.t)
    wire.run(0.6)
    wire.driver.halt(wire.t)
    halted = wire.t
    wire.run(1.0, until="ready")
    stood = wire.true("x")
    state = wire.run(1.0)
    assert wire.true("x") == stood
    assert (state.phase, state.sure) == ("ready", True)
    assert state.goal == state.position
    for name in "xz":
        assert state.position[name] == pytest.approx(wire.true(name), abs=2e-6)
        assert wire.true(name, halted + 0.15) == wire.true(name)
        assert 3 * MM < abs(wire.true(name)) < 6 * MM
    wire.driver.go({"x": 0.0}, wire.t)
    assert wire.run(2.0).position["x"] == pytest.approx(0.0, abs=2e-6)


@every_board
def test_a_homing_that_is_broken_off_stands_and_leaves_the_position_unknown(kind):
    wire = Wire(kind)
    wire.run(0.5)
    wire.driver.home(wire.t)
    wire.run(1.0)
    wire.driver.halt(wire.t)
    state = wire.run(0.5)
    assert (state.phase, state.sure) == ("fault", False)
    assert "homing was broken off" in state.sentence
    stands_until_home(wire)


def stands_until_home(wire):
    """Nothing moves and nothing is taken before masses have come home; then all is well."""
    at = [wire.true(name) for name in "xyz"]
    with pytest.raises(BenchStopped):
        wire.driver.go({"x": 0.0}, wire.t)
    wire.run(2.0)
    assert [wire.true(name) for name in "xyz"] == at
    wire.driver.home(wire.t)
    state = wire.run(60.0, until="ready")
    assert (state.phase, state.sure) == ("ready", True)
    assert [wire.true(name) for name in "xyz"] == pytest.approx([0.0] * 3, abs=2e-6)


@every_board
@pytest.mark.parametrize("late", [0.6, 0.61, 0.62, 0.63, 0.64, 0.65, 0.66])
@pytest.mark.parametrize(
    ("trouble", "said"),
    [
        (lambda wire: wire.remote.press_reset(), "position is lost"),
        (lambda wire: wire.remote.hit_limit(), "a limit switch was hit"),
        (lambda wire: wire.remote.switch(False), "does not answer"),
    ],
)
def test_trouble_in_a_way_is_a_fault_in_words_and_ends_with_homing(kind, late, trouble, said):
    """Wherever in the conversation it comes."""
    wire = Wire(kind).at_home()
    wire.driver.go({"x": 14 * MM, "y": -14 * MM}, wire.t)
    wire.run(late)
    trouble(wire)
    state = wire.run(2.0, until="fault")
    assert (state.phase, state.sure) == ("fault", False)
    assert said in state.sentence
    wire.remote.switch(True)
    stands_until_home(wire)


@every_board
def test_a_board_that_is_silent_is_a_fault_within_two_seconds(kind):
    wire = Wire(kind).at_home()
    wire.driver.go({"x": 14 * MM}, wire.t)
    wire.run(0.6)
    wire.cut = True
    state = wire.run(2.0)
    assert (state.phase, state.sure) == ("fault", False)
    assert "does not answer" in state.sentence
    wire.run(0.5)
    wire.cut = False
    stands_until_home(wire)


@every_board
@pytest.mark.parametrize("trouble", ["reset", "power"])
def test_trouble_while_masses_stand_is_noticed_too(kind, trouble):
    wire = Wire(kind).at_home()
    if trouble == "reset":
        wire.remote.press_reset()
    else:
        wire.remote.switch(False)
        wire.run(0.1)
        wire.remote.switch(True)
    wire.run(2.0)
    assert not wire.driver.state.sure
    with pytest.raises(BenchStopped):
        wire.driver.go({"x": 1 * MM}, wire.t)


@every_board
def test_a_board_that_was_unplugged_must_home_again(kind):
    wire = Wire(kind).at_home()
    wire.driver.go({"x": 14 * MM}, wire.t)
    wire.run(0.4)
    wire.driver.closed("gone")
    state = wire.driver.state
    assert (state.phase, state.sure) == ("fault", False)
    assert "its port is gone (gone)" in state.sentence
    wire.run(1.0, listen=False)
    wire.driver.opened(wire.t)
    assert not wire.run(1.0).sure
    stands_until_home(wire)


@every_board
def test_a_board_without_switches_is_at_home_when_a_person_says_so(kind):
    wire = Wire(kind, board_of(kind, homing=False))
    wire.run(0.5)
    wire.driver.home(wire.t)
    assert wire.run(1.0).sure
    wire.driver.go({"z": -2 * MM}, wire.t)
    wire.run(1.0)
    assert wire.true("z") == pytest.approx(-2 * MM, abs=2e-6)
    wire.driver.home(wire.t)  # masses have been carried home by hand; so here is home
    state = wire.run(1.0)
    assert (state.sure, state.position["z"]) == (True, pytest.approx(0.0, abs=2e-6))
    assert wire.true("z") == pytest.approx(-2 * MM, abs=2e-6)


@every_board
def test_a_silent_board_is_reported_as_a_fault(kind):
    driver = BOARDS[kind](board_of(kind), BED.masses)
    driver.opened(0.0)
    for k in range(500):
        driver.due(k * TURN)
    assert driver.state.phase == "fault"
    assert "nothing was received from it" in driver.state.sentence


@every_board
def test_an_axis_that_this_kind_of_board_does_not_have_is_refused(kind):
    axes = (replace(board_of(kind).axes[0], letter="9"),)
    for make in (BOARDS[kind], FIRMWARES[kind]):
        with pytest.raises(InputError, match="letter '9'"):
            make(replace(board_of(kind), axes=axes), BED.masses)


@every_board
@pytest.mark.parametrize("turn", [0.002, 0.02])
def test_what_is_recorded_is_where_masses_were(kind, turn):
    """Rows of moves, with a halt in the middle of one, lie within 40 ms of the true way.

    That is two turns of the slowest conversation: while a row is being asked for, masses go on.
    """
    wire = Wire(kind, turn=turn).at_home()
    begun = wire.t
    wire.driver.go({"x": 6 * MM, "y": -3 * MM, "z": 1 * MM}, wire.t)
    wire.run(1.5)
    wire.driver.go({"x": -6 * MM}, wire.t)
    wire.run(0.7)
    wire.driver.halt(wire.t)
    wire.run(1.0)
    received = RowBuffer(BED.masses)
    for t, position, wants in wire.reported:
        received.masses(position, wants, t)
    rows = received.taken().masses
    t = np.arange(begun, wire.t - 0.2, 0.005)
    for k, name in enumerate("xyz"):
        observed = np.interp(t, rows.t, rows.values[:, k])
        true = np.array([wire.true(name, each) for each in t])
        assert np.max(np.abs(observed - true)) < 0.04 * SPEED
        assert observed[-1] == pytest.approx(true[-1], abs=2e-6)


@every_board
@settings(max_examples=60, deadline=None)
@given(lumps=st.lists(st.binary(max_size=40), max_size=8), after=st.integers(0, 40))
def test_garbage_never_raises_and_makes_nothing_sure(kind, lumps, after):
    """At first and in the middle of a conversation."""
    wire = Wire(kind)
    wire.run(after * TURN)
    wire.driver.home(wire.t)
    wire.run(after * TURN)
    for lump in lumps:
        wire.t = round(wire.t + TURN, 9)
        wire.driver.feed(lump, wire.t)
        wire.driver.due(wire.t)
    assert not wire.driver.state.sure
    counts = wire.driver.counts
    assert min(counts.good, counts.corrupt, counts.foreign) >= 0


def test_legs_end_when_the_first_mass_is_there():
    """1 mm and 4 mm at 8 mm/s: first both for 0.125 s, then one alone."""
    speed = dict.fromkeys("xy", 8 * MM)
    way = next_leg({"x": 0.0, "y": 0.0}, {"x": 1 * MM, "y": -4 * MM}, speed)
    assert way.duration == pytest.approx(0.125)
    assert way.to == pytest.approx({"x": 1 * MM, "y": -1 * MM})
    way = next_leg({"x": 1 * MM, "y": -1 * MM}, {"x": 1 * MM, "y": -4 * MM}, speed)
    assert way.duration == pytest.approx(LEG)
    assert way.to == pytest.approx({"y": -3 * MM})
