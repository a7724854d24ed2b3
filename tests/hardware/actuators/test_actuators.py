"""What every driver of wheels, gyros, coils and jets does, at its emulated counterpart."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from equipoise.hardware.actuators.registry import ACTUATORS, EXPLAINED
from equipoise.hardware.emulated.registry import ELECTRONICS
from equipoise.model.errors import BenchStopped
from equipoise.model.reasons.actuator_faults import ActuatorFault
from tests.support.actuator_wire import BED, TURN, ActuatorWire, unit_of

every_driver = pytest.mark.parametrize("kind", sorted(ACTUATORS))


def test_every_driver_has_a_remote_side_and_words():
    assert set(ACTUATORS) == set(ELECTRONICS) == set(EXPLAINED)


@every_driver
def test_it_finds_out_who_it_is_and_rests(kind):
    wire = ActuatorWire(kind).at_rest()
    wire.run(1.0)
    assert (wire.driver.state.active, wire.driver.state.inputs) == (False, {})
    assert wire.given == []
    assert wire.driver.counts.corrupt == 0
    assert wire.reports[-1].values == pytest.approx({"rw_x": 0.0, "mt_y": 0.0, "jp_z": 0.0})


@every_driver
def test_each_device_is_given_its_own_input_and_others_go_on(kind):
    wire = ActuatorWire(kind).working({"rw_x": 0.002, "mt_y": -0.3})
    assert (wire.value("rw_x"), wire.value("mt_y"), wire.value("jp_z")) == (0.002, -0.3, 0.0)
    wire.driver.drive({"mt_y": 0.1}, wire.t)
    wire.run(1.0)
    assert (wire.value("rw_x"), wire.value("mt_y")) == (0.002, 0.1)
    state = wire.driver.state
    assert (state.activity, state.active) == ("working", True)
    assert state.inputs == {"rw_x": 0.002, "mt_y": 0.1}


@every_driver
def test_an_input_reaches_the_device_within_two_turns(kind):
    wire = ActuatorWire(kind).working({"rw_x": 0.001})
    begun = wire.t
    wire.driver.drive({"rw_x": -0.001}, wire.t)
    wire.run(0.5)
    (late,) = (each.t - begun for each in wire.given if each.value == -0.001)
    assert 0.0 < late <= 2 * TURN


@every_driver
@pytest.mark.parametrize("lost", [2, 3, 5])
def test_a_pulse_is_given_once_whatever_the_line_loses(kind, lost):
    """Of every few lines one does not arrive; 20 pulses are 20 pulses, in order."""
    wire, count = ActuatorWire(kind).at_rest(), [0]

    def lossy(data):
        count[0] += bool(data)
        return b"" if data and count[0] % lost == 0 else data

    wire.lost_there = lossy
    pulses = [0.001 * (1 + k) for k in range(20)]
    for pulse in pulses:
        wire.driver.drive({"jp_z": pulse}, wire.t)
        wire.run(0.25)
    assert wire.driver.state.activity == "working"
    assert [each.value for each in wire.given] == pytest.approx(pulses)


@every_driver
def test_garbled_answers_lose_no_order(kind):
    wire = ActuatorWire(kind).working({"rw_x": 0.001})
    rng, feed = np.random.default_rng(0), wire.driver.feed

    def noisy(data, t):
        values = np.frombuffer(data, np.uint8).copy()
        bad = rng.random(len(values)) < 0.01
        values[bad] = rng.integers(0, 256, int(bad.sum()))
        return feed(values.tobytes(), t)

    wire.driver.feed = noisy
    for k in range(20):
        wire.driver.drive({"rw_x": 0.0001 * k}, wire.t)
        wire.run(0.25)
    assert wire.driver.state.activity == "working"
    assert wire.driver.counts.corrupt > 5
    assert wire.value("rw_x") == pytest.approx(0.0019)
    assert all(abs(value) < 1e-12 for each in wire.reports for value in each.values.values())


@every_driver
def test_who_lets_it_rest_finds_every_device_at_rest_within_two_turns(kind):
    wire = ActuatorWire(kind).working({"rw_x": 0.002, "mt_y": 0.2, "jp_z": 0.05})
    wire.driver.rest(wire.t)
    halted = wire.t
    wire.run(0.5)
    assert [wire.value(name) for name in wire.unit.drives] == [0.0, 0.0, 0.0]
    assert max(each.t for each in wire.given) - halted <= 2 * TURN
    assert (wire.driver.state.activity, wire.driver.state.active) == ("resting", False)
    wire.driver.drive({"mt_y": 0.1}, wire.t)
    wire.run(0.5)
    assert (wire.value("rw_x"), wire.value("mt_y")) == (0.0, 0.1)


@every_driver
def test_a_device_whose_computer_has_died_rests_within_its_deadman(kind):
    wire = ActuatorWire(kind).working({"rw_x": 0.002, "mt_y": 0.2})
    died = wire.t
    wire.run(2.0, listen=False)
    assert [wire.value(name) for name in wire.unit.drives] == [0.0, 0.0, 0.0]
    assert 0.3 < max(each.t for each in wire.given) - died < 0.55


@every_driver
def test_a_computer_that_pauses_finds_out_that_the_device_rests(kind):
    wire = ActuatorWire(kind).working({"rw_x": 0.002})
    wire.pause(3.0)
    state = wire.run(0.5, until="at fault")
    assert state.fault.code is ActuatorFault.DEADMAN
    rests_until_begun(wire)


@every_driver
def test_a_short_pause_disturbs_nothing(kind):
    wire = ActuatorWire(kind).working({"rw_x": 0.002})
    wire.pause(0.35)
    assert wire.run(1.0).activity == "working"
    assert wire.value("rw_x") == 0.002


def rests_until_begun(wire):
    """Nothing is taken before it restarts; then all is well."""
    given = len(wire.given)
    with pytest.raises(BenchStopped, match="actuator mixed"):
        wire.driver.drive({"rw_x": 0.001}, wire.t)
    wire.run(1.5)
    assert not any(each.value for each in wire.given[given:])
    assert [wire.value(name) for name in wire.unit.drives] == [0.0, 0.0, 0.0]
    wire.driver.begin(wire.t)
    wire.at_rest().driver.drive({"rw_x": 0.001}, wire.t)
    wire.run(0.5)
    assert wire.value("rw_x") == 0.001


TROUBLE = {
    "reset": (lambda wire: wire.remote.press_reset(wire.t), ActuatorFault.SILENT),
    "no power": (lambda wire: wire.remote.switch(False, wire.t), ActuatorFault.SILENT),
    "a fault of its own": (
        lambda wire: setattr(wire.remote.actuator, "fault", 3), ActuatorFault.OWN_FAULT,
    ),
    "a cut line": (lambda wire: setattr(wire, "cut", True), ActuatorFault.SILENT),
}  # fmt: skip


@every_driver
@pytest.mark.parametrize("late", [0.3, 0.31, 0.32, 0.33, 0.34])
@pytest.mark.parametrize("trouble", TROUBLE)
def test_trouble_is_a_fault_in_words_and_ends_when_its_cause_is_gone(kind, late, trouble):
    strike, code = TROUBLE[trouble]
    wire = ActuatorWire(kind).working({"rw_x": 0.001, "mt_y": 0.1})
    wire.run(late)
    strike(wire)
    state = wire.run(2.0, until="at fault")
    assert state.activity == "at fault"
    assert state.fault.code is code
    assert len(state.sentence) > 20
    wire.run(1.0)
    wire.cut, wire.remote.actuator.fault = False, 0
    wire.remote.switch(True, wire.t)
    wire.run(1.1)
    rests_until_begun(wire)


@every_driver
def test_a_device_that_begins_anew_and_reports_at_once_is_at_fault(kind):
    """Its clock restarts with it; counts that go on from zero are no motion."""
    wire = ActuatorWire(kind).working({"rw_x": 0.001})
    begun = wire.driver.begun
    wire.remote.actuator.press_reset(wire.t - 1.0)  # it takes no time to start
    state = wire.run(1.0, until="at fault")
    assert state.fault.code is ActuatorFault.BEGAN_ANEW
    assert wire.driver.begun == begun + 1
    rests_until_begun(wire)


@every_driver
def test_orders_that_do_not_arrive_are_a_fault(kind):
    """It reports all the while, and something else reaches it instead."""
    wire = ActuatorWire(kind).working({"rw_x": 0.001})
    wire.run(0.5)
    (beat, *_) = (line for line in wire.sent.splitlines(True) if b"beat" in line)
    wire.lost_there = lambda data: beat if b"set" in data else data
    wire.driver.drive({"rw_x": 0.002}, wire.t)
    state = wire.run(2.0, until="at fault")
    assert state.fault.code is ActuatorFault.LATE
    assert wire.value("rw_x") == 0.001


@every_driver
def test_a_device_that_was_unplugged_rests_and_is_known_again(kind):
    wire = ActuatorWire(kind).working({"rw_x": 0.001})
    wire.driver.closed("gone")
    assert wire.driver.state.fault.code is ActuatorFault.PORT_GONE
    assert "(gone)" in wire.driver.state.sentence
    wire.run(1.0, listen=False)
    wire.driver.opened(wire.t)
    wire.at_rest()
    assert not any(wire.value(name) for name in wire.unit.drives)


@every_driver
def test_a_silent_device_is_reported_as_a_fault(kind):
    driver = ACTUATORS[kind](unit_of(kind), BED.devices)
    driver.opened(0.0)
    for k in range(500):
        driver.due(k * TURN)
    assert driver.state.activity == "at fault"
    assert driver.state.fault.code is ActuatorFault.NOTHING_RECEIVED


@every_driver
def test_something_else_at_the_port_is_reported_as_it_is(kind):
    driver = ACTUATORS[kind](unit_of(kind), BED.devices)
    driver.opened(0.0)
    for k in range(500):
        driver.feed(b"12345,0.7071\r\n", k * TURN)
        driver.due(k * TURN)
    assert driver.state.fault.code is ActuatorFault.NOT_ITS_KIND
    assert "12345,0.7071" in driver.state.sentence


@every_driver
def test_a_device_that_was_on_when_the_program_came_rests_first(kind):
    """A program that was killed within the deadman's time left it working."""
    wire = ActuatorWire(kind).working({"rw_x": 0.002})
    other = ACTUATORS[kind](wire.unit, BED.devices)
    other.opened(wire.t)
    wire.driver = other
    wire.at_rest()
    assert wire.value("rw_x") == 0.0


@every_driver
@settings(max_examples=60, deadline=None)
@given(lumps=st.lists(st.binary(max_size=60), max_size=8), after=st.integers(0, 40))
def test_garbage_never_raises_and_nothing_works_by_it(kind, lumps, after):
    wire = ActuatorWire(kind)
    wire.run(after * TURN)
    for lump in lumps:
        wire.t = round(wire.t + TURN, 9)
        for report in wire.driver.feed(lump, wire.t):
            assert np.all(np.isfinite(list(report.values.values())))
        wire.driver.due(wire.t)
    assert not wire.driver.state.active
    assert wire.driver.taken == []
