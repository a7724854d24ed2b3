"""An actuator's link: what was given and what was counted meet on the device's clock."""

import pytest

from equipoise.hardware.links.actuator_link import ActuatorLink
from equipoise.hardware.transport.driver_protocol import ActuatorDriver, Counted, Taken
from equipoise.hardware.transport.reconnecting_port import Connection
from equipoise.model.hardware import Port
from equipoise.model.reasons.interlocks import Interlock
from tests.support.actuator_wire import BED, unit_of

BOOT = 40.0  # s, by which the device's clock is ahead


class Coil(ActuatorDriver):
    """A dipole that is reversed each second, and follows at once; ``share`` of it."""

    def __init__(self, unit, share):
        super().__init__(unit)
        self._share = share

    def opened(self, t):
        """Nothing begins."""

    def closed(self, why):
        """Nothing ends."""

    def rest(self, t):
        """Nothing rests."""

    def begin(self, t):
        """Nothing begins."""

    def due(self, t):
        """Say nothing."""
        return b""

    def _give(self, inputs, t):
        """Take nothing."""

    def feed(self, data, t):
        """Return the reports whose numbers have come, each 20 ms later than the one before."""
        found = []
        for k in data:
            self.count(good=1)
            seconds = self.counts.good // 50
            value = 0.0 if not seconds else 0.08 if seconds % 2 else -0.08
            stamp = BOOT + 0.02 * self.counts.good
            if self.counts.good % 50 == 0:
                self.taken.append(Taken(stamp, {"mt_y": value}))
            found.append(Counted(stamp, {"mt_y": self._share * value if k else 0.0}))
        return found


class Wire:
    """A port at which reports wait while nobody listens."""

    def __init__(self, address):
        self.waiting = b""

    def receive(self):
        """Return what waits."""
        data, self.waiting = self.waiting, b""
        return [data] if data else []

    def send(self, data):
        """Take it."""

    def close(self):
        """Close it."""


@pytest.mark.parametrize(("share", "code"), [(1.0, None), (0.0, Interlock.NOT_FOLLOWING)])
def test_a_computer_that_pauses_as_an_input_changes_sign_blames_no_device(share, code):
    """It pauses for 0.4 s around each change, and finds out late what was taken."""
    wires = []

    def opener(address):
        wires.append(Wire(address))
        return wires[-1]

    unit = unit_of("device_lines", ("mt_y",))
    link = ActuatorLink(unit, Coil(unit, share), Connection(Port("x"), opener), BED.devices)
    link.turn(0.0)
    found = None
    for k in range(1, 1000):
        wires[-1].waiting += b"\x01"
        if 35 <= k % 50 < 55 or k % 50 < 5:  # 0.4 s of each second
            continue
        link.turn(0.02 * k)
        found = found or link.deviation
    assert (None if found is None else found.code) == code
