"""Sensors: the manual's bytes, frames by hand, arrivals, a device's clock."""

import functools
import math
from dataclasses import replace

import numpy as np
import pytest

from equipoise.hardware.emulated.registry import SENSORS
from equipoise.hardware.links.arrival_statistics import FROZEN, Arrivals, arrived
from equipoise.hardware.links.clock_sync import DeviceClock, drift_of, learnt, to_bench
from equipoise.hardware.links.frame_transform import as_sensed, placed
from equipoise.hardware.links.sensor_link import SensorLink
from equipoise.hardware.sensors.registry import DRIVERS
from equipoise.hardware.sensors.vectornav import VectorNav, crc16
from equipoise.hardware.transport.reconnecting_port import Turn
from equipoise.maths.attitude import from_euler321, from_matrix, multiply, to_matrix
from equipoise.model.errors import InputError
from equipoise.model.reading import Reading
from equipoise.model.recording import Recording, Samples
from tests.support.sensor_units import PICTURES, pieces, unit

HALF = math.sqrt(0.5)


def line(body):
    """Return a line as the manual has it: the exclusive or of the bytes in between."""
    total = functools.reduce(lambda a, b: a ^ b, body.encode())
    return f"${body}*{total:02X}\r\n".encode()


def test_the_manuals_bytes_are_understood():
    """Quaternion vector first; the last three numbers of VNQMR are rates in rad/s."""
    driver = VectorNav(unit("vectornav"))
    body = "VNQMR,+0.500000,-0.500000,+0.500000,+0.500000,1,0,0,0,0,-9.8,+0.01,-0.02,+0.03"
    attitude, rate = driver.feed(line(body))
    assert attitude == Reading("attitude", (0.5, 0.5, -0.5, 0.5))
    assert rate == Reading("rate", (0.01, -0.02, 0.03))
    (quarter,) = driver.feed(line("VNYPR,+090.000,+000.000,+000.000"))
    assert quarter.values == pytest.approx((HALF, 0, 0, HALF))
    assert driver.counts.good == 2


def test_the_register_read_of_the_manual_has_its_checksum():
    """The manual's example of both checksums: $VNRRG,5*46 and $VNRRG,5*9A1C ... of the same body.

    The 8-bit one is checked by hand: V^N^R^R^G^,^5 = 0x46. CRC-CCITT of "123456789" begun at zero
    is 0x31C3, as every catalogue of checksums has it.
    """
    assert functools.reduce(lambda a, b: a ^ b, b"VNRRG,5") == 0x46
    assert crc16(b"123456789") == 0x31C3


def test_what_is_broken_is_counted_and_never_a_row():
    driver = VectorNav(unit("vectornav"))
    good = line("VNGYR,+0.1,+0.2,+0.3")
    bad = [
        good.replace(b"0.2", b"0.3"),  # checksum
        good[:12] + b"\r\n",  # half a line
        line("VNGYR,+0.1,+0.2"),  # a number is missing
        line("VNQTN,1,1,1,1"),  # no unit quaternion
        line("VNGYR,nan,0,0"),
        b"\x00\xff\x80*\r\n",
    ]
    for data in bad:
        assert driver.feed(data) == []
    assert driver.counts.corrupt == len(bad)
    assert driver.feed(line("VNMAG,1,2,3")) == []
    assert driver.counts.foreign == 1
    assert len(driver.feed(b"rest of a line" + good)) == 1


def test_it_requests_its_message_and_rate():
    driver = VectorNav(unit("vectornav", message="VNQMR", rate_hz=40.0))
    driver.opened()
    assert driver.due(0.0) == line("VNWRG,06,8") + line("VNWRG,07,40")
    assert driver.due(0.1) == b""
    with pytest.raises(InputError, match="VNXXX"):
        VectorNav(unit("vectornav", message="VNXXX"))
    with pytest.raises(InputError, match="rate_hz"):
        VectorNav(unit("vectornav", rate=40.0))


def test_a_device_that_was_without_power_gets_its_settings_when_it_has_some():
    """Each is sent again until the device repeats it; VNERR is no confirmation."""
    driver = VectorNav(unit("vectornav", message="VNQMR", rate_hz=40.0))
    driver.opened()
    both = line("VNWRG,06,8") + line("VNWRG,07,40")
    assert [driver.due(t) for t in (0.0, 0.5, 1.0, 2.0)] == [both, b"", both, both]
    driver.feed(line("VNWRG,6,8") + line("VNERR,03"))
    assert driver.due(3.0) == line("VNWRG,07,40")
    driver.feed(line("VNWRG,07,50"))
    assert driver.due(4.0) == line("VNWRG,07,40")
    driver.feed(line("VNWRG,07,40"))
    assert driver.due(5.0) == b""


