"""A whole bench emulated: a simulated platform behind devices that speak their real protocols.

The platform is the simulator's; masses go where the emulated boards lead them, and the emulated
sensors say what it shows. Time is set from outside, so that a bench can run as fast as it likes
or as the clock on the wall.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import partial
from typing import Any, Generic, TypeVar

from equipoise.app.bench.held_platform import HeldPlatform, later
from equipoise.hardware.emulated.counterpart import Counterpart, counterpart
from equipoise.hardware.emulated.device import (
    EmulatedActuator,
    EmulatedBoard,
    EmulatedSensor,
    Given,
    Leg,
)
from equipoise.hardware.emulated.registry import SENSORS, emulated_actuator, emulated_board
from equipoise.hardware.emulated.serial_line import SerialLine
from equipoise.hardware.transport.driver_protocol import driver_named
from equipoise.maths.attitude import tilt
from equipoise.model.arrays import Quaternion
from equipoise.model.errors import InputError
from equipoise.model.hardware import ActuatorUnit, Hardware, MotorBoard, SensorUnit
from equipoise.model.recording import Recording, joined
from equipoise.model.testbed import Testbed
from equipoise.simulation.bench import SimulatedBench

AT_HOME = 2e-6  # m, chosen: boards report positions to 1 um
NOTICED = 1.0  # s, chosen: by then an interlock has stopped what it is to stop

Device = TypeVar("Device")
Unit = TypeVar("Unit", MotorBoard, SensorUnit, ActuatorUnit)


@dataclass(frozen=True, slots=True, eq=False)
class Station(Generic[Device]):
    """A device and its wire."""

    device: Device
    wire: Counterpart
    line: SerialLine | None = None  # that its messages go over; None: they are there at once

    def say(self, data: bytes, t: float) -> None:
        """Send what the device has said by t s, as quick as its line is."""
        if self.line is not None:
            self.line.put(data, t)
            data = b"".join(byte for _, byte in self.line.arrived(t))
        self.wire.send(data)


class EmulatedBench:
    """Devices on their wires and the platform behind them.

    The platform is held still, as a person holds it, until every mass has come home; then it is
    let go, and its own time begins. Who homes again holds it again: the same platform, anew.
    """

    def __init__(
        self,
        platform: Callable[[], SimulatedBench],
        boards: Sequence[Station[EmulatedBoard]],
        sensors: Sequence[Station[EmulatedSensor]],
        actuators: Sequence[Station[EmulatedActuator]] = (),
    ) -> None:
        self._make, self.boards, self.sensors = platform, boards, sensors
        self.actuators = actuators
        self.time = 0.0  # s, of the devices
        self._let_go = 0.0  # s, when
        self.leaning = 0.0  # rad, as last observed
        self._observed: tuple[float, Quaternion] | None = None  # s, the attitude last observed
        self.catch()
        if not boards:
            self._held = None

    def run(self, t: float) -> None:
        """Let time pass up to ``t`` s; what the host has sent is received first."""
        self._receive()
        if t <= self.time:
            return
        legs = [leg for station in self.boards for leg in self._ran(station, t)]
        given = [each for station in self.actuators for each in self._ran(station, t)]
        if self._held is None and any(station.device.homing for station in self.boards):
            self.catch()
        rows = self._pass(legs, given, t)
        if rows.attitude is not None and len(rows.attitude):
            self.leaning = float(tilt(rows.attitude.values[-1], self.platform.testbed.up))
            self._observed = (self.time, rows.attitude.values[-1])
        for station in self.actuators:
            station.device.observe(rows, t)
        for station in self.sensors:
            for message in station.device.messages(rows):
                station.say(message, t)
            if station.line is not None:
                station.say(b"", t)

    @property
    def has_fallen(self) -> bool:
        """Say whether the platform met its stop a while ago: interlocks come first."""
        touches = self.platform.touches
        return bool(touches) and self.platform.time - touches[0].start > NOTICED

    def catch(self) -> None:
        """Lead the platform back and hold it, until every mass has been away and come home."""
        self.platform = self._make()
        self._held: HeldPlatform | None = HeldPlatform(self.platform, self._observed)
        self._last: dict[str, Leg] = {}  # while it is held
        self._away: set[str] = set()
        self._ahead: list[Leg] = []  # that have not begun

    def testbed(self) -> Testbed:
        """Return the testbed with the ports at which these devices are reached."""
        bed = self.platform.testbed
        hardware = hardware_of(bed)
        boards = tuple(map(_reached, hardware.boards, self.boards))
        sensors = tuple(map(_reached, hardware.sensors, self.sensors))
        actuators = tuple(map(_reached, hardware.actuators, self.actuators))
        reached = replace(hardware, boards=boards, sensors=sensors, actuators=actuators)
        return replace(bed, hardware=reached)

    @property
    def stations(self) -> tuple[Station[Any], ...]:
        """Every device with its wire."""
        return (*self.boards, *self.sensors, *self.actuators)

    def close(self) -> None:
        """Pull out every wire."""
        for station in self.stations:
            station.wire.close()

    def _receive(self) -> None:
        for station in self.stations:
            data = station.wire.receive()
            if data:
                station.say(station.device.take(data, self.time), self.time)

    def _ran(self, station: Station[Any], t: float) -> Sequence[Any]:
        """Let a device's time pass; return what it began."""
        said, begun = station.device.run(t)
        station.wire.send(said)
        return begun

    def _pass(self, legs: Sequence[Leg], given: Sequence[Given], t: float) -> Recording:
        """Let the platform go on, or be held, and return what its sensors see."""
        before, self.time = self.time, t
        if self._held is not None:
            self._last |= {leg.mass: leg for leg in legs}
            self._away |= {leg.mass for leg in legs if abs(leg.displacement) > AT_HOME}
            rows = self._held.read(before, t)
            if t >= self._held.still and self._all_home(t):
                self._held, self._let_go = None, t
            return rows
        self._ahead = ahead_of(self._ahead, legs)
        now = self.platform.time
        for leg in (leg for leg in self._ahead if leg.t <= t):
            start, end = max(leg.t - self._let_go, now), leg.end - self._let_go
            self.platform.lead(leg.mass, start, max(start, end), leg.displacement)
        self._ahead = [leg for leg in self._ahead if leg.t > t]
        return later(self._driven(given, t - before), self._let_go)

    def _driven(self, given: Sequence[Given], duration: float) -> Recording:
        """Let the platform go on for so long (s), its devices driven at their times."""
        platform, parts = self.platform, list[Recording]()
        end = platform.time + duration
        for each in sorted(given, key=lambda each: each.t):
            wait = min(each.t - self._let_go, end) - platform.time
            if wait > 0:
                parts.append(platform.read(wait))
            platform.drive({each.device: each.value})
        return joined([*parts, platform.read(max(end - platform.time, 0.0))])

    def _all_home(self, t: float) -> bool:
        """Say whether every mass of a board that homes has been away, and has come home."""
        boards = (b for b in hardware_of(self.platform.testbed).boards if b.homing)
        masses = {axis.mass for board in boards for axis in board.axes}
        return masses <= self._away and all(
            self._last[name].end <= t and abs(self._last[name].displacement) < AT_HOME
            for name in masses
        )


