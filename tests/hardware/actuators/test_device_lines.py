"""Device lines by the bytes of docs/device-protocol.md, and the checksum by its check value."""

import re
from pathlib import Path

import pytest

from equipoise.hardware.actuators.checked_lines import LONGEST, checked, listed, message_in
from equipoise.hardware.actuators.device_lines import DeviceLines
from equipoise.hardware.actuators.explained import DeviceLinesExplained
from equipoise.hardware.actuators.messages import read_message
from equipoise.hardware.transport.driver_protocol import Counted, Taken
from equipoise.model.reasons.actuator_faults import ActuatorFault, ActuatorRemark
from tests.support.actuator_wire import BED, unit_of

PAGE = (Path(__file__).parents[3] / "docs" / "device-protocol.md").read_text(encoding="utf-8")
CONVERSATION = re.findall(r"^(->|<-) (.+)$", PAGE[PAGE.index("## A conversation") :], re.MULTILINE)
SAID = [line for way, line in CONVERSATION if way == "->"]
ANSWERED = [line for way, line in CONVERSATION if way == "<-"]


def driver_of(*drives):
    driver = DeviceLines(unit_of("device_lines", drives or ("rw_x",)), BED.devices)
    driver.opened(0.0)
    return driver


def line(text):
    return checked(text)


def connected(driver, text_of_output=None):
    """Return the driver after hello and the description of its one output."""
    driver.due(0.0)
    driver.feed(line('{"hello":1,"name":"m","n":1,"deadman_ms":500,"period_ms":20}'), 0.01)
    driver.due(0.02)
    described = text_of_output or (
        '{"device":0,"kind":"wheel","name":"rw_x","in":"N m","counts":"rad/s","max":0.005}'
    )
    driver.feed(line(described), 0.03)
    return driver


def test_the_checksum_is_ccitt_false():
    """Its published check value: 29B1 of the nine digits."""
    assert checked("123456789") == b"123456789*29B1\n"
    assert message_in(b'{"beat":1}*A3E0\r') == {"beat": 1}
    assert message_in(b'{"beat":1}*A3E1') is None
    assert message_in(b'{"beat":1}') is None
    assert message_in(checked("[1]").strip()) is None


def test_inputs_are_plain_decimals_and_eight_of_them_are_a_line():
    assert listed([0.001, None, -0.0, -2.5e-5, 1.0]) == "0.001,null,0,-0.000025,1"
    many = listed([-0.123456789] * 8)
    assert len(checked(f'{{"set":4294967295,"u":[{many}]}}')) <= LONGEST


def test_the_documented_conversation_is_had_byte_by_byte():
    """The wheel of the page: to be armed, set to 0.001 N m, kept going and halted."""
    driver, counted, t = driver_of(), [], 0.0
    for way, text in CONVERSATION:
        t += 0.02
        if way == "<-":
            counted += driver.feed(text.encode() + b"\r\n", t)
            continue
        if "arm" in text:
            driver.drive({"rw_x": 0.001}, t)
        if "beat" in text:
            t += 0.1
        if "halt" in text:
            driver.rest(t)
        assert driver.due(t) == text.encode() + b"\n"
    assert [each.stamp for each in counted] == pytest.approx([3.07, 3.09, 3.11, 3.19, 3.21])
    assert counted[-1] == Counted(3.21, {"rw_x": 1.7718})
    assert driver.taken[0].inputs == {"rw_x": 0.001}
    assert isinstance(driver.taken[-1], Taken)
    assert driver.taken[-1].inputs == {"rw_x": 0.0}
    assert (driver.state.activity, driver.counts.corrupt) == ("resting", 0)
    assert driver.due(t + 1.0) == b""


def test_the_documented_lines_are_whole():
    for text in re.findall(r"\{[^`\n]+\}\*[0-9A-F]{4}", PAGE):
        assert message_in(text.encode()) is not None, text
    assert all(len(text) < LONGEST for _, text in CONVERSATION)


