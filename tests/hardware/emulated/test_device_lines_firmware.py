"""The emulated microcontroller is as unforgiving as docs/device-protocol.md lets a real one be."""

import binascii
import json

import numpy as np
import pytest

from equipoise.hardware.emulated.device_lines import EmulatedDeviceLines
from equipoise.model.recording import Recording, Samples
from tests.support.actuator_wire import BED, unit_of

NAMES = ("wheel:rw_x", "dipole:mt_y", "jet:jp_z")


def line(text, change=0):
    digits = binascii.crc_hqx(text.encode(), 0xFFFF) ^ change
    return b"%b*%04X\n" % (text.encode(), digits)


def firmware():
    return EmulatedDeviceLines(unit_of("device_lines"), BED.devices)


def said(answer):
    """Return the lines of an answer as objects, their checksums checked."""
    found = []
    for each in answer.splitlines():
        body, _, digits = each.rpartition(b"*")
        assert b"%04X" % binascii.crc_hqx(body, 0xFFFF) == digits
        found.append(json.loads(body))
    return found


def answer(device, text, t=0.0):
    return said(device.take(line(text), t))


def test_who_it_is_and_what_it_has():
    device = firmware()
    (hello,) = answer(device, '{"hello":1}')
    assert hello == {"hello": 1, "name": "mixed", "n": 3, "deadman_ms": 500, "period_ms": 20}
    (wheel,) = answer(device, '{"describe":0}')
    assert (wheel["kind"], wheel["name"], wheel["in"], wheel["max"]) == (
        "wheel", "rw_x", "N m", 0.005,
    )  # fmt: skip
    (jet,) = answer(device, '{"describe":2}')
    assert (jet["kind"], jet["max"], jet["min"]) == ("jet", 0, 0.0005)
    assert answer(device, '{"describe":3}') == [{"err": 3, "at": 0}]


REFUSED = {
    '{"set":2,"u":[0.006,null,null]}': 4,
    '{"set":2,"u":[null,-0.41,null]}': 4,
    '{"set":2,"u":[null,null,0.0004]}': 4,
    '{"set":2,"u":[0.001,null]}': 3,
    '{"set":2}': 3,
}


@pytest.mark.parametrize("text", REFUSED)
def test_an_order_is_taken_whole_or_not_at_all(text):
    device = firmware()
    answer(device, '{"arm":1}')
    assert answer(device, text) == [{"err": REFUSED[text], "at": 2}]
    assert device.run(0.0)[1] == []


def test_at_rest_nothing_is_taken():
    assert answer(firmware(), '{"set":1,"u":[0.001,null,null]}') == [{"err": 5, "at": 1}]


def test_an_order_is_taken_once():
    device = firmware()
    answer(device, '{"arm":1}')
    for _ in range(3):
        assert answer(device, '{"set":2,"u":[null,null,0.002]}') == []
    assert answer(device, '{"set":1,"u":[null,null,0.002]}') == []
    assert [(each.device, each.value) for each in device.run(0.0)[1]] == [("jp_z", 0.002)]


@pytest.mark.parametrize("text", ["{", "[1]", "noise", '{"set":2,"u":[0.001,null,null]'])
def test_what_is_no_message_is_refused(text):
    (error,) = answer(firmware(), text)
    assert error["err"] in (1, 2)


def test_a_wrong_checksum_is_as_if_nothing_had_come():
    device = firmware()
    answer(device, '{"arm":1}')
    assert said(device.take(line('{"set":2,"u":[0.001,null,null]}', change=1), 0.4)) == [
        {"err": 1, "at": 0}
    ]
    _, given = device.run(0.55)
    assert [each.value for each in given] == [0.0, 0.0, 0.0]  # its deadman


def test_a_line_that_is_too_long_is_refused_and_the_next_one_read():
    device = firmware()
    assert said(device.take(b"x" * 5000 + b"\n", 0.0)) == [{"err": 6, "at": 0}]
    assert answer(device, '{"hello":1}')[0]["hello"] == 1


def test_it_rests_when_nothing_comes_for_half_a_second_and_says_why():
    device = firmware()
    answer(device, '{"arm":1}')
    answer(device, '{"set":2,"u":[0.001,0.2,null]}')
    device.run(0.1)
    answer(device, '{"beat":1}', 0.4)
    assert device.run(0.9)[1] == []
    assert [each.value for each in device.run(0.91)[1]] == [0.0, 0.0, 0.0]
    device.observe(Recording(), 0.92)
    (report,) = said(device.run(0.92)[0])
    assert (report["m"], report["a"]) == (3, 2)


def test_it_counts_what_the_platform_did_and_a_jets_pulses_in_all():
    """Two pulses of 2 mN m s as means over 10 ms, the way a recording has them."""
    device, t = firmware(), np.arange(1, 11) * 0.01
    rows = np.zeros((10, 3))
    rows[:, 0], rows[:, 1] = 78.5 * t, 0.2
    rows[2, 2] = rows[7, 2] = 0.2
    device.observe(Recording(device_names=NAMES, devices=Samples(t, rows)), 0.1)
    reports = said(device.run(0.1)[0])
    assert [each["t_ms"] for each in reports] == [1020, 1040, 1060, 1080, 1100]
    assert reports[-1]["y"] == pytest.approx([7.85, 0.2, 0.004])


def test_while_it_starts_it_neither_takes_nor_says_anything():
    device = firmware()
    answer(device, '{"arm":1}')
    device.press_reset(0.1)
    assert device.take(line('{"hello":1}'), 0.5) == b""
    device.observe(Recording(), 0.6)
    assert device.run(0.6)[0] == b""
    device.observe(Recording(), 1.2)
    (report,) = said(device.run(1.2)[0])
    assert (report["t_ms"], report["m"], report["a"]) == (1100, 0, 0)
