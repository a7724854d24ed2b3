"""MAVLink: bytes by hand, the sense of its quaternion, clocks, requests."""

import math
import struct
from dataclasses import replace

import numpy as np
import pytest
from pymavlink.dialects.v20 import common

from equipoise.hardware.emulated.mavlink import EmulatedMavlink
from equipoise.hardware.links.frame_transform import placed
from equipoise.hardware.links.sensor_link import UNSTATED, SensorLink
from equipoise.hardware.sensors.mavlink import Mavlink
from equipoise.maths.attitude import to_matrix
from equipoise.model.errors import InputError
from equipoise.model.recording import Recording, Samples
from tests.support.sensor_units import unit

HALF = math.sqrt(0.5)


def checksum(data):
    """Return CRC-16/MCRF4XX, as the protocol's page "Packet serialization" names it."""
    crc = 0xFFFF
    for byte in data:
        crc ^= byte
        for _ in range(8):
            crc = crc >> 1 ^ 0x8408 if crc & 1 else crc >> 1
    return crc


def frame(message_id, extra, payload, version=2, system=1):
    """Return a frame by hand.

    MAVLink 2: FD, length, two flags, number, system, component, id in three bytes, payload without
    zeros at its end; MAVLink 1: FE, length, number, system, component, id in one byte. The
    checksum is over all after the first byte, and a byte of the message's definition (CRC_EXTRA).
    """
    if version == 2:
        payload = payload.rstrip(b"\0")
        head = struct.pack("<BBBBBB", len(payload), 0, 0, 7, system, 1)
        body = head + message_id.to_bytes(3, "little") + payload
    else:
        body = struct.pack("<BBBBB", len(payload), 7, system, 1, message_id) + payload
    first = b"\xfd" if version == 2 else b"\xfe"
    return first + body + struct.pack("<H", checksum(body + bytes([extra])))


def attitude(boot_ms, q, rates=(0.0, 0.0, 0.0), **how):
    """Return ATTITUDE_QUATERNION, whose CRC_EXTRA is 246."""
    return frame(31, 246, struct.pack("<I7f", boot_ms, *q, *rates), **how)


def imu(time_us, gyro, updated=0xFFF, **how):
    """Return HIGHRES_IMU, whose CRC_EXTRA is 93: time, acc, gyro, mag, four more, what is new."""
    rest = (0.2, 0.0, 0.4, 1013.0, 0.0, 100.0, 25.0)
    return frame(105, 93, struct.pack("<Q13fH", time_us, 0, 0, -9.8, *gyro, *rest, updated), **how)


@pytest.mark.parametrize("version", [1, 2])
def test_bytes_by_hand_are_understood(version):
    """The checksum of "123456789" is 0x6F91, as every catalogue of checksums has it."""
    assert checksum(b"123456789") == 0x6F91
    driver = Mavlink(unit("mavlink"))
    (turn,) = driver.feed(attitude(20500, (0.5, 0.5, -0.5, 0.5), (9, 9, 9), version=version))
    assert (turn.channel, turn.values, turn.stamp) == ("attitude", (0.5, 0.5, -0.5, 0.5), 20.5)
    (rate,) = driver.feed(imu(1_700_000_000_250_000, (0.25, -0.5, 2.0), version=version))
    assert (rate.channel, rate.values) == ("rate", (0.25, -0.5, 2.0))
    assert rate.stamp == pytest.approx(1.7e9 + 0.25)
    assert driver.counts.good == 2


def test_the_turn_from_north_to_east_by_hand():
    """Nose east, level: a quarter turn about down. Our x is north, y west: the nose is at -y.

    The vehicle is mounted upright on our body (z up): its right side is our body's -y, its down
    our -z.
    """
    device = unit("mavlink", "ned", np.diag([1.0, -1.0, -1.0]))
    (row,) = Mavlink(device).feed(attitude(0, (HALF, 0, 0, HALF)))
    turn = to_matrix(placed(device, "attitude", np.array(row.values)))
    np.testing.assert_allclose(turn @ [1, 0, 0], [0, -1, 0], atol=1e-7)
    np.testing.assert_allclose(turn @ [0, 0, 1], [0, 0, 1], atol=1e-7)
    # Nose up: a turn about the right side; the nose then points at our zenith.
    (row,) = Mavlink(device).feed(attitude(0, (HALF, 0, HALF, 0)))
    turn = to_matrix(placed(device, "attitude", np.array(row.values)))
    np.testing.assert_allclose(turn @ [1, 0, 0], [0, 0, 1], atol=1e-7)


def test_the_rate_comes_from_one_message_only():
    both = attitude(1, (1, 0, 0, 0), (0.5, 0, 0)) + imu(1, (0.25, 0, 0))
    found = Mavlink(unit("mavlink")).feed(both)
    assert [(r.channel, r.values[0]) for r in found] == [("attitude", 1.0), ("rate", 0.25)]
    found = Mavlink(unit("mavlink", rate_from="ATTITUDE_QUATERNION")).feed(both)
    assert [(r.channel, r.values[0]) for r in found] == [("attitude", 1.0), ("rate", 0.5)]
    with pytest.raises(InputError, match="did you mean 'HIGHRES_IMU'"):
        Mavlink(unit("mavlink", rate_from="HIRES_IMU"))


