"""What a bench has received, row by row, and as recordings.

A position is kept where it changes: of masses that stand, the first and the last answer, and one
a second between; of masses that go, each answer and where they started or stopped
(``mass_interpolation``).
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np

from equipoise.hardware.links.mass_interpolation import Answer, rows_to
from equipoise.model.arrays import Floats
from equipoise.model.hardware import Gives
from equipoise.model.recording import Recording, Samples
from equipoise.model.testbed import SlidingMass

BEAT = 1.0  # s, chosen: between rows of masses that stand


@dataclass(frozen=True, slots=True, eq=False)
class Row:
    """One row of a sensor, in our frames."""

    channel: Gives
    t: float  # s, on the bench's clock
    values: Floats  # quaternion or rad/s


@dataclass(slots=True)
class Rows:
    """Rows of one channel, times growing."""

    t: list[float] = field(default_factory=list[float])
    values: list[Floats] = field(default_factory=list[Floats])

    def samples(self, start: int) -> Samples | None:
        """Return the rows from one on; None if there is none."""
        if start >= len(self.t):
            return None
        return Samples(np.array(self.t[start:]), np.array(self.values[start:]))


CHANNELS: tuple[str, ...] = ("attitude", "rate", "masses", "devices")


class RowBuffer:
    """Rows not taken yet, and which of them were handed on."""

    def __init__(self, masses: Sequence[SlidingMass], devices: Sequence[str] = ()) -> None:
        """Take the masses, and what a recording calls each device."""
        self._names = tuple(mass.name for mass in masses)
        self._device_names = tuple(devices)
        self._speed = np.array([mass.speed for mass in masses])
        self._rows = {name: Rows() for name in CHANNELS}
        self._reported = dict.fromkeys(CHANNELS, 0)
        self._last = dict.fromkeys(CHANNELS, float("-inf"))
        self._answer: Answer | None = None  # the last one

    def row(self, row: Row) -> bool:
        """Take a sensor's row; say whether it is later than the one before and so was kept."""
        return self._append(row.channel, row.t, row.values)

    def devices(self, t: float, values: Floats) -> None:
        """Take a row of all devices."""
        self._append("devices", t, values)

    def masses(
        self, at: Mapping[str, float], wants: Mapping[str, bool], reported: float | None
    ) -> None:
        """Take where masses are (m) and which have still to go, as reported at a time.

        Masses without a board stay home. Without a time no position is known: what comes next has
        no row before it.
        """
        if reported is None or not self._names:
            self._answer = None
            return
        where = np.array([at.get(name, 0.0) for name in self._names])
        short = np.array([wants.get(name, False) for name in self._names])
        before = self._answer
        if before is None:
            if self._append("masses", reported, where):
                self._answer = Answer(reported, where, np.zeros(len(where), dtype=np.bool_))
            return
        if reported <= before.t:
            return
        rows, self._answer = rows_to(before, reported, where, short, self._speed)
        if bool(np.any(where != before.at)):
            for row in (before, *rows):
                self._append("masses", row.t, row.at)
        elif reported - self._last["masses"] >= BEAT:
            self._append("masses", reported, where)

    def fresh(self) -> Recording | None:
        """Return the rows not handed on yet; None if there are none."""
        parts = {name: rows.samples(self._reported[name]) for name, rows in self._rows.items()}
        if not any(parts.values()):
            return None
        self._reported = {name: len(rows.t) for name, rows in self._rows.items()}
        return self._recording(parts)

    def begin(self) -> None:
        """Forget the rows so far; the next answer has a row, however soon it comes."""
        self.taken()
        self._answer = None

    def taken(self) -> Recording:
        """Return the rows since this was last asked, and forget them."""
        parts = {name: rows.samples(0) for name, rows in self._rows.items()}
        self._rows = {name: Rows() for name in CHANNELS}
        self._reported = dict.fromkeys(CHANNELS, 0)
        return self._recording(parts)

    def _append(self, channel: str, t: float, values: Floats) -> bool:
        if t <= self._last[channel]:
            return False
        self._last[channel] = t
        self._rows[channel].t.append(t)
        self._rows[channel].values.append(values)
        return True

    def _recording(self, parts: Mapping[str, Samples | None]) -> Recording:
        """Return rows by channel as a recording."""
        return Recording(
            attitude=parts["attitude"],
            rate=parts["rate"],
            mass_names=self._names,
            masses=parts["masses"],
            device_names=self._device_names if parts["devices"] is not None else (),
            devices=parts["devices"],
        )
