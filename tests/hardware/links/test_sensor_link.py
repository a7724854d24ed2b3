"""A sensor's link: life by channel, pauses of the host, devices that restart."""

import math
from dataclasses import replace

import pytest
from pymavlink.dialects.v20 import common

from equipoise.hardware.links.sensor_link import UNSTATED, SensorLink
from equipoise.hardware.sensors.registry import DRIVERS
from equipoise.hardware.transport.reconnecting_port import Turn
from tests.support.sensor_units import ROW, unit

TURN = 0.02  # s


class Handed:
    """A port that hands on what a test puts in."""

    why = ""

    def __init__(self):
        self.data, self.opened, self.sent = [], False, []

    def turn(self, _t):
        data, opened, self.data, self.opened = tuple(self.data), self.opened, [], False
        return Turn(data, opened)

    def send(self, data, _t):
        self.sent.append(data)
        return Turn()


def link_of(driver="lines", gives=("attitude", "rate"), **settings):
    device = replace(unit(driver, **settings), gives=gives)
    wire = Handed()
    return SensorLink(device, DRIVERS[driver](device), wire, UNSTATED), wire


def row(k, n=None):
    """Return a line stamped 5 s + 20 ms k: turned about x, turning about x."""
    half = 0.01 * k
    turn = f"{math.cos(half):.9f},{math.sin(half):.9f},0,0"
    numbered = "" if n is None else f"{n},"
    return f"{numbered}{5000 + 20 * k},{turn},{k},0,0\n".encode()


def test_a_device_whose_attitude_died_is_silent_though_its_rate_comes():
    """Each is a message of its own over MAVLink; 50 turns of 20 ms bring the rate alone."""
    link, wire = link_of("mavlink")
    sender, zeros = common.MAVLink(None, 1, 1), (0.0,) * 9
    for k in range(100):
        turn = (math.cos(0.01 * k), math.sin(0.01 * k), 0.0, 0.0)
        attitude = common.MAVLink_attitude_quaternion_message(20 * k, *turn, 0.0, 0.0, 0.0)
        imu = common.MAVLink_highres_imu_message(20000 * k, 0, 0, 0, k, *zeros, 0xFFF)
        wire.data = [imu.pack(sender)] + ([attitude.pack(sender)] if k < 50 else [])
        link.turn(TURN * k)
    assert link.silent == {"rate": 0.0, "attitude": pytest.approx(1.0)}


def test_a_pause_of_the_host_is_no_silence_of_the_sensor():
    """Nobody listened for ten seconds; nothing had arrived in that turn yet."""
    link, wire = link_of()
    link.driver.feed(b"\n")
    for k in range(10):
        wire.data = [row(k)]
        link.turn(TURN * k)
    link.turn(10.0)
    assert max(link.silent.values()) < 0.1


def test_rows_that_waited_while_the_host_paused_are_no_jump_of_the_clock():
    """Two seconds of rows, read in three turns after it: the times are those of the stamps."""
    link, wire = link_of()
    rows = []
    for k in range(100):
        wire.data = [row(k)]
        rows += link.turn(TURN * k + 1e-3)
    for n in range(3):
        wire.data = [row(k) for k in range(100 + 40 * n, 140 + 40 * n)]
        rows += link.turn(4.4 + 1e-3 * n)
    times = [each.t for each in rows if each.channel == "rate"]
    assert len(times) == 220
    assert max(abs(t - TURN * k - 1e-3) for k, t in enumerate(times)) < 1e-6
    assert [clock.jumps for clock in link.clocks.values()] == [0, 0]


def test_a_device_that_numbers_its_rows_anew_loses_none_after_its_port_was_opened():
    """Forty rows, then the port is opened again: the next forty bear the same numbers."""
    link, wire = link_of(columns=("n", *ROW))
    kept = []
    for k in range(80):
        wire.opened = k == 40
        wire.data = ([b"\n"] if wire.opened else []) + [row(k, n=k % 40)]
        kept += link.turn(TURN * k)
    assert len(kept) == 2 * 80
    assert link.arrivals.late == 0


def test_a_device_that_numbers_its_rows_anew_unasked_loses_none():
    link, wire = link_of(columns=("n", *ROW))
    kept = []
    for k in range(600):
        wire.data = [row(k, n=k % 300)]
        kept += link.turn(TURN * k)
    assert len(kept) == 2 * 600


def test_what_was_requested_and_not_confirmed_is_in_the_health_line():
    link, wire = link_of("vectornav", message="VNQMR")
    for k in range(100):
        wire.data = [b"garbage*\n"] if k == 50 else []
        link.turn(TURN * k)
    assert sum(map(bool, wire.sent)) == 2
    health = link.health
    assert health.wrong["unconfirmed"] == 1
    said = "VNWRG,06,8 was requested 2 times in 2.0 s and not confirmed"
    assert said in health.sentence
    assert "last received: b'garbage*\\n'" in health.sentence
    assert health.data["unconfirmed"] == 1
