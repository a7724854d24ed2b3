"""A sensor and its port: rows in our frames, on the bench's clock."""

import numpy as np

from equipoise.hardware.arrivals import Arrivals, arrived
from equipoise.hardware.connection import Connection
from equipoise.hardware.device_clock import DeviceClock, learnt, to_bench
from equipoise.hardware.driver import SensorDriver
from equipoise.hardware.heard import Row
from equipoise.hardware.placed import placed
from equipoise.model.hardware import Gives, SensorUnit
from equipoise.model.reading import Reading


class SensorLink:
    """Carries bytes between a sensor's driver and its port, and makes rows of readings."""

    def __init__(self, unit: SensorUnit, driver: SensorDriver, connection: Connection) -> None:
        self.unit, self.driver, self._connection = unit, driver, connection
        self.clocks: dict[Gives, DeviceClock] = {}  # channels may come in messages of two clocks
        self.arrivals = Arrivals()
        self._last: float | None = None  # s, when a row last came
        self._since: float | None = None  # s, when it was first waited for

    @property
    def why(self) -> str:
        """Why the port is closed; empty while it is open."""
        return self._connection.why

    def silent_for(self, t: float) -> float:
        """Return how long no row has come, s."""
        last = self._since if self._last is None else self._last
        return 0.0 if last is None else t - last

    def turn(self, t: float) -> list[Row]:
        """Return the rows that have arrived."""
        if self._since is None:
            self._since = t
        turn = self._connection.turn(t)
        if turn.opened:
            self.driver.opened()
        rows = [row for data in turn.data for row in self._rows(data, t)]
        if not self._connection.why:
            self._connection.send(self.driver.due(t), t)
        return rows

    def close(self) -> None:
        """Close the port."""
        self._connection.close()

    def _rows(self, data: bytes, t: float) -> list[Row]:
        readings = [r for r in self.driver.feed(data) if r.channel in self.unit.gives]
        return [row for reading in readings if (row := self._row(reading, t)) is not None]

    def _row(self, reading: Reading, t: float) -> Row | None:
        """Return the row of a reading; None for one that is not to be kept."""
        self.arrivals, keep = arrived(self.arrivals, reading, t)
        if not keep:
            return None
        self._last, when = t, t
        if reading.stamp is not None:
            before = self.clocks.get(reading.channel, DeviceClock())
            clock = self.clocks[reading.channel] = learnt(before, reading.stamp, t)
            when = min(to_bench(clock, reading.stamp), t)
        return Row(
            reading.channel, when, placed(self.unit, reading.channel, np.array(reading.values))
        )
