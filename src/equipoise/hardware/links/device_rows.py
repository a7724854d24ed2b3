"""Rows of all devices of a platform, from units that report each at its own times.

A row is at each time of any unit, once all of them have reported beyond it. Between two reports
what is counted goes along a straight line: a wheel's speed under a constant torque does, and so
does the total of a jet's pulses, of which a row has the mean slope since the row before. So no
impulse is lost or counted twice.
"""

from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np

from equipoise.model.arrays import Floats, Series1
from equipoise.model.devices import TRAITS, Device, at_start


@dataclass(slots=True)
class _Reports:
    """What one unit has reported and rows still need, times growing."""

    columns: Sequence[int]
    t: list[float] = field(default_factory=list[float])
    values: list[Floats] = field(default_factory=list[Floats])


class DeviceRows:
    """The reports that wait for those of other units."""

    def __init__(self, devices: Sequence[Device], driven: Sequence[Sequence[str]]) -> None:
        """Take all devices, and which of them each unit drives, in its order.

        A device that no unit drives stays as it is at the start.
        """
        names = [device.name for device in devices]
        self._units = [_Reports([names.index(name) for name in each]) for each in driven]
        self._start = np.array([at_start(device) for device in devices])
        pulsed = [TRAITS[type(device)].pulsed for device in devices]
        self._pulsed = np.array(pulsed, dtype=np.bool_)
        self._last: tuple[float, Floats] | None = None  # s, counted: the row before

    def begin(self) -> None:
        """Forget all: a unit's counts restarted, so no row goes on from one before."""
        self._last = None
        for unit in self._units:
            unit.t.clear()
            unit.values.clear()

    def reported(self, unit: int, t: float, values: Sequence[float]) -> None:
        """Take what a unit has counted at t (s)."""
        reports = self._units[unit]
        if not reports.t or t > reports.t[-1]:
            reports.t.append(t)
            reports.values.append(np.array(values))

    def rows(self) -> list[tuple[float, Floats]]:
        """Return the rows that are whole now: s, and what a recording has of each device."""
        if not self._units or not all(unit.t for unit in self._units):
            return []
        begin, end = max(unit.t[0] for unit in self._units), min(u.t[-1] for u in self._units)
        after = -np.inf if self._last is None else self._last[0]
        t = np.unique(np.concatenate([np.array(unit.t) for unit in self._units]))
        t = t[(t > after) & (t >= begin) & (t <= end)]
        counted = self._counted(t)
        found: list[tuple[float, Floats]] = []
        for when, values in zip(t.tolist(), counted, strict=True):
            if self._last is not None:
                found.append((when, self._reported(when, values)))
            self._last = when, values
        self._forget(end)
        return found

    def _counted(self, t: Series1) -> Floats:
        """Return what all devices have counted at times (s), (n, k)."""
        found = np.tile(self._start, (len(t), 1))
        for unit in self._units:
            values = np.array(unit.values)
            for k, column in enumerate(unit.columns):
                found[:, column] = np.interp(t, unit.t, values[:, k])
        return found

    def _reported(self, t: float, counted: Floats) -> Floats:
        """Return a row as a recording has it, after the last one."""
        assert self._last is not None
        before, last = self._last
        return np.where(self._pulsed, (counted - last) / (t - before), counted)

    def _forget(self, end: float) -> None:
        """Keep of each unit the last report up to a time (s), and those after it."""
        for unit in self._units:
            first = max(int(np.searchsorted(unit.t, end, side="right")) - 1, 0)
            del unit.t[:first], unit.values[:first]