def test_a_device_that_has_forgotten_its_message_gets_it_again():
    """It was switched off and on behind a port that stayed open: another message comes."""
    driver = VectorNav(unit("vectornav", message="VNQMR"))
    driver.due(0.0)
    driver.feed(line("VNQMR,0,0,0,1,1,0,0,0,0,-9.8,0.1,0.2,0.3"))
    assert driver.due(5.0) == b""
    driver.feed(line("VNYPR,+090.000,+000.000,+000.000"))
    assert driver.due(5.1) == line("VNWRG,06,8")
    driver.feed(line("VNYPR,+090.000,+000.000,+000.000"))
    assert driver.due(5.2) == b""


def test_text_of_a_terminal_is_of_another_kind_and_no_broken_message():
    """A message begins with $ and ends with * and its checksum; a prompt has neither."""
    driver = VectorNav(unit("vectornav"))
    assert driver.feed(b"> connected to COM3\r\n" + line("VNGYR,1,2,3")) != []
    assert (driver.counts.foreign, driver.counts.corrupt) == (1, 0)


def test_frames_by_hand():
    """A device whose axes are north-east-down, level and facing north, is our body upside down.

    Ours: x north, y west, z up. So its rate about down is ours about minus z.
    """
    level = placed(unit("vectornav"), "attitude", np.array([1.0, 0.0, 0.0, 0.0]))
    np.testing.assert_allclose(to_matrix(level), np.diag([1.0, -1.0, -1.0]), atol=1e-12)
    over = unit(
        "vectornav", alignment=np.diag([1.0, -1.0, -1.0])
    )  # mounted so that its z points down
    upright = placed(over, "attitude", np.array([1.0, 0.0, 0.0, 0.0]))
    np.testing.assert_allclose(to_matrix(upright), np.eye(3), atol=1e-12)
    assert placed(over, "rate", np.array([0.0, 0.0, 1.0])) == pytest.approx([0, 0, -1])
    # Y up, as motion capture has it: a body upright there has its y along our z.
    captured = placed(
        unit("vectornav", laboratory="y_up"), "attitude", np.array([1.0, 0.0, 0.0, 0.0])
    )
    np.testing.assert_allclose(to_matrix(captured) @ [0, 1, 0], [0, 0, 1], atol=1e-12)


@pytest.mark.parametrize("name", sorted(DRIVERS.keys() - PICTURES))  # see test_camera
@pytest.mark.parametrize("laboratory", ["z_up", "ned", "y_up"])
def test_rows_sent_by_the_remote_side_are_decoded_unchanged(name, laboratory):
    """And turning agrees: the attitude's slope is the rate, for every frame."""
    rng = np.random.default_rng(1)
    turn = to_matrix(from_euler321(0.3, -1.2, 2.0))
    device = unit(name, laboratory, turn)
    t = np.arange(8) * 0.025
    rate = np.tile(rng.normal(size=3), (8, 1))
    axis = rate[0] / np.linalg.norm(rate[0])
    half = 0.5 * np.linalg.norm(rate[0]) * t
    spin = np.column_stack([np.cos(half), np.sin(half)[:, None] * axis])
    q = multiply(from_euler321(0.2, 0.1, 1.0), spin)
    remote, driver = SENSORS[name](device), DRIVERS[name](device)
    remote.take(driver.due(0.0), 0.0)
    messages = remote.messages(Recording(Samples(t, q), Samples(t, rate)))
    rows = {"attitude": [], "rate": []}
    for message in messages:
        for piece in pieces(name, message):
            for reading in driver.feed(piece):
                rows[reading.channel].append(
                    placed(device, reading.channel, np.array(reading.values))
                )
    np.testing.assert_allclose(to_matrix(np.array(rows["attitude"])), to_matrix(q), atol=1e-6)
    if "rate" in device.gives:
        np.testing.assert_allclose(rows["rate"], rate, atol=1e-6)
    back = as_sensed(device, "rate", placed(device, "rate", rate))
    np.testing.assert_allclose(back, rate, atol=1e-12)


def test_a_matrix_and_its_quaternion_agree():
    for turn in (np.diag([1.0, -1.0, -1.0]), to_matrix(from_euler321(0.1, 0.2, 0.3))):
        np.testing.assert_allclose(to_matrix(from_matrix(turn)), turn, atol=1e-12)


def test_rows_that_come_twice_late_or_frozen_are_not_kept():
    arrivals, kept = Arrivals(), []
    for number, value, t in [(1, 0.1, 0.0), (2, 0.2, 0.1), (2, 0.2, 0.2), (1, 0.1, 0.3),
                             (5, 0.3, 0.4)]:  # fmt: skip
        arrivals, keep = arrived(arrivals, Reading("rate", (value, 0.0, 0.0), number=number), t)
        kept.append(keep)
    assert kept == [True, True, False, False, True]
    assert (arrivals.duplicate, arrivals.late, arrivals.missing) == (1, 1, 2)
    for k in range(20):
        arrivals, keep = arrived(arrivals, Reading("rate", (9.0, 0.0, 0.0)), 1.0 + 0.05 * k)
        assert keep is (0.05 * k <= FROZEN + 1e-9)


