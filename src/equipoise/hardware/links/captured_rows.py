"""Rows of bytes that were saved: the link of a sensor without its port.

Times count from where the file begins. Where the capture says when bytes arrived, rows are timed as
on the bench. Where only the device stamps its rows, a row arrives when its stamp says, and after a
clock that went back a step after the row before. Where there is neither, rows are spaced evenly; a
row that its number, or a broken message, shows to be missing leaves its place.
"""

from collections.abc import Sequence

from equipoise.hardware.links.clock_sync import to_bench
from equipoise.hardware.links.row_buffer import Row
from equipoise.hardware.links.sensor_rows import SensorRows
from equipoise.model.hardware import Gives, SensorUnit
from equipoise.model.reading import Reading

BEHIND = 1.0  # s, chosen: a capture's clock back by more was set; by less packets changed places
SKIPPED = 1000  # rows, chosen: a number farther ahead is of a counter that restarted


class Timeless(Exception):
    """Neither capture nor row has a time, and no rate is known."""


class CapturedRows:
    """The rows of one sensor, from readings in the order in which they were saved."""

    def __init__(self, unit: SensorUnit, rate: float | None) -> None:
        """Take at which rate rows came (Hz), where nothing says when."""
        self._step = None if rate is None else 1.0 / rate
        periods: dict[Gives, float] = dict.fromkeys(("attitude", "rate"), self._step or 0.0)
        self.received = SensorRows(unit, periods)
        self.set_back = 0  # times that the capture's clock was
        self.spaced = False  # rows were, since nothing said when they came
        self._now = 0.0  # s, of the last reading
        self._captured: float | None = None  # s, by the capture's clock
        self._ahead: dict[Gives, float] = {}  # s, last step of the device's clock
        self._number: int | None = None

    def rows(self, readings: Sequence[Reading], t: float | None, broken: int) -> list[Row]:
        """Return the rows of what arrived together, after so many broken messages.

        ``t``: s, by the capture's clock; None if it has none.
        """
        if t is not None:
            self._now = self._arrival(t)
            return self.received.rows(readings, self._now)
        if self.spaced and self._number is None:
            self._now += broken * (self._step or 0.0)
        rows: list[Row] = []
        channels: set[Gives] = set()
        for reading in readings:
            if reading.stamp is not None:
                self._now = max(self._now, self._stamped(reading.channel, reading.stamp))
            elif not channels or reading.channel in channels:
                self._now += self._spaced(reading.number)
                channels = set()
            channels.add(reading.channel)
            rows += self.received.rows([reading], self._now)
        return rows

    def _arrival(self, t: float) -> float:
        """Return the time of a capture's: from zero on, and never back."""
        last, self._captured = self._captured, t
        if last is None:
            return 0.0
        if t < last - BEHIND:
            self.set_back += 1
            return self._now
        if t < last:
            self._captured = last
            return self._now
        return self._now + (t - last)

    def _stamped(self, channel: Gives, stamp: float) -> float:
        clock = self.received.clocks.get(channel)
        if clock is None:
            return self._now
        if stamp < clock.last:
            return self._now + self._ahead.get(channel, 0.0)
        self._ahead[channel] = stamp - clock.last
        return to_bench(clock, stamp)

    def _spaced(self, number: int | None) -> float:
        """Return how long after the row before the next one is, s."""
        if self._step is None:
            raise Timeless
        last, self._number = self._number, number
        begun, self.spaced = self.spaced, True
        if not begun:
            return 0.0
        ahead = 1 if number is None or last is None else number - last
        return (ahead if 0 <= ahead <= SKIPPED else 1) * self._step
