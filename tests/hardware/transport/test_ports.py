"""Ports and their emulated counterparts: what is sent arrives, what is gone is reported."""

import os
import subprocess
import sys
import time

import pytest

from equipoise.hardware.bench import port_lock
from equipoise.hardware.bench.open_port import open_port
from equipoise.hardware.bench.port_lock import BenchTaken, commanding
from equipoise.hardware.emulated.counterpart import TcpCounterpart, counterpart
from equipoise.hardware.transport.port import PortLost
from equipoise.hardware.transport.reconnecting_port import AGAIN, Connection
from equipoise.model.errors import InputError
from equipoise.model.hardware import Port

KINDS = [
    "serial:/dev/ttyUSB0",
    "tcp:host:23",
    "http://host/stream",
    "udp:14550",
    "udpout:host:1510",
]


def wait_for(take, wanted=bytes):
    """Return what ``take`` gives within two seconds."""
    found, end = b"", time.monotonic() + 2
    while time.monotonic() < end:
        found += take()
        if found and wanted(found):
            break
        time.sleep(1e-3)
    return found


@pytest.fixture(params=KINDS)
def wire(request):
    remote = counterpart(Port(request.param))
    near = open_port(Port(remote.address))
    yield near, remote
    near.close()
    remote.close()


def near_speaks_first(remote):
    return remote.address.startswith("udpout:")


def test_bytes_arrive_unchanged_both_ways(wire):
    """All 256 values: a terminal that turned returns into line feeds would fail."""
    near, remote = wire
    message = bytes(range(256))
    if near_speaks_first(remote):
        near.send(b"hello")
        assert wait_for(remote.receive) == b"hello"
    remote.receive()  # takes the connection
    remote.send(message)
    assert wait_for(lambda: b"".join(near.receive()), lambda d: len(d) == 256) == message
    near.send(message[::-1])
    assert wait_for(remote.receive, lambda d: len(d) == 256) == message[::-1]


def test_receiving_returns_when_nothing_came(wire):
    near, _ = wire
    assert near.receive() == []


@pytest.mark.parametrize("kind", KINDS[:2])
def test_a_port_that_is_pulled_out_is_lost(kind):
    remote = counterpart(Port(kind))
    near = open_port(Port(remote.address))
    remote.receive()
    remote.close()
    with pytest.raises(PortLost):
        wait_for(lambda: b"".join(near.receive()))
    near.close()


def test_an_unreachable_port_is_reported_with_its_address():
    with pytest.raises(PortLost, match=r"tcp:127\.0\.0\.1:1: "):
        open_port(Port("tcp:127.0.0.1:1"))
    with pytest.raises(PortLost, match="no-such-port"):
        open_port(Port("serial:/dev/no-such-port"))
    with pytest.raises(InputError, match="serial"):
        open_port(Port("pigeon:3"))


def test_a_connection_comes_back_when_the_device_does():
    remote = counterpart(Port("tcp:host:23"))
    line = Connection(Port(remote.address), open_port)
    assert line.turn(0.0).opened
    remote.receive()
    number = int(remote.address.rpartition(":")[2])
    remote.close()
    t, lost = 0.0, ""
    while not lost and t < 2:
        t, lost = t + 0.01, line.turn(t).lost
        time.sleep(1e-3)
    assert lost
    assert not line.turn(t + AGAIN + 0.01).opened
    assert line.why
    again = TcpCounterpart(number=number)
    assert line.turn(t + 2 * AGAIN + 0.1).opened
    assert line.why == ""
    line.close()
    again.close()


HOLD = """
import sys
from equipoise.hardware.bench.port_lock import commanding
with commanding(["tcp:here:1", "serial:COM9"]):
    print("held", flush=True)
    sys.stdin.read()
"""


def test_a_lock_that_cannot_be_made_is_a_sentence(monkeypatch):
    def full():
        raise FileNotFoundError(2, "No usable temporary directory found")

    monkeypatch.setattr(port_lock.tempfile, "gettempdir", full)
    wanted = "serial:COM7: found no lock of its port .* wanted a folder for temporary files"
    with pytest.raises(InputError, match=wanted), commanding(["serial:COM7"]):
        pass


def test_one_commander_at_a_time_and_a_killed_one_leaves_nothing_behind():
    with subprocess.Popen(
        [sys.executable, "-c", HOLD], stdin=subprocess.PIPE, stdout=subprocess.PIPE
    ) as other:
        assert other.stdout.readline() == b"held\n"
        taken = f"serial:COM9 is commanded by process {other.pid}"
        with pytest.raises(BenchTaken, match=taken), commanding(["serial:COM9"]):
            pass
        with commanding(["serial:COM8"]):
            pass
        other.kill()
    with commanding(["serial:COM9"]):
        assert os.getpid()