def test_what_is_no_row_is_counted():
    """Of another vehicle, a gyro that is not new, another message; broken: checksum, no turn."""
    driver = Mavlink(unit("mavlink"))
    good = attitude(1, (1, 0, 0, 0))
    assert len(driver.feed(good)) == 1
    for other in (attitude(1, (1, 0, 0, 0), system=2), imu(1, (1, 1, 1), updated=0x7)):
        assert driver.feed(other) == []
    assert driver.feed(frame(0, 50, struct.pack("<IBBBBB", 0, 2, 12, 0, 4, 3))) == []  # heartbeat
    assert driver.counts.foreign == 3
    bad = [good[:-1] + bytes([good[-1] ^ 1]), attitude(1, (1, 1, 0, 0)),
           attitude(1, (math.nan, 0, 0, 0)), imu(1, (math.inf, 0, 0))]  # fmt: skip
    for each in bad:
        assert driver.feed(each) == []
    assert driver.counts.corrupt == len(bad)
    assert len(driver.feed(b"junk" + good)) == 1


BEAT = frame(0, 50, struct.pack("<IBBBBB", 0, 2, 12, 0, 4, 3))  # of a vehicle
ACCEPTED, DENIED, IN_PROGRESS = 0, 2, 5


def acknowledged(result, command=511, station=255):
    """Return COMMAND_ACK, whose CRC_EXTRA is 143: command, result, then who it is for."""
    return frame(77, 143, struct.pack("<HBBiBB", command, result, 0, 0, station, 190))


def requested(data):
    """Return which messages are asked for, and how many microseconds apart."""
    said = common.MAVLink(None).parse_buffer(data) or []
    return [(m.param1, m.param2) for m in said if m.get_type() == "COMMAND_LONG"]


def test_it_sends_heartbeats_and_requests_until_each_is_accepted():
    """MAV_CMD_SET_MESSAGE_INTERVAL is 511: message, microseconds; 50 Hz are 20 000."""
    device = unit("mavlink", rate_hz=50.0)
    driver, remote = Mavlink(device), EmulatedMavlink(device)
    driver.opened()
    first = driver.due(0.0)
    (beat,) = common.MAVLink(None).parse_buffer(first)
    assert (beat.get_type(), beat.type, beat.autopilot) == ("HEARTBEAT", 6, 8)
    assert driver.due(0.99) == b""
    assert remote.take(first, 0.0) == b""  # no vehicle yet, so nothing is asked for
    driver.feed(BEAT)
    answer = remote.take(driver.due(1.0), 1.0)
    assert remote.requested == {31: 20000.0}
    driver.feed(answer)
    driver.feed(remote.take(driver.due(1.01), 1.01))
    assert remote.requested == {31: 20000.0, 105: 20000.0}
    kinds = [m.get_type() for m in common.MAVLink(None).parse_buffer(driver.due(2.0))]
    assert kinds == ["HEARTBEAT"]


def test_an_acknowledgement_is_credited_to_its_own_request():
    """The first is sent three times: of its three answers one counts, the others are void."""
    driver = Mavlink(unit("mavlink", rate_hz=50.0))
    driver.feed(BEAT)
    for t in (0.0, 1.0, 2.0):
        assert requested(driver.due(t)) == [(31.0, 20000.0)]
    driver.feed(acknowledged(ACCEPTED, command=400) + acknowledged(ACCEPTED, station=254))
    assert driver.requests.first == "the interval of ATTITUDE_QUATERNION"
    driver.feed(acknowledged(ACCEPTED))
    assert requested(driver.due(2.01)) == [(105.0, 20000.0)]
    driver.feed(acknowledged(ACCEPTED) + acknowledged(ACCEPTED))
    assert driver.requests.first == "the interval of HIGHRES_IMU"
    driver.feed(acknowledged(IN_PROGRESS))
    assert driver.requests.first == "the interval of HIGHRES_IMU"
    driver.feed(acknowledged(ACCEPTED))
    assert driver.requests.first is None


def test_a_refusal_is_no_confirmation_and_is_reported():
    driver = Mavlink(replace(unit("mavlink", rate_hz=50.0), gives=("attitude",)))
    driver.feed(BEAT)
    for k in range(80):
        if requested(driver.due(0.05 * k)):
            driver.feed(acknowledged(DENIED))
    (overdue,) = driver.requests.overdue
    assert (overdue.times, overdue.answer) == (4, "MAV_RESULT_DENIED")


class Wire:
    """A connection that hands on what a test puts in."""

    def __init__(self):
        self.data, self.why = (), ""

    def turn(self, t):
        return self

    opened, lost = False, ""

    def send(self, data, t):
        pass


def test_two_clocks_of_one_device_do_not_disturb_each_other():
    """Time since boot and Unix time, 10 ms late both: no jump, rows in step with their stamps."""
    device = unit("mavlink")
    wire = Wire()
    link, remote = SensorLink(device, Mavlink(device), wire, UNSTATED), EmulatedMavlink(device)
    rows = []
    for k in range(1, 100):
        t = np.array([0.025 * k])
        q = np.array([[np.cos(t[0]), np.sin(t[0]), 0, 0]])
        wire.data = tuple(
            remote.messages(Recording(Samples(t, q), Samples(t, np.full((1, 3), t[0]))))
        )
        late = 0.01 + 0.003 * (k % 5)
        rows += [(row, t[0]) for row in link.turn(t[0] + late)]
    assert len(rows) == 198
    assert all(clock.jumps == 0 for clock in link.clocks.values())
    assert set(link.clocks) == {"attitude", "rate"}
    errors = [row.t - t for row, t in rows[20:]]
    # The least delay is 10 ms; stamps of the attitude are whole milliseconds.
    assert errors == pytest.approx(np.full(len(errors), 0.01), abs=1e-3)


def test_an_attitude_only_unit_requests_attitude_only():
    device = replace(unit("mavlink", rate_hz=10.0), gives=("attitude",))
    driver = Mavlink(device)
    driver.feed(attitude(1, (1, 0, 0, 0)))
    requested = common.MAVLink(None).parse_buffer(driver.due(0.0))[1:]
    assert [(m.command, m.param1, m.param2) for m in requested] == [(511, 31.0, 1e5)]
