"""`equipoise check`, step by step, at emulated devices behind real ports.

Boards without switches are at home at once; that is what makes these tests quick.
"""

from dataclasses import replace

import numpy as np
import pytest

from equipoise.app.bench.bench_check import checked_bench, frame_results
from equipoise.app.bench.emulation import hardware_of
from equipoise.app.bench.explained_conversation import Conversations
from equipoise.app.bench.open_bench import keeper_of
from equipoise.io.testbed.presets import read_preset
from equipoise.model.recording import Recording, Samples

pytest.importorskip("pty", reason="no pseudo terminals")
from tests.support.live_bench import living

NANOSAT = read_preset("nanosat")
(BOARD,) = NANOSAT.hardware.boards
WITHOUT_SENSOR = replace(
    NANOSAT,
    hardware=replace(NANOSAT.hardware, boards=(replace(BOARD, homing=False),), sensors=()),
)


def test_a_bench_without_a_sensor_is_checked_and_not_waited_for():
    with living(WITHOUT_SENSOR) as there:
        found = list(checked_bench(there.testbed(), 2.0, lambda _question: True))
    assert [each.sentence for each in found if not each.good] == []
    said = [each.sentence for each in found]
    assert "no sensor is declared: nothing to stream" in said
    assert sum("moved 1 mm and back" in each for each in said) == 3


def test_an_acceleration_as_delivered_is_a_problem_with_what_to_set():
    with living(WITHOUT_SENSOR) as there:
        there.boards[0].device.board.settings[121] = 10.0
        found = list(checked_bench(there.testbed(), 2.0, lambda question: "home" in question))
    (problem,) = [each.sentence for each in found if not each.good]
    assert problem.startswith("board masses: mass y takes 0.80 s to stop with 10 mm/s^2 ($121)")
    assert "set 80 mm/s^2 or more" in problem


def test_a_conversation_is_printed_as_it_happens_in_both_directions():
    lines = []
    with living(WITHOUT_SENSOR) as there:
        bed = there.testbed()
        opener = Conversations(hardware_of(bed), lines.append).open
        list(checked_bench(bed, 2.0, lambda question: "home" in question, opener))
    said = "\n".join(lines)
    wanted = (
        "-- masses: the port is open",
        "-> masses: restart (0x18)",
        "<- masses: I have begun: Grbl 1.1h",
        "-> masses: list your settings ($$)",
        "<- masses: ok: the line is taken",
        "-> masses: unlock ($X)",
        "<- masses: I am in state Idle at",
    )
    places = [said.find(each) for each in wanted]
    assert min(places) >= 0
    assert places == sorted(places)
    assert "not understood" not in said.replace("'\\xf8\\x00ets boot'", "").replace(
        "something that is not understood: ", "", 1
    )


def test_rows_that_arrive_unevenly_are_no_fault_of_a_sensor_without_stamps():
    """40 Hz with 5 ms of scatter, as on a computer that is busy."""
    t = 0.025 * np.arange(80) + np.random.default_rng(1).normal(0, 0.005, 80)
    attitude = Samples(np.sort(t), np.tile([1.0, 0.0, 0.0, 0.0], (80, 1)))
    keeper = keeper_of(NANOSAT)
    scattered = [
        each
        for each in frame_results(keeper, Recording(attitude))
        if "intervals vary" in each.sentence
    ]
    assert [each.good for each in scattered] == [True]
    assert "those of arrival here" in scattered[0].sentence


TABLE = read_preset("reference-table")
WHEELS = replace(
    TABLE,
    hardware=replace(TABLE.hardware, boards=(), sensors=(), actuators=TABLE.hardware.actuators[:1]),
)


def test_devices_are_driven_to_and_fro_and_follow():
    with living(WHEELS) as there:
        found = list(checked_bench(there.testbed(), 2.0, lambda question: "rw_z" not in question))
    said = [each.sentence for each in found]
    assert [each.sentence for each in found if not each.good] == []
    assert "actuator wheels: answers, settings agree, rw_x, rw_y, rw_z at rest" in said
    assert sum("follows; check its direction of rotation by eye" in each for each in said) == 2
    assert "device rw_z: not driven" in said


def test_an_actuator_that_is_not_what_the_testbed_says_is_named():
    with living(WHEELS) as there:
        bed = there.testbed()
        wheels = tuple(replace(wheel, max_torque=0.02) for wheel in bed.wheels)
        found = list(checked_bench(replace(bed, wheels=wheels), 2.0, lambda _question: True))
    (problem,) = [each.sentence for each in found if not each.good]
    assert "rw_x takes 0.005 N m at most, by the testbed 0.02" in problem
