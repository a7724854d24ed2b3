"""`equipoise convert --as`: what a driver reads in saved bytes is what went over the wire."""

import functools
import math

import numpy as np
import pytest
from pymavlink.dialects.v20 import common

from equipoise.hardware.emulated.registry import SENSORS
from equipoise.hardware.sensors.registry import DRIVERS
from equipoise.io.recording.recording_file import read_recording
from equipoise.io.testbed.presets import preset_text
from equipoise.maths.attitude import to_matrix
from equipoise.model.recording import Recording, Samples
from tests.support.byte_captures import datagram_packet, pcap, pcapng, telemetry
from tests.support.sensor_units import NEEDS, PICTURES, ROW, unit

STEP, COUNT = 0.02, 120  # s; rows
UTC = 1_700_000_000.0  # s, when a capture begins
SAVED = sorted(DRIVERS.keys() - PICTURES - {"rosbridge"})
LABORATORY = {"vectornav": "ned", "mavlink": "ned", "natnet": "y_up", "lines": "z_up"}
OPTIONS = {
    "vectornav": ("--rate-hz", 1 / STEP),
    "mavlink": (),
    "natnet": ("--body", "1"),
    "lines": ("--columns", ",".join(ROW)),
}


def motion(channels=("attitude", "rate")):
    """Return rows that turn about an axis that leans, 50 a second."""
    t = STEP * np.arange(COUNT)
    axis = np.array([0.6, 0.0, 0.8])
    q = np.column_stack([np.cos(0.3 * t), np.sin(0.3 * t)[:, None] * axis])
    parts = {"attitude": Samples(t, q), "rate": Samples(t, np.outer(0.6 + 0.1 * t, axis))}
    return Recording(**{name: parts[name] for name in channels})


def messages(driver, rows):
    """Return what the emulated counterpart sends for the rows, message by message."""
    return SENSORS[driver](unit(driver, LABORATORY[driver])).messages(rows)


def check_rows(found, rows, start=0, tolerance=1e-6):
    """Compare attitude and rate in value and number, and times from the first row on."""
    assert (found.rate is None) == (rows.rate is None)
    for one, other in ((found.attitude, rows.attitude), (found.rate, rows.rate)):
        if one is not None:
            assert len(one) == COUNT - start
            np.testing.assert_allclose(
                one.t - one.t[0], other.t[start:] - other.t[start], atol=tolerance
            )
    turns = to_matrix(found.attitude.values)
    np.testing.assert_allclose(turns, to_matrix(rows.attitude.values[start:]), atol=1e-6)
    if rows.rate is not None:
        np.testing.assert_allclose(found.rate.values, rows.rate.values[start:], atol=1e-6)


@pytest.mark.parametrize("driver", SAVED)
def test_saved_bytes_convert_into_the_rows_that_went_in(equipoise, tmp_path, driver):
    """As a stream; a log of lines begins with a remark, since its first line is void."""
    rows = motion(NEEDS[driver][1])
    content = b"".join(messages(driver, rows))
    (tmp_path / "log.bin").write_bytes(b"# log\r\n" * (driver == "lines") + content)
    done = equipoise("convert", "log.bin", "rows.csv", "--as", driver, *OPTIONS[driver])
    assert done.code == 0, done.err
    assert f"{len(messages(driver, rows))} messages" in done.out
    check_rows(read_recording("rows.csv"), rows)


def test_every_driver_of_bytes_can_be_replayed(equipoise, tmp_path):
    (tmp_path / "log.bin").write_bytes(b"x\n")
    reported = equipoise("convert", "log.bin", "rows.csv", "--as", "rosbridge")
    assert (reported.code, "one of " in reported.err) == (2, True)
    assert all(name in reported.err for name in SAVED)


@pytest.mark.parametrize("form", [pcap, pcapng])
def test_network_traffic_gives_the_datagrams_of_motives_port(equipoise, tmp_path, form):
    """A packet of another port, one that is no UDP, and one in fragments are beside them."""
    rows = motion(("attitude",))
    packets = [
        (UTC + STEP * k + 1e-3 * (k % 3), datagram_packet(frame, 1511))
        for k, frame in enumerate(messages("natnet", rows))
    ]
    fragment = bytearray(datagram_packet(b"part", 9999))
    fragment[21] = 4  # it begins at byte 32 of the datagram, so these are no ports
    packets.insert(9, (UTC + 0.17, datagram_packet(b"query", 53)))
    packets.insert(20, (UTC + 0.37, bytes(12) + b"\x08\x06" + bytes(28)))
    packets.insert(30, (UTC + 0.55, bytes(fragment)))
    (tmp_path / "motive.pcap").write_bytes(form(packets))
    done = equipoise("convert", "motive.pcap", "rows.csv", "--as", "natnet", "--body", 1)
    assert done.code == 0, done.err
    assert "1 broken" in done.out
    assert "1 datagram of other ports (53)" in done.out
    check_rows(read_recording("rows.csv"), rows)


