"""Interlocks: each limit stops, what is within does not, one bad row is no reason."""

import math
from dataclasses import replace

import numpy as np
import pytest

from equipoise.hardware.bench.interlocks import Observed, silence, tripped, turning
from equipoise.hardware.transport.driver_protocol import (
    Activity,
    ActuatorState,
    BoardState,
    Phase,
)
from equipoise.io.testbed.presets import read_preset
from equipoise.maths.attitude import from_euler321
from equipoise.model.hardware import SafetyLimits
from equipoise.model.reasons.actuator_faults import ActuatorFault
from equipoise.model.reasons.board_faults import BoardFault
from equipoise.model.reasons.interlocks import Interlock
from equipoise.model.reasons.reason import Reason
from equipoise.model.units import DEG

BED = read_preset("nanosat")  # tilt limit 40 deg; masses of 8 mm/s on +-15 mm
LIMITS = SafetyLimits(rate=math.radians(60), stale=0.5, mismatch=1e-3)


def attitudes(*rolls_deg):
    rolls = np.radians(rolls_deg)
    return [(0.1 * k, from_euler321(roll, 0.0, 0.0)) for k, roll in enumerate(rolls)]


def rates(*deg_s):
    return [(0.1 * k, np.array([0.0, r * DEG, 0.0])) for k, r in enumerate(deg_s)]


def board(phase="ready", at=0.0, goal=0.0, sure=True):
    fault = Reason(BoardFault.DISAGREES, ("hit",)) if phase == "fault" else None
    return BoardState(Phase(phase), fault, {"x": at}, {"x": goal}, 10.0, sure)


CALM = Observed(
    10.0, attitudes(1, 2, 3), rates(1, 1, 1), {("imu", "attitude"): 0.1}, {"masses": board()}
)


def kind(**changes):
    trip = tripped(replace(CALM, **changes), BED, LIMITS)
    return None if trip is None else trip.code


def test_a_calm_bench_is_let_alone():
    assert tripped(CALM, BED, LIMITS) is None


@pytest.mark.parametrize(("rolls", "stops"), [((39, 39, 39.9), False), ((39, 40.5, 41), True)])
def test_tilt_beyond_its_limit_stops(rolls, stops):
    assert (kind(attitudes=attitudes(*rolls)) == "tilt") is stops


def test_one_bad_row_of_attitude_or_rate_does_not_stop():
    assert kind(attitudes=attitudes(2, 170, 3)) is None
    assert kind(rates=rates(2, 900, 3)) is None


def test_rate_beyond_its_limit_stops_and_says_both():
    trip = tripped(replace(CALM, rates=rates(70, 71, 72)), BED, LIMITS)
    assert trip.code == "rate"
    assert "71.0 deg/s" in trip.sentence
    assert "60.0 deg/s" in trip.sentence


def test_without_a_gyro_the_rate_is_that_of_the_attitudes():
    """From 0 to 4 deg in two rows of 0.1 s: 20 deg/s."""
    observed = replace(CALM, rates=(), attitudes=attitudes(0, 2, 4))
    assert turning(observed) == pytest.approx(20 * DEG, rel=1e-9)


def test_a_silent_sensor_stops_moving_masses_and_is_only_reported_at_rest():
    quiet = {("imu", "rate"): 0.6}
    assert kind(silent=quiet) is None
    assert silence(replace(CALM, silent=quiet), LIMITS).sentence == (
        "sensor imu has not delivered a row of rate for 0.6 s"
    )
    assert kind(silent=quiet, boards={"masses": board("moving", goal=5e-3)}) == "silence"


def test_a_mass_beyond_its_travel_stops():
    assert kind(boards={"masses": board(at=15.9e-3, goal=15e-3)}) is None
    assert kind(boards={"masses": board("moving", at=16.1e-3, goal=15e-3)}) == "travel"


def test_a_mass_that_stands_elsewhere_than_it_was_sent_stops():
    trip = tripped(replace(CALM, boards={"masses": board(at=3e-3, goal=5e-3)}), BED, LIMITS)
    assert trip.code == "mismatch"
    assert "3.00 mm; its commanded position is 5.00 mm" in trip.sentence
    assert kind(boards={"masses": board("moving", at=3e-3, goal=5e-3)}) is None


def test_a_mass_faster_than_it_can_be_stops():
    """2.5 mm in 0.2 s are 12.5 mm/s, beyond 1.5 times 8 mm/s; 2.3 mm are not."""
    fast = {"masses": board("moving", at=2.5e-3, goal=9e-3)}
    slow = {"masses": board("moving", at=2.3e-3, goal=9e-3)}
    assert kind(boards=fast, before={"x": (9.8, 0.0)}) == "speed"
    assert kind(boards=slow, before={"x": (9.8, 0.0)}) is None


def test_a_board_that_is_not_sure_of_its_position_is_not_judged_by_it():
    assert kind(boards={"masses": board(at=0.5, sure=False)}) is None
    assert kind(boards={"masses": board("homing", at=0.5)}) is None


def test_a_fault_is_reported_in_the_boards_words():
    state = board("fault", sure=False)
    trip = tripped(replace(CALM, boards={"masses": state}), BED, LIMITS)
    assert trip.sentence == "board masses: hit; correct one of the two"


def wheels(activity="working", torque=0.001):
    fault = Reason(ActuatorFault.HALTED_THERE) if activity == "at fault" else None
    return {"wheels": ActuatorState(Activity(activity), fault, {"rw_x": torque, "rw_y": 0.0})}


def test_an_actuator_at_fault_stops_with_its_sentence():
    trip = tripped(replace(CALM, actuators=wheels("at fault")), BED, LIMITS)
    assert (trip.code, trip.parameters[0]) == (Interlock.DEVICE_FAULT, "wheels")
    assert "actuator wheels: it was halted, and not by this program" in trip.sentence
    assert kind(actuators=wheels("resting")) is None
    assert kind(actuators=wheels("connecting to it")) is None


def test_a_device_that_does_not_follow_stops():
    numbers = {"wanted": 24.0, "counted": 0.0, "seconds": 1.2}
    reason = Reason(Interlock.NOT_FOLLOWING, ("rw_x", "rad/s"), numbers)
    assert kind(deviation=reason) is Interlock.NOT_FOLLOWING


def test_a_sensor_that_falls_silent_stops_a_device_that_turns_the_platform():
    silent = {("imu", "attitude"): 0.6}
    assert kind(silent=silent, actuators=wheels()) is Interlock.SILENCE
    assert kind(silent=silent, actuators=wheels(torque=0.0)) is None
    assert kind(silent=silent, actuators=wheels("resting")) is None


def test_tilt_stops_devices_that_work_where_no_board_is():
    leaning = attitudes(41, 41, 41)
    assert kind(attitudes=leaning, boards={}) is None
    assert kind(attitudes=leaning, boards={}, actuators=wheels("resting")) is None
    assert kind(attitudes=leaning, boards={}, actuators=wheels(torque=0.0)) is Interlock.TILT