DISAGREE = {
    "is called 'rw_y', in the testbed 'rw_x'":
        '{"device":0,"kind":"wheel","name":"rw_y","in":"N m","counts":"rad/s","max":0.005}',
    "is a 'dipole', in the testbed 'wheel'":
        '{"device":0,"kind":"dipole","name":"rw_x","in":"N m","counts":"rad/s","max":0.005}',
    "takes 'mN m', in the testbed 'N m'":
        '{"device":0,"kind":"wheel","name":"rw_x","in":"mN m","counts":"rad/s","max":0.005}',
    "counts 'rpm', in the testbed 'rad/s'":
        '{"device":0,"kind":"wheel","name":"rw_x","in":"N m","counts":"rpm","max":0.005}',
    "rw_x takes 0.004 N m at most, by the testbed 0.005":
        '{"device":0,"kind":"wheel","name":"rw_x","in":"N m","counts":"rad/s","max":0.004}',
}  # fmt: skip


@pytest.mark.parametrize("said", DISAGREE)
def test_an_output_that_is_another_than_the_testbeds_is_a_fault(said):
    state = connected(driver_of(), DISAGREE[said]).state
    assert state.fault.code is ActuatorFault.DISAGREES
    assert said in state.sentence


@pytest.mark.parametrize(
    ("answer", "said"),
    [
        ('{"hello":2,"name":"m","n":1,"deadman_ms":500}', "speaks version 2"),
        ('{"hello":1,"name":"m","n":2,"deadman_ms":500}', "has 2 outputs, the testbed drives 1"),
        ('{"hello":1,"name":"m","n":1,"deadman_ms":5000}', "deadman is 5 s; wanted 0.2 to 1 s"),
    ],
)
def test_who_it_is_must_fit(answer, said):
    driver = driver_of()
    driver.due(0.0)
    driver.feed(line(answer), 0.01)
    assert driver.state.fault.code is ActuatorFault.DISAGREES
    assert said in driver.state.sentence


def test_a_greater_limit_than_the_testbeds_is_no_fault_and_a_wheel_that_spins_down_a_remark():
    driver = connected(
        driver_of(),
        '{"device":0,"kind":"wheel","name":"rw_x","in":"N m","counts":"rad/s","max":0.01,'
        '"min":0,"rest":"spin_down"}',
    )
    assert driver.state.activity == "resting"
    (remark,) = driver.remarks
    assert remark.code is ActuatorRemark.SPINS_DOWN
    assert connected(driver_of()).remarks == []


@pytest.mark.parametrize(("mode", "code"), [
    (0, ActuatorFault.BEGAN_ANEW), (2, ActuatorFault.HALTED_THERE), (3, ActuatorFault.DEADMAN),
])  # fmt: skip
def test_a_device_that_rests_unasked_is_at_fault(mode, code):
    driver = connected(driver_of())
    driver.drive({"rw_x": 0.001}, 0.1)
    driver.due(0.1)
    driver.feed(line('{"t_ms":1,"a":1,"m":1,"f":0,"y":[0]}'), 0.12)
    assert driver.state.activity == "working"
    driver.feed(line(f'{{"t_ms":2,"a":1,"m":{mode},"f":0,"y":[0]}}'), 0.14)
    assert driver.state.fault.code is code
    assert b'"halt"' in driver.due(0.16)


@pytest.mark.parametrize("code", [2, 3, 4])
def test_an_order_that_is_refused_is_a_fault_with_its_cause(code):
    driver = connected(driver_of())
    driver.drive({"rw_x": 0.001}, 0.1)
    driver.due(0.1)
    driver.feed(line(f'{{"err":{code},"at":1}}'), 0.12)
    assert driver.state.fault.code is ActuatorFault.REFUSED
    assert "order 1" in driver.state.sentence


def test_a_line_that_came_broken_is_said_again():
    driver = connected(driver_of())
    driver.drive({"rw_x": 0.001}, 0.1)
    first = driver.due(0.1)
    driver.feed(line('{"err":1,"at":0}'), 0.12)
    assert driver.due(0.15) == b""
    assert driver.due(0.21) == first