def ahead_of(waiting: Sequence[Leg], new: Sequence[Leg]) -> list[Leg]:
    """Return legs in order; a new one replaces those of its mass that would begin after it."""
    legs = list(waiting)
    for leg in new:
        legs = [old for old in legs if old.mass != leg.mass or old.t < leg.t] + [leg]
    return legs


def emulate(testbed: Testbed, seed: int) -> EmulatedBench:
    """Return a bench emulated as the testbed file declares its hardware."""
    hardware = hardware_of(testbed)
    boards: list[Station[EmulatedBoard]] = [
        Station(
            emulated_board(board, testbed.masses),
            counterpart(board.port),
        )
        for board in hardware.boards
    ]
    sensors = [
        Station(
            driver_named(SENSORS, unit.driver, "sensor")(unit),
            counterpart(unit.port),
            SerialLine(unit.port.baud) if unit.port.address.startswith("serial:") else None,
        )
        for unit in hardware.sensors
    ]
    actuators: list[Station[EmulatedActuator]] = [
        Station(emulated_actuator(unit, testbed.devices), counterpart(unit.port))
        for unit in hardware.actuators
    ]
    return EmulatedBench(partial(SimulatedBench, testbed, seed), boards, sensors, actuators)


def _reached(unit: Unit, station: Station[Any]) -> Unit:
    """Return a unit with the port at which its counterpart is reached."""
    return replace(unit, port=replace(unit.port, address=station.wire.address))


def hardware_of(testbed: Testbed) -> Hardware:
    """Return what is connected; InputError where nothing is."""
    if testbed.hardware is None:
        wanted = "a table [hardware] with its boards and sensors"
        raise InputError(testbed.source or testbed.name, "no hardware", wanted)
    return testbed.hardware
