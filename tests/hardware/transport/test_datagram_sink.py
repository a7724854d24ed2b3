"""Datagrams go out at once, or are lost: nobody waits, and nothing fails."""

import socket

from equipoise.hardware.bench.open_port import open_port
from equipoise.hardware.transport.datagram_sink import DatagramSink
from equipoise.hardware.transport.port import PortLost
from equipoise.model.hardware import Port


class FullPort:
    """A port that takes every second datagram."""

    def __init__(self):
        self.tries = 0

    def send(self, _data):
        self.tries += 1
        if self.tries % 2:
            raise PortLost("udpout:127.0.0.1:9", "Resource temporarily unavailable")

    def close(self):
        self.tries = -1


def test_datagrams_arrive_whole_and_in_order():
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as receiver:
        receiver.bind(("127.0.0.1", 0))
        receiver.settimeout(5.0)
        with DatagramSink(open_port(Port(f"udpout:127.0.0.1:{receiver.getsockname()[1]}"))) as sink:
            for k in range(20):
                sink.send(bytes([k]) * 168)
        assert [receiver.recv(4096) for _ in range(20)] == [bytes([k]) * 168 for k in range(20)]
    assert (sink.sent, sink.lost) == (20, 0)


def test_where_nobody_listens_nothing_fails():
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as taken:
        taken.bind(("127.0.0.1", 0))
        address = f"udpout:127.0.0.1:{taken.getsockname()[1]}"
    with DatagramSink(open_port(Port(address))) as sink:
        for _ in range(5):
            sink.send(b"nobody")
    assert (sink.sent, sink.lost) == (5, 0)


def test_what_a_port_cannot_take_is_counted_and_forgotten():
    port = FullPort()
    with DatagramSink(port) as sink:
        for _ in range(10):
            sink.send(b"too much")
    assert (sink.sent, sink.lost) == (5, 5)
    assert port.tries == -1
