"""Lines of a microcontroller: rows by hand, what is no row, declarations that cannot be."""

import math

import numpy as np
import pytest

from equipoise.hardware.emulated.line_protocol import EmulatedLineProtocol
from equipoise.hardware.sensors.line_protocol import LineProtocol
from equipoise.maths.attitude import from_euler321
from equipoise.model.errors import InputError
from equipoise.model.hardware import Port, SensorUnit
from equipoise.model.recording import Recording, Samples
from tests.support.sensor_units import ROW, unit

HALF = math.sqrt(0.5)


def over(address, **settings):
    port = Port(address)
    return SensorUnit("esp", "lines", port, ("attitude", "rate"), np.eye(3), "z_up", settings)


def test_a_row_of_csv_by_hand():
    """180 deg/s is pi rad/s; 12345 ms are 12.345 s; turns of 90 deg about z are (r, 0, 0, r)."""
    driver = LineProtocol(unit("lines"))
    attitude, rate = driver.feed(b"12345,0.7071,0,0,0.7071,180,-90.0,0\r\n")
    assert attitude.values == pytest.approx((HALF, 0, 0, HALF))
    assert rate.values == pytest.approx((math.pi, -math.pi / 2, 0))
    assert attitude.stamp == rate.stamp == pytest.approx(12.345)
    assert attitude.number is None
    assert driver.counts.good == 1


@pytest.mark.parametrize("parted", [b",", b";", b"\t", b" ", b" , "])
def test_rows_are_parted_as_sketches_do_it(parted):
    """Yaw 90 deg alone; a column that is skipped may hold anything, the row's number counts."""
    columns = ("-", "n", "t_us", "yaw_deg", "pitch_deg", "roll_deg")
    row = (b"IMU", b"7", b"2500000", b"90", b"0", b"0")
    fitting = SensorUnit("a", "lines", Port("serial:X"), ("attitude",), np.eye(3),
                         settings={"columns": columns})  # fmt: skip
    (reading,) = LineProtocol(fitting).feed(parted.join(row) + b"\n")
    assert reading.values == pytest.approx((HALF, 0, 0, HALF))
    assert (reading.number, reading.stamp) == (7, 2.5)


def test_an_object_of_json_by_hand():
    """Keys within keys by dots, under their own name or another."""
    columns = ("t_s", "imu.qw", "imu.qx", "imu.qy", "qz=imu.last", "gx_rad_s=w.x", "gy_rad_s=w.y",
               "gz_rad_s=w.z")  # fmt: skip
    driver = LineProtocol(unit("lines", format="json", columns=columns))
    line = (b'{"t_s": 1.5, "imu": {"qw": 0.5, "qx": 0.5, "qy": -0.5, "last": 0.5}, '
            b'"w": {"x": 1, "y": 2, "z": -3}}\n')  # fmt: skip
    attitude, rate = driver.feed(line)
    assert attitude.values == (0.5, 0.5, -0.5, 0.5)
    assert rate.values == (1.0, 2.0, -3.0)
    assert attitude.stamp == 1.5
    assert driver.feed(b'{"status": "calibrating"}\n[1, 2]\n') == []
    assert (driver.counts.foreign, driver.counts.corrupt) == (2, 0)
    bad = [line.replace(b"1.5", b"true"), line.replace(b"1.5", b"1e999"), line[:-3] + b"\n",
           line.replace(b'"qw": 0.5,', b""), b"[" * 1020 + b"\n",
           line.replace(b"1.5", b"9" * 400)]  # fmt: skip
    for each in bad:
        assert driver.feed(each) == []
    assert driver.counts.corrupt == len(bad)


def test_what_is_no_row_is_counted():
    driver = LineProtocol(unit("lines"))
    good = b"1,1,0,0,0,0,0,0\n"
    bad_rows = [b"1,1,0,0,0,0,0\n", b"1,1,0,0,0,0,0,x\n", b"1,1,1,0,0,0,0,0\n",
                b"1,nan,0,0,0,0,0,0\n", b"1,1,0,,0,0,0,0\n"]  # fmt: skip
    for bad in bad_rows:
        assert driver.feed(bad) == []
    assert driver.counts.corrupt == len(bad_rows)
    assert driver.feed(b"1," * 600) == []
    assert driver.counts.corrupt == len(bad_rows) + 1
    assert driver.feed(b"BNO055 ready\n# t, q\n") == []
    assert driver.counts.foreign == 2
    assert len(driver.feed(good)) == 2


