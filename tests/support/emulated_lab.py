"""An emulated bench with faulty wires and faulty motors, and the real bench at its ports."""

import contextlib
import time
from dataclasses import replace

from equipoise.app.bench.emulation import Station, emulate
from equipoise.app.bench.held_platform import later
from equipoise.app.bench.open_bench import keeper_of
from equipoise.hardware.bench.open_port import open_port
from equipoise.hardware.bench.real_bench import RealBench
from equipoise.model.hardware import Port
from tests.support.faulty_wire import FaultyWire

TICK = 0.02  # s, chosen: as often as a row of 50 Hz
PATIENCE = 10.0  # s of the wall, chosen: for a thread of a busy computer to pass a message on


def over_tcp(bed):
    """Return a testbed whose serial devices are behind network bridges.

    What is sent over the loopback is there at once; a pseudo terminal may take as long as the
    system likes, which is a pause on a clock that goes twenty times too fast.
    """
    hardware = bed.hardware

    def bridged(devices, what):
        return tuple(
            replace(device, port=Port(f"tcp:{what}:{k}"))
            if device.port.address.startswith("serial:")
            else device
            for k, device in enumerate(devices)
        )

    boards, sensors = bridged(hardware.boards, "board"), bridged(hardware.sensors, "unit")
    actuators = bridged(hardware.actuators, "actuator")
    whole = replace(hardware, boards=boards, sensors=sensors, actuators=actuators)
    return replace(bed, hardware=whole)


class FaultyMotors:
    """Stands between an emulated board and the platform: what a motor does, not what was commanded.

    ``done`` is the share of each way that a mass named in it really goes: 0 for one that is stuck.
    """

    def __init__(self, device):
        self._device = device
        self.done = {}
        self._reported, self._at = {}, {}

    def __getattr__(self, name):
        return getattr(self._device, name)

    def run(self, t):
        said, legs = self._device.run(t)
        return said, [self._really(leg) for leg in legs]

    def _really(self, leg):
        reported, at = self._reported.get(leg.mass, 0.0), self._at.get(leg.mass, 0.0)
        at += self.done.get(leg.mass, 1.0) * (leg.displacement - reported)
        self._reported[leg.mass], self._at[leg.mass] = leg.displacement, at
        return replace(leg, displacement=at)


class FaultyDevices:
    """Stands between emulated electronics and the platform: what a device does, not its order.

    ``done`` is the share of each input that a device named in it really gets: 0 of a stuck wheel.
    """

    def __init__(self, device):
        self._device = device
        self.done, self.given = {}, {}  # by name; what each really got last

    def __getattr__(self, name):
        return getattr(self._device, name)

    def run(self, t):
        said, given = self._device.run(t)
        really = [
            replace(each, value=self.done.get(each.device, 1.0) * each.value) for each in given
        ]
        self.given |= {each.device: each.value for each in really}
        return said, really


class LockstepClock:
    """Time of the emulated devices, which go on by one tick whenever somebody waits.

    The bench then runs as fast as the computer can, and nothing is late because something else
    took long: a tick ends when all that was sent has been read.
    """

    def __init__(self, emulated, tick=TICK):
        self._emulated, self._tick = emulated, tick

    @property
    def now(self):
        """Now, s."""
        return self._emulated.time

    def wait(self):
        """Let one tick pass."""
        self._emulated.run(self.now + self._tick)


class PlannedClock(LockstepClock):
    """A clock at whose moments things happen to the bench."""

    def __init__(self, emulated, tick):
        super().__init__(emulated, tick)
        self._plan = []

    def at(self, t, action):
        """Let something happen at t s."""
        self._plan.append((t, action))

    def wait(self):
        due = [action for t, action in self._plan if t <= self.now]
        self._plan = [(t, action) for t, action in self._plan if t > self.now]
        for action in due:
            action()
        super().wait()


class JumpingClock:
    """Stands before an emulated sensor whose clock may jump by ``by`` s."""

    def __init__(self, device):
        self._device, self.by = device, 0.0

    def __getattr__(self, name):
        return getattr(self._device, name)

    def messages(self, rows):
        return self._device.messages(later(rows, self.by))


class ThreadedPort:
    """Stands before a port whose messages go through a thread: each one sent is waited for.

    On the lab's clock all are there within their tick, however busy the computer is.
    """

    def __init__(self, port, wire):
        self._port, self._wire = port, wire
        self._taken = wire.sent

    def __getattr__(self, name):
        return getattr(self._port, name)

    def receive(self):
        found, until = self._port.receive(), time.monotonic() + PATIENCE
        while self._taken + len(found) < self._wire.sent and time.monotonic() < until:
            time.sleep(0.0005)
            found += self._port.receive()
        self._taken = self._wire.sent
        return found


class Lab:
    """Both sides of the wires on one clock, and all that the keeper says."""

    def __init__(self, bed, seed, tick=TICK):
        self.emulated = emulate(bed, seed)
        self.emulated.boards[:] = [
            Station(FaultyMotors(each.device), FaultyWire(each.wire, seed))
            for each in self.emulated.boards
        ]
        self.emulated.sensors[:] = [
            Station(JumpingClock(each.device), FaultyWire(each.wire, seed))
            for each in self.emulated.sensors
        ]
        self.emulated.actuators[:] = [
            Station(FaultyDevices(each.device), FaultyWire(each.wire, seed))
            for each in self.emulated.actuators
        ]
        self.keeper = keeper_of(self.emulated.testbed(), self._open)
        self.clock = PlannedClock(self.emulated, tick)
        self.bench = RealBench(self.keeper, self.clock)
        self.events = []
        self.keeper.listen(self)

    @property
    def board(self):
        return self.emulated.boards[0]

    @property
    def at_rest(self):
        """Say whether no device is given anything."""
        stations = self.emulated.actuators
        return not any(value for each in stations for value in each.device.given.values())

    @property
    def imu(self):
        return self.emulated.sensors[0]

    def _open(self, address):
        port = open_port(address)
        if not address.address.startswith("ws:"):
            return port
        (wire,) = (
            each.wire for each in self.emulated.stations if each.wire.address == address.address
        )
        return ThreadedPort(port, wire)

    def wait(self, seconds):
        """Let time pass, whether sensors give rows or not."""
        end = self.emulated.time + seconds
        while self.emulated.time < end:
            self.clock.wait()
            self.keeper.turn(self.clock.now)

    def rows(self, recording):
        pass

    def event(self, t, kind, sentence, data):
        self.events.append((t, kind, sentence))

    def turn(self, t):
        pass


@contextlib.contextmanager
def lab(bed, seed=1, tick=TICK):
    """Return a lab whose platform has just been let go."""
    found = Lab(bed, seed, tick)
    try:
        found.bench.start()
        found.bench.watch()
        yield found
    finally:
        found.keeper.close()
        found.emulated.close()
