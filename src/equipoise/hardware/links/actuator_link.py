"""An actuator and its port: reports on the bench's clock, and whether its devices follow."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from equipoise.hardware.links.clock_sync import DeviceClock, learnt, to_bench
from equipoise.hardware.links.device_following import Following
from equipoise.hardware.links.driver_turn import fed, said
from equipoise.hardware.links.health import Health
from equipoise.hardware.transport.attended_time import AttendedTime
from equipoise.hardware.transport.driver_protocol import ActuatorDriver, Counted
from equipoise.hardware.transport.reconnecting_port import Connection
from equipoise.model.devices import Device
from equipoise.model.hardware import ActuatorUnit
from equipoise.model.reasons.reason import Reason


@dataclass(frozen=True, slots=True)
class Report:
    """What the unit's devices have counted, in the order of its outputs."""

    t: float  # s, on the bench's clock
    values: tuple[float, ...]


class ActuatorLink:
    """Carries bytes between an actuator's driver and its port."""

    def __init__(
        self,
        unit: ActuatorUnit,
        driver: ActuatorDriver,
        connection: Connection,
        devices: Sequence[Device],
    ) -> None:
        """Take all devices of the testbed, among them those that the unit drives."""
        self.unit, self.driver, self.connection = unit, driver, connection
        by_name = {device.name: device for device in devices}
        self._following = {name: Following(by_name[name]) for name in unit.drives}
        self._attended, self._clock, self._begun = AttendedTime(), DeviceClock(), 0
        self._last = float("-inf")  # s, of the last report
        self.begun_anew = False  # in this turn: its counts did

    @property
    def health(self) -> Health:
        """How well it answers."""
        return Health(f"actuator {self.unit.name}", self.driver.counts)

    @property
    def deviation(self) -> Reason | None:
        """The first device that does not do what it is driven to; None: all do."""
        found = (each.deviation for each in self._following.values())
        return next((reason for reason in found if reason is not None), None)

    def begin(self, t: float) -> None:
        """Let its devices rest, and ask it anew who it is."""
        self.driver.begin(t)
        self._forget()

    def turn(self, t: float) -> list[Report]:
        """Feed the driver what has arrived; return its reports."""
        waited = t - self._attended.arrival(t)
        self._attended.turn(t)
        counted = [each for part in fed(self.driver, self.connection, t) for each in part]
        self.begun_anew = self.driver.begun != self._begun
        if self.begun_anew:
            self._begun = self.driver.begun
            self._forget()
        for each in counted:
            self._clock = learnt(self._clock, each.stamp, t, waited)
        found = [report for each in counted if (report := self._timed(each, t)) is not None]
        self._follow(found)
        return found

    def send(self, t: float) -> None:
        """Send what the driver has to say."""
        said(self.driver, self.connection, t)

    def _timed(self, counted: Counted, t: float) -> Report | None:
        """Return a report on the bench's clock; None if it is no later than the one before."""
        when = min(to_bench(self._clock, counted.stamp), t)
        if when <= self._last:
            return None
        self._last = when
        return Report(when, tuple(counted.values[name] for name in self.unit.drives))

    def _follow(self, reports: Sequence[Report]) -> None:
        """Compare what devices were given with what they count, both by the device's clock."""
        taken, self.driver.taken = self.driver.taken, []
        given = [(to_bench(self._clock, each.stamp), each.inputs) for each in taken]
        for report in reports:
            for name, value in zip(self.unit.drives, report.values, strict=True):
                self._following[name].reported(report.t, value)
            self._give([each for each in given if each[0] <= report.t])
            given = [each for each in given if each[0] > report.t]
        self._give(given)

    def _give(self, given: Sequence[tuple[float, Mapping[str, float]]]) -> None:
        for t, inputs in given:
            for name, value in inputs.items():
                self._following[name].given(t, value)

    def _forget(self) -> None:
        for each in self._following.values():
            each.begin()