def test_a_device_that_does_not_rest_is_a_fault_and_is_halted_again_and_again():
    driver, said = connected(driver_of()), b""
    driver.drive({"rw_x": 0.001}, 0.1)
    driver.due(0.1)
    driver.feed(line('{"t_ms":1,"a":1,"m":1,"f":0,"y":[0]}'), 0.12)
    driver.rest(0.14)
    for k in range(100):
        t = 0.14 + 0.02 * k
        said += driver.due(t)
        driver.feed(line(f'{{"t_ms":{10 + k},"a":1,"m":1,"f":0,"y":[0]}}'), t)
    assert driver.state.fault.code is ActuatorFault.NOT_STOPPED
    assert said.count(b"halt") == pytest.approx(20, abs=2)


BROKEN = (
    '{"t_ms":1.5,"a":1,"m":1,"f":0,"y":[0]}', '{"t_ms":1,"a":1,"m":7,"f":0,"y":[0]}',
    '{"t_ms":1,"a":1,"m":1,"f":0,"y":[null]}', '{"t_ms":1,"a":1,"m":1,"f":0,"y":[1e999]}',
    '{"t_ms":1,"a":1,"m":1,"f":0,"y":{"0":1}}', '{"t_ms":-1,"a":1,"m":1,"f":0,"y":[0]}',
    '{"t_ms":1,"a":true,"m":1,"f":0,"y":[0]}', '{"t_ms":1}', '{"hello":"1"}', '{"err":[]}',
    '{"device":0,"kind":1,"name":"rw_x","in":"N m","counts":"rad/s","max":0.005}', '{}',
)  # fmt: skip


@pytest.mark.parametrize("text", BROKEN)
def test_a_message_that_is_not_whole_is_none(text):
    assert read_message(message_in(checked(text).strip())) is None
    driver = connected(driver_of())
    before = driver.counts
    assert driver.feed(line(text), 0.1) == []
    assert driver.counts.foreign == before.foreign + 1
    assert driver.state.activity == "resting"


def test_the_conversation_in_words():
    words = DeviceLinesExplained()
    said = [each for text in SAID for each in words.sent(text.encode() + b"\n")]
    assert said == [
        "who are you?", "what is your output 0?", "order 1: begin to work",
        "order 2: inputs 0.001", "go on", "rest",
    ]  # fmt: skip
    answers = [each for text in ANSWERED for each in words.received(text.encode() + b"\n")]
    assert answers[:3] == [
        "rests since its start, has taken order 0", "wheels, 1 outputs, version 1",
        "output 0 is wheel rw_x, 0.005 N m",
    ]  # fmt: skip
    assert answers[-1] == "rests, has taken order 2"
    assert words.received(b"noise\n") == ["something that is not understood"]
    assert words.received(line('{"err":4,"at":9}')) == ["refused: an input is beyond its limit"]


def test_a_device_that_says_the_same_lines_for_ever_is_silent():
    driver = connected(driver_of())
    driver.drive({"rw_x": 0.001}, 0.1)
    driver.due(0.1)
    for k in range(100):
        t = 0.12 + 0.01 * k
        driver.feed(line(f'{{"t_ms":{1 + k % 2},"a":1,"m":1,"f":0,"y":[0]}}'), t)
        driver.due(t)
    assert driver.state.fault.code in (ActuatorFault.SILENT, ActuatorFault.LATE)


def test_a_clock_of_32_bits_that_begins_anew_is_no_silence():
    driver = connected(driver_of())
    driver.drive({"rw_x": 0.001}, 0.1)
    driver.due(0.1)
    begun = driver.begun
    for k in range(200):
        t, clock = 0.12 + 0.01 * k, (2**32 - 500 + 10 * k) % 2**32
        driver.feed(line(f'{{"t_ms":{clock},"a":{1 if k < 5 else 2},"m":1,"f":0,"y":[0]}}'), t)
        driver.due(t)
    assert driver.state.activity == "working"
    assert driver.begun == begun + 1
