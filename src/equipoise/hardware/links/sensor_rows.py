"""Readings of a sensor, as they came, to rows in our frames on the bench's clock."""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace

import numpy as np

from equipoise.hardware.links.arrival_statistics import Arrivals, arrived, begun_anew
from equipoise.hardware.links.clock_sync import DeviceClock, learnt, to_bench
from equipoise.hardware.links.frame_transform import placed
from equipoise.hardware.links.row_buffer import Row
from equipoise.model.hardware import Gives, SensorUnit
from equipoise.model.reading import Reading

NEW = DeviceClock()
LEAST = 1e-6  # s, chosen: between rows that a clock, learnt better meanwhile, puts in wrong order
BACK = 2e-3  # s, chosen: by which rows are so out of order at most


class SensorRows:
    """What is known of a sensor's clocks and arrivals, by which its rows are timed and kept."""

    def __init__(self, unit: SensorUnit, periods: Mapping[Gives, float]) -> None:
        """Take how far apart rows of each channel are, s, as the testbed states it."""
        self.unit, self._periods = unit, periods
        self.clocks: dict[Gives, DeviceClock] = {}  # channels may come in messages of two clocks
        self.arrivals = Arrivals()
        self._last: dict[Gives, float] = {}  # s, the time of the last row of each channel
        self._paused = 0.0  # s, in all
        self._waited, self._t = 0.0, 0.0  # s, for how long rows may have waited; at the last turn

    def opened(self) -> None:
        """Note that the port has just been opened: numbers and values may restart."""
        self.arrivals = begun_anew(self.arrivals)

    def rows(self, readings: Iterable[Reading], t: float, paused: float = 0.0) -> list[Row]:
        """Return the rows of what came at ``t`` s, those of a channel later and later.

        ``paused``: s before it in which nobody listened, so that rows may have waited.
        """
        self._paused += paused
        self._waited = max(
            paused, self._waited - max(t - self._t, 0.0)
        )  # in some turns all is read
        self._t = t
        kept = [
            reading
            for reading in readings
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
        self.arrivals, keep = arrived(self.arrivals, reading, t - self._paused)
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
                clock = self.clocks.get(channel, NEW)
                self.clocks[channel] = learnt(clock, stamp, t, self._waited)
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