def clock_after(drift, offset, seconds, seed=0):
    """Return a clock that has received 50 rows a second, 5 ms late on average."""
    rng = np.random.default_rng(seed)
    clock = DeviceClock()
    for stamp in np.arange(0.0, seconds, 0.02):
        arrival = offset + (1 + drift) * stamp + rng.exponential(5e-3)
        clock = learnt(clock, float(stamp), float(arrival))
    return clock


@pytest.mark.parametrize("seed", range(5))
def test_offset_and_drift_are_found_below_delays(seed):
    """The least of 250 delays of 5 ms on average is 0.02 ms: that, and little more, is left."""
    clock = clock_after(50e-6, 12.0, 120.0, seed)
    assert drift_of(clock) == pytest.approx(50e-6, abs=3e-6)
    for stamp in (60.0, 119.0):
        assert to_bench(clock, stamp) == pytest.approx(12.0 + (1 + 50e-6) * stamp, abs=2e-4)


def test_a_clock_that_jumps_is_begun_anew():
    clock = learnt(clock_after(0.0, 12.0, 20.0), 1000.0, 32.0)
    assert clock.jumps == 1
    assert to_bench(clock, 1000.5) == pytest.approx(32.5)
    assert learnt(clock, 3.0, 33.0).jumps == 2


@pytest.mark.parametrize("jump", [-0.3, 0.3, 2.0])
def test_a_small_jump_of_the_clock_costs_no_time(jump):
    """Stamps are ahead or behind by so much from then on; rows are stamped near their arrival."""
    clock, rng = clock_after(0.0, 12.0, 20.0), np.random.default_rng(1)
    for stamp in np.arange(20.0, 40.0, 0.02):
        arrival = 12.0 + stamp + rng.exponential(5e-3)
        clock = learnt(clock, float(stamp) + jump, float(arrival))
        assert to_bench(clock, float(stamp) + jump) == pytest.approx(12.0 + stamp, abs=0.04)
    assert clock.jumps == 1


def test_the_first_row_may_have_waited_in_the_port():
    clock = DeviceClock()
    for k in range(500):
        clock = learnt(clock, 0.02 * k, 5.0 + 0.02 * k + (0.2 if k == 0 else 0.001))
    assert clock.jumps == 0
    assert to_bench(clock, 8.0) == pytest.approx(13.001, abs=1e-6)


def test_a_clock_remembers_no_more_than_two_minutes():
    assert len(clock_after(0.0, 0.0, 400.0).quickest) == 24


class Handed:
    """A port that hands on what a test puts in, turn by turn."""

    def __init__(self, turns):
        self.turns = list(turns)

    why = ""

    def turn(self, _t):
        return Turn(tuple(self.turns.pop(0)), opened=False)

    def send(self, data, _t):
        return Turn()


def times_of(turns, at, periods, **settings):
    """Return the times of the rates that a sensor's lines gave, turn by turn, and its link."""
    driver = "lines" if settings else "vectornav"
    device = replace(unit(driver, **settings), gives=("rate",))
    link = SensorLink(device, DRIVERS[driver](device), Handed(turns), periods)
    link.driver.feed(b"\n")
    return [row.t for t in at for row in link.turn(t)], link


def test_unstamped_rows_that_arrive_at_once_are_spaced_by_a_period():
    """A computer that paused reads three messages of 25 ms in one turn: none is lost.

    The last was taken now, the others 25 and 50 ms before; never before the row that was last.
    """
    turns = [
        [line(f"VNGYR,{k},0,{n}") for n in range(count)] for k, count in enumerate([1, 3, 1, 4])
    ]
    times, link = times_of(turns, [1.0, 1.1, 1.125, 1.145], {"rate": 0.025})
    assert times == pytest.approx(
        [1.0, 1.05, 1.075, 1.1, 1.125, 1.13, 1.135, 1.14, 1.145], abs=1e-9
    )
    assert link.arrivals.kept == 9


def test_rows_that_come_at_once_and_bear_their_time_keep_it():
    """All of them teach the clock first: the quickest, here the last, dates the others."""
    columns = ("t_ms", "gx_rad_s", "gy_rad_s", "gz_rad_s")
    turns = [[b"%d,%d,1,2\n" % (ms, ms) for ms in range(first, first + 100, 20)]
             for first in (5000, 5100, 5200)]  # fmt: skip
    times, link = times_of(turns, [1.1, 1.2, 1.3], {"rate": 0.02}, columns=columns)
    assert times == pytest.approx(1.02 + 0.02 * np.arange(15), abs=1e-9)
    assert link.arrivals.late == 0