def test_a_line_whose_beginning_was_missed_is_no_row():
    """After opening "345,..." may have been "12345,...": nothing in it shows which."""
    driver = LineProtocol(unit("lines", columns=ROW, send="start"))
    driver.opened()
    assert driver.due(0.0) == b"start\n"
    assert driver.due(0.1) == b""
    assert driver.feed(b"345,1,0,0,") == []
    assert driver.feed(b"0,0,0,0\r\n") == []
    assert len(driver.feed(b"12365,1,0,0,0,0,0,0\r\n")) == 2
    assert driver.counts.corrupt == 0


def test_a_line_is_sent_until_there_is_a_row():
    """A board that restarts when its port is opened does not receive what is sent at once."""
    driver = LineProtocol(unit("lines", columns=ROW, send="start"))
    driver.opened()
    assert [driver.due(t) for t in (0.0, 0.9, 1.0)] == [b"start\n", b"", b"start\n"]
    driver.feed(b"BNO055 ready\n12365,1,0,0,0,0,0\n")
    assert driver.due(2.0) == b"start\n"
    driver.feed(b"12365,1,0,0,0,0,0,0\n")
    assert driver.due(3.0) == b""


@pytest.mark.parametrize("address", ["udp:5005", "ws://esp32/imu"])
def test_a_datagram_is_a_whole_line_with_an_end_or_without(address):
    driver = LineProtocol(over(address, columns=ROW))
    driver.opened()
    assert len(driver.feed(b"1,1,0,0,0,0,0,0")) == 2
    assert len(driver.feed(b"2,1,0,0,0,0,0,0\n")) == 2


@pytest.mark.parametrize(
    ("settings", "said"),
    [
        ({"columns": ("qw", "qx", "qy", "qk")}, "column 'qk'.*one of|column 'qk'.*did you mean"),
        ({"columns": ("qw", "qx", "qy")}, "'qw' without 'qz'"),
        ({"columns": (*ROW, "qw")}, "'qw' twice"),
        ({"columns": (*ROW, "t_s")}, "two columns of time: t_ms and t_s"),
        ({"columns": (*ROW, "yaw_deg", "pitch_deg", "roll_deg")}, "two columns of attitude"),
        ({"columns": ROW[:5]}, "gives: found 'rate'; wanted columns for it"),
        ({"columns": "qw"}, "a list"),
        ({"column": ROW}, "did you mean 'columns'"),
        ({"columns": ROW, "format": "xml"}, "one of csv, json"),
        ({"columns": ROW, "send": 3.0}, "a text"),
        ({"columns": (*ROW[:-1], "gz_deg_s=w.z")}, 'format = "json"'),
        ({"columns": ("gx_rad_s", "gy_deg_s", "gz_rad_s")}, "without"),
    ],
)
def test_a_declaration_that_cannot_be_is_named(settings, said):
    with pytest.raises(InputError, match=said):
        LineProtocol(over("serial:X", **settings))


def test_what_the_remote_side_prints_in_any_columns_comes_back():
    """Angles and JSON too: 0.3 deg/s is not the number that stands in rad/s."""
    t = np.array([0.0, 0.02])
    q = from_euler321(np.array([0.1, 0.2]), np.array([-0.3, 0.3]), np.array([1.0, 2.0]))
    w = np.array([[0.1, 0.2, 0.3], [-0.1, 0.0, 0.4]])
    angles = ("yaw_deg=a.yaw", "a.pitch_deg", "a.roll_deg")
    device = over("serial:X", format="json",
                  columns=("n", "t_s", *angles, "gx_rad_s", "gy_rad_s", "gz_rad_s"))  # fmt: skip
    driver = LineProtocol(device)
    lines = EmulatedLineProtocol(device).messages(Recording(Samples(t, q), Samples(t, w)))
    found = [reading for line in lines for reading in driver.feed(line)]
    np.testing.assert_allclose([r.values for r in found if r.channel == "attitude"], q, atol=1e-9)
    np.testing.assert_allclose([r.values for r in found if r.channel == "rate"], w, atol=1e-9)
    assert [r.number for r in found] == [1, 1, 2, 2]
    assert found[2].stamp - found[0].stamp == pytest.approx(0.02)