def test_a_capture_that_was_cut_gives_what_is_whole(equipoise, tmp_path):
    frames = messages("natnet", motion(("attitude",)))
    packets = [(UTC + STEP * k, datagram_packet(each, 1511)) for k, each in enumerate(frames)]
    (tmp_path / "cut.pcap").write_bytes(pcap(packets)[:-5])
    done = equipoise("convert", "cut.pcap", "rows.csv", "--as", "natnet", "--body", 1)
    assert "1 broken" in done.out
    assert len(read_recording("rows.csv").attitude) == COUNT - 1


def line(body):
    """Return a message as the manual has it: the exclusive or of the bytes in between."""
    total = functools.reduce(lambda a, b: a ^ b, body.encode())
    return f"${body}*{total:02X}\r\n".encode()


def rate_line(k):
    return line(f"VNGYR,+{0.01 * k:.6f},+0.000000,+0.100000")


def test_a_terminals_log_of_a_vectornav_by_hand(equipoise, tmp_path):
    """It begins and ends within a message; a prompt, an echo and a broken line are between.

    The broken one was a message, so it leaves its place: rows at 40 Hz stand at 0, 25, 75 ms.
    """
    broken = rate_line(2).replace(b"0.1", b"0.9")
    content = (
        rate_line(9)[12:] + b"> VNWRG,06,12\r\n" + line("VNWRG,06,12") + rate_line(0)
        + rate_line(1) + broken + rate_line(3) + b"connection closed\r\n" + rate_line(4)
        + rate_line(5)[:9]
    )  # fmt: skip
    (tmp_path / "putty.log").write_bytes(content)
    done = equipoise("convert", "putty.log", "rows.csv", "--as", "vectornav", "--rate-hz", 40)
    assert done.code == 0, done.err
    assert "4 messages, 3 of other kinds, 4 rows; 1 broken" in done.out
    assert "the last line is ignored" in done.out
    assert "spaced at 40 Hz" in done.out
    found = read_recording("rows.csv").rate
    np.testing.assert_allclose(found.t, [0, 0.025, 0.075, 0.1], atol=1e-9)
    np.testing.assert_allclose(found.values[:, 0], [0, 0.01, 0.03, 0.04], atol=1e-12)


def test_rows_without_any_time_need_a_rate(equipoise, tmp_path):
    (tmp_path / "putty.log").write_bytes(rate_line(0) + rate_line(1))
    reported = equipoise("convert", "putty.log", "rows.csv", "--as", "vectornav")
    assert reported.code == 2
    assert "without times; wanted --rate-hz" in reported.err
    assert not (tmp_path / "rows.csv").exists()


def attitude(boot, angle):
    turn = (math.cos(angle / 2), math.sin(angle / 2), 0.0, 0.0)
    message = common.MAVLink_attitude_quaternion_message(boot, *turn, 0.1, 0.0, 0.0)
    return message.pack(common.MAVLink(None, 1, 1))


def test_a_telemetry_log_by_hand(equipoise, tmp_path):
    """Frames came 3 to 7 ms late; a garbled part between, and a cut one at the end, are broken.

    Rows stand by the vehicle's clock, which says 20 ms each.
    """
    late = [0.003, 0.007, 0.005]
    frames = [(UTC + 0.02 * k + late[k % 3], attitude(5000 + 20 * k, 0.01 * k)) for k in range(60)]
    content = telemetry(frames[:30]) + b"\xfd\x1c garbled \0\0" + telemetry(frames[30:])[:-4]
    (tmp_path / "flight.tlog").write_bytes(content)
    done = equipoise("convert", "flight.tlog", "rows.csv", "--as", "mavlink")
    assert done.code == 0, done.err
    assert "59 messages, 59 rows; 2 broken" in done.out
    found = read_recording("rows.csv").attitude
    np.testing.assert_allclose(np.diff(found.t), 0.02, atol=1e-6)  # a double since 1970
    turns = to_matrix(found.values)  # north-east-down to ours: half a turn about x before it
    angles = np.arctan2(turns[:, 2, 1], turns[:, 1, 1])
    np.testing.assert_allclose(np.unwrap(angles) - angles[0], 0.01 * np.arange(59), atol=1e-6)


def test_a_devices_clock_that_begins_anew_goes_on_after_the_row_before(equipoise, tmp_path):
    """Stamps of 1 s to 1.18 s, then from 0 s again: a row every 20 ms, and it is said."""
    stamps = [*range(1000, 1200, 20), *range(0, 200, 20)]
    content = b"t_ms,gx,gy,gz\n"
    content += b"".join(b"%d,%d,0.5,0\n" % (ms, k) for k, ms in enumerate(stamps))
    (tmp_path / "log.txt").write_bytes(content)
    columns = "t_ms,gx_deg_s,gy_deg_s,gz_deg_s"
    done = equipoise("convert", "log.txt", "rows.csv", "--as", "lines", "--columns", columns)
    assert "1 jump of the device's clock" in done.out
    found = read_recording("rows.csv").rate
    np.testing.assert_allclose(found.t, 0.02 * np.arange(20), atol=1e-9)
    np.testing.assert_allclose(np.degrees(found.values[:, 0]), np.arange(20), atol=1e-9)


