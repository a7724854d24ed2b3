"""A serial line carries one byte after the other, ten bits each."""

from dataclasses import replace

import pytest

from equipoise.app.bench.emulation import emulate
from equipoise.hardware.emulated.registry import FIRMWARES, emulated_board
from equipoise.hardware.emulated.serial_line import SerialLine
from equipoise.io.testbed.presets import read_preset
from tests.support.board_wire import BED, board_of


def test_bytes_arrive_one_after_the_other():
    """At 9600 baud a byte takes 10 / 9600 s, 1.04 ms; what is put behind waits for the wire."""
    line = SerialLine(9600)
    line.put(b"abc", 1.0)
    line.put(b"d", 1.001)
    assert line.arrived(1.001) == []
    times, found = zip(*line.arrived(2.0), strict=True)
    assert b"".join(found) == b"abcd"
    assert times == pytest.approx([1.0 + k * 10 / 9600 for k in (1, 2, 3, 4)])


@pytest.mark.parametrize("kind", sorted(FIRMWARES))
def test_no_board_answers_sooner_than_its_line_lets_it(kind):
    """A question and its answer, byte by byte: at 1200 baud Grbl's settings take five seconds."""
    question = {"grbl": b"$$\n", "tmcl": bytes.fromhex("018801000000000 08a".replace(" ", ""))}[
        kind
    ]
    board = board_of(kind)
    slow = emulated_board(replace(board, port=replace(board.port, baud=1200)), BED.masses)
    t, said = 30.0, b""
    slow.run(t)
    slow.take(question, t)
    answer = 0
    while t < 45.0:
        t += 0.01
        more, _ = slow.run(t)
        said += more
        answer = t if more else answer
    assert len(said) >= 9
    assert answer - 30.0 == pytest.approx((len(question) + len(said)) * 10 / 1200, abs=0.2)


def test_a_sensor_on_a_serial_line_is_as_slow_as_that():
    """110 bytes of a row take 0.92 s at 1200 baud; 40 rows a second would need 44 000 baud."""
    bed = read_preset("nanosat")
    (imu,) = bed.hardware.sensors
    imu = replace(imu, port=replace(imu.port, baud=1200))
    bench = emulate(replace(bed, hardware=replace(bed.hardware, sensors=(imu,))), 1)
    try:
        (station,) = bench.sensors
        sent = []
        station.wire.send, send = sent.append, station.wire.send
        for k in range(1, 101):
            bench.run(0.02 * k)
        station.wire.send = send
    finally:
        bench.close()
    assert len(b"".join(sent)) == pytest.approx(2.0 * 1200 / 10, abs=5)
