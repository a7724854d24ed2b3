"""A sensor and its port: rows in our frames, on the bench's clock."""

from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np

from equipoise.hardware.links.arrival_statistics import Arrivals, arrived
from equipoise.hardware.links.clock_sync import DeviceClock, learnt, to_bench
from equipoise.hardware.links.frame_transform import placed
from equipoise.hardware.links.health import Health
from equipoise.hardware.links.row_buffer import Row
from equipoise.hardware.transport.conversation import SensorDriver
from equipoise.hardware.transport.reconnecting_port import Connection
from equipoise.model.hardware import Gives, SensorUnit
from equipoise.model.reading import Reading

NEW = DeviceClock()
UNSTATED: dict[Gives, float] = {"attitude": 0.0, "rate": 0.0}  # s between rows
LEAST = 1e-6  # s, chosen: between rows that a clock, learnt better meanwhile, puts in wrong order
BACK = 2e-3  # s, chosen: by which rows are so out of order at most


class SensorLink:
    """Carries bytes between a sensor's driver and its port, and makes rows of readings."""

    def __init__(
        self,
        unit: SensorUnit,
        driver: SensorDriver,
        connection: Connection,
        periods: Mapping[Gives, float],
    ) -> None:
        """Take how far apart rows of each channel are, s, as the testbed states it."""
        self.unit, self.driver, self.connection = unit, driver, connection
        self._periods = periods
        self.clocks: dict[Gives, DeviceClock] = {}  # channels may come in messages of two clocks
        self.arrivals = Arrivals()
        self._came: float | None = None  # s, when a row last came
        self._last: dict[Gives, float] = {}  # s, the time of the last row of each channel
        self._since: float | None = None  # s, when it was first waited for

    @property
    def health(self) -> Health:
        """How well it answers."""
        name = f"sensor {self.unit.name}"
        rowless = tuple(self.driver.rowless.values())
        return Health(name, self.driver.counts, self.arrivals, dict(self.clocks), rowless)

    def silent_for(self, t: float) -> float:
        """Return how long no row has come, s."""
        last = self._since if self._came is None else self._came
        return 0.0 if last is None else t - last

    def turn(self, t: float) -> list[Row]:
        """Return the rows that have arrived."""
        if self._since is None:
            self._since = t
        turn = self.connection.turn(t)
        if turn.opened:
            self.driver.opened()
        rows = self._rows(turn.data, t)
        if rows:
            self._came = t
        if not self.connection.why:
            self.connection.send(self.driver.due(t), t)
        return rows

    def _rows(self, turn: Sequence[bytes], t: float) -> list[Row]:
        """Return the rows of all that came in a turn, those of a channel later and later."""
        kept = [
            reading
            for data in turn
            for reading in self.driver.feed(data)
            if reading.channel in self.unit.gives and self._keep(reading, t)
        ]
        rows: list[Row] = []
        for channel in self.unit.gives:
            own = [reading for reading in kept if reading.channel == channel]
            times = self._times(channel, [reading.stamp for reading in own], t)
            rows += [
                Row(channel, when, placed(self.unit, channel, np.array(reading.values)))
                for when, reading in zip(times, own, strict=True)
                if when is not None
            ]
        return sorted(rows, key=lambda row: row.t)

    def _keep(self, reading: Reading, t: float) -> bool:
        self.arrivals, keep = arrived(self.arrivals, reading, t)
        return keep

    def _times(
        self, channel: Gives, stamps: Sequence[float | None], t: float
    ) -> list[float | None]:
        """Return when rows were taken, s.

        By the device's clock, which all rows of the turn have taught first; by the period, counted
        back from now, where the device stamps no rows. None for a row older than the one before, as
        from a clock that was begun late.
        """
        if not stamps:
            return []
        for stamp in stamps:
            if stamp is not None:
                self.clocks[channel] = learnt(self.clocks.get(channel, NEW), stamp, t)
        last, count = self._last.get(channel, float("-inf")), len(stamps)
        step = min(self._periods[channel], (t - last) / count)
        times: list[float | None] = []
        for k, stamp in enumerate(stamps):
            when = t - (count - 1 - k) * step
            if stamp is not None:
                when = min(to_bench(self.clocks[channel], stamp), t)
            if when < last - BACK:
                self.arrivals = replace(self.arrivals, late=self.arrivals.late + 1)
                times.append(None)
                continue
            last = max(when, last + LEAST)
            times.append(last)
        self._last[channel] = last
        return times