def test_missing_numbers_leave_their_places(equipoise, tmp_path):
    content = b"\n" + b"".join(b"%d;%d;0.5;0\n" % (n, n) for n in (7, 8, 11, 12))
    (tmp_path / "log.txt").write_bytes(content)
    done = equipoise(
        "convert", "log.txt", "rows.csv", "--as", "lines", "--rate-hz", 50,
        "--columns", "n,gx_rad_s,gy_rad_s,gz_rad_s",
    )  # fmt: skip
    assert "2 missing" in done.out
    found = read_recording("rows.csv").rate
    np.testing.assert_allclose(found.t, [0, 0.02, 0.08, 0.1], atol=1e-9)


def test_objects_and_a_part_of_the_rows(equipoise, tmp_path):
    """JSON; of 100 rows, 10 ms apart, those from 0.495 s on."""
    content = b"\n" + b"".join(
        b'{"t_us": %d, "w": {"gx_rad_s": %d, "gy_rad_s": 1, "gz_rad_s": 0}}\n' % (10_000 * k, k)
        for k in range(1, 101)
    )
    (tmp_path / "log.txt").write_bytes(content)
    done = equipoise(
        "convert", "log.txt", "rows.mcap", "--as", "lines", "--format", "json",
        "--columns", "t_us w.gx_rad_s w.gy_rad_s w.gz_rad_s", "--from-s", 0.495,
    )  # fmt: skip
    assert done.code == 0, done.err
    assert len(read_recording("rows.mcap").rate) == 50


def test_a_testbed_gives_alignment_and_laboratory(equipoise, tmp_path):
    """The preset's IMU is a VectorNav; options go before what the testbed says."""
    bed = preset_text("nanosat")
    assert 'driver = "vectornav"' in bed
    (tmp_path / "bed.toml").write_text(bed)
    (tmp_path / "putty.log").write_bytes(b"".join(map(rate_line, range(4))))
    words = ("convert", "putty.log", "rows.csv", "--as", "vectornav", "--rate-hz", 40)
    assert equipoise(*words, "--testbed", "bed.toml").code == 0
    turned = read_recording("rows.csv").rate.values
    assert equipoise(*words).code == 0
    as_sensed = read_recording("rows.csv").rate.values
    from equipoise.io.testbed.testbed_file import read_testbed

    (imu,) = read_testbed("bed.toml").hardware.sensors
    np.testing.assert_allclose(turned, as_sensed @ imu.alignment.T, atol=1e-12)
    reported = equipoise(
        "convert", "putty.log", "rows.csv", "--as", "mavlink", "--testbed", "bed.toml"
    )
    assert 'none; wanted one [[hardware.sensor]] with driver = "mavlink"' in reported.err


@pytest.mark.parametrize(
    ("content", "words", "said"),
    [
        (b"Windows PowerShell\r\nPS C:\\> ", ("vectornav",), "it begins b'Windows PowerShell"),
        (b"", ("mavlink",), "an empty file"),
        (rate_line(0), ("natnet", "--body", "1"), "no row; sensor natnet: 0 messages"),
        (pcap([(UTC, datagram_packet(b"query", 53))]), ("natnet", "--body", "1"),
         "1 datagram of other ports (53)"),
        (b"1,2,3\n", ("lines",), "columns"),
        (b"1,2,3\n", ("lines", "--columns", "t_ms,gx_rad_s"), "without"),
        (b"1\n", ("vectornav", "--laboratory", "nde"), "did you mean 'ned'"),
        (b"1\n", ("vectornav", "--rate-hz", "0"), "--rate-hz"),
        (b"1\n", ("natnet",), "streaming id"),
    ],
)  # fmt: skip
def test_what_cannot_be_read_is_said(equipoise, tmp_path, content, words, said):
    (tmp_path / "log.bin").write_bytes(content)
    reported = equipoise("convert", "log.bin", "rows.csv", "--as", *words)
    assert (reported.code, said in reported.err) == (2, True), reported.err
    assert not (tmp_path / "rows.csv").exists()


def test_options_of_a_sensor_need_its_driver(equipoise, tmp_path):
    (tmp_path / "log.bin").write_bytes(b"1\n")
    reported = equipoise("convert", "log.bin", "rows.csv", "--laboratory", "ned")
    assert (reported.code, "--as: found nothing" in reported.err) == (2, True)
    assert "no such file" in equipoise("convert", "none", "rows.csv", "--as", "mavlink").err
