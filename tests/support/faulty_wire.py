"""A wire that does what wires do: silence, garbage, half of what was sent, the same again."""

import numpy as np

from equipoise.hardware.emulated.camera import part
from equipoise.hardware.emulated.counterpart import TcpCounterpart


class FaultyWire:
    """Stands between an emulated device and its port; ``spoil`` is put in by a test."""

    def __init__(self, wire, seed=0):
        self._wire, self._rng = wire, np.random.default_rng(seed)
        self.address = wire.address
        self.spoil = None
        self.deaf = False  # what is sent to the device does not arrive
        self.last = b""
        self.sent = 0  # messages

    def receive(self):
        data = b"" if self._wire is None else self._wire.receive()
        return b"" if self.deaf else data

    def unplug(self):
        self._wire.close()
        self._wire = None

    def plug_in(self):
        """Put it back where it was: behind the same port of TCP."""
        self._wire = TcpCounterpart(number=int(self.address.rpartition(":")[2]))

    def send(self, data):
        if self.spoil is not None and data:
            data = self.spoil(data, self)
        self.last = data or self.last
        self.sent += bool(data)
        if self._wire is not None:
            self._wire.send(data)

    def close(self):
        if self._wire is not None:
            self._wire.close()

    def noise(self, share, data):
        """Return bytes of which a share is changed, as a wrong baud rate or a bad cable does."""
        values = np.frombuffer(data, np.uint8).copy()
        bad = self._rng.random(len(values)) < share
        values[bad] = self._rng.integers(0, 256, int(bad.sum()))
        return values.tobytes()


def silent(_data, _wire):
    return b""


def noisy(data, wire):
    return wire.noise(0.01, data)


def garbage(data, wire):
    return data + wire.noise(1.0, bytes(40)) + b"\n"


def half(data, _wire):
    return data[: len(data) // 2]


def repeated(_data, wire):
    """Say the same for ever: a device that hangs."""
    return wire.last


class Late:
    """Holds what is said back for so long (s), by a clock."""

    def __init__(self, clock, by):
        self._clock, self._by, self._held = clock, by, []

    def __call__(self, data, _wire):
        self._held.append((self._clock.now + self._by, data))
        due = [data for t, data in self._held if t <= self._clock.now]
        self._held = [each for each in self._held if each[0] > self._clock.now]
        return b"".join(due)


def covered(data, _wire):
    """Send the pictures of a lens behind a hand: all of them come, and none shows the board."""
    head, _, _ = data.partition(b"\r\n\r\n")
    stamp = head.partition(b"X-Timestamp: ")[2]
    return part(np.full((960, 1280), 30, np.uint8), float(stamp)) if stamp else data
