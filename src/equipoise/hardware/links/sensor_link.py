"""A sensor and its port: rows in our frames, on the bench's clock."""

from collections.abc import Mapping

from equipoise.hardware.links.arrival_statistics import Arrivals
from equipoise.hardware.links.clock_sync import DeviceClock
from equipoise.hardware.links.health import Health
from equipoise.hardware.links.row_buffer import Row
from equipoise.hardware.links.sensor_rows import SensorRows
from equipoise.hardware.transport.attended_time import AttendedTime
from equipoise.hardware.transport.conversation import SensorDriver
from equipoise.hardware.transport.reconnecting_port import Connection
from equipoise.model.hardware import Gives, SensorUnit

SHOWN = 40  # bytes, chosen: of what was received last, shown to people
UNSTATED: dict[Gives, float] = {"attitude": 0.0, "rate": 0.0}  # s between rows


class SensorLink:
    """Carries bytes between a sensor's driver and its port, and makes rows of readings.

    Each channel is alive by its own rows: a device whose attitude hangs may go on with its rate.
    """

    def __init__(
        self,
        unit: SensorUnit,
        driver: SensorDriver,
        connection: Connection,
        periods: Mapping[Gives, float],
    ) -> None:
        """Take how far apart rows of each channel are, s, as the testbed states it."""
        self.unit, self.driver, self.connection = unit, driver, connection
        self._rows, self._clock = SensorRows(unit, periods), AttendedTime()
        self._came = dict.fromkeys(unit.gives, 0.0)  # s, attended, when a row of each last came
        self._received = b""  # last

    @property
    def arrivals(self) -> Arrivals:
        """What has come so far."""
        return self._rows.arrivals

    @property
    def clocks(self) -> Mapping[Gives, DeviceClock]:
        """The device's clock by channel."""
        return self._rows.clocks

    @property
    def health(self) -> Health:
        """How well it answers."""
        return Health(
            f"sensor {self.unit.name}",
            self.driver.counts,
            self.arrivals,
            dict(self.clocks),
            self.driver.requests.overdue,
            self._received,
            tuple(self.driver.rowless.values()),
        )

    @property
    def silent(self) -> dict[Gives, float]:
        """How long no row of each channel has come while somebody listened, s."""
        return {channel: self._clock.now - came for channel, came in self._came.items()}

    def turn(self, t: float) -> list[Row]:
        """Return the rows that have arrived."""
        paused = t - self._clock.arrival(t)
        self._clock.turn(t)
        turn = self.connection.turn(t)
        if turn.opened:
            self.driver.opened()
            self._rows.opened()
        if turn.data:
            self._received = turn.data[-1][-SHOWN:]
        readings = [reading for data in turn.data for reading in self.driver.feed(data)]
        rows = self._rows.rows(readings, t, paused)
        self._came |= {row.channel: self._clock.now for row in rows}
        if not self.connection.why:
            self.connection.send(self.driver.due(t), t)
        return rows
