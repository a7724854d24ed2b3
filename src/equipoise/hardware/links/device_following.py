"""Whether a device does what it is driven to do: what it counts against what it was given.

    E = gain * (integral of the input, or sum of the pulses)        R = what it counted meanwhile

A device that counts no total (a dipole) is integrated too. An input and its effect are late against
each other, by the lag and by ``DELAY`` at most. So E and R are compared when what was given has
gone a way of ``LATE`` times what may be late; then |R - E| must be within half of that way. What is
too little to tell from noise within ``LONGEST`` is not compared. A device that goes by itself is
found by a way that a whole second of its greatest input would take. What this cannot see is a
device that stands still while its inputs cancel each other, as pulses to and fro do.
"""

from dataclasses import dataclass

from equipoise.model.devices import (
    TRAITS,
    Device,
    counted_gain,
    counted_noise,
    greatest_count,
    greatest_input,
)
from equipoise.model.reasons.interlocks import Interlock
from equipoise.model.reasons.reason import Reason

DELAY = 0.1  # s, chosen: between an input taken and its effect in a report, the lag apart
LATE = 10.0  # chosen: of what may be late, at both ends, a fifth of the way at most
SCATTER = 12.0  # sd of what is counted, chosen: noise is no way
SHARE = 0.5  # of the way, chosen: a wheel that follows by half of what it should is at fault
LONGEST = 10.0  # s, chosen: a drive's friction is no motion of its own
ALONE = 1.0  # s of the greatest input, chosen
NEAR = 0.98  # of a wheel's greatest speed, chosen: there its drive has no more voltage
BEYOND = 1.05  # of the greatest speed, or of the greatest dipole, chosen


@dataclass(slots=True)
class _Way:
    """Since when what was given and what was counted are compared."""

    t: float  # s
    counted: float  # at t, of a total; else integrated since
    given: float = 0.0  # E
    gone: float = 0.0  # the same without signs
    step: float = 0.0  # the greatest that may be late at once
    saturated: bool = False  # at times: then it cannot follow


class Following:
    """One device; inputs and reports come in the order of time."""

    def __init__(self, device: Device) -> None:
        self._device, self._traits = device, TRAITS[type(device)]
        self._gain, self._noise = counted_gain(device), counted_noise(device)
        self._most = greatest_count(device)
        self._input, self._since = 0.0, 0.0  # that lasts; s, up to when it is counted in
        self._last: tuple[float, float] | None = None  # s, the last report
        self._way: _Way | None = None
        self.deviation: Reason | None = None

    def begin(self) -> None:
        """Forget all: the device rests, or its counts restarted."""
        self._input, self._last, self._way, self.deviation = 0.0, None, None, None

    def given(self, t: float, value: float) -> None:
        """Note an input that was taken at t (s)."""
        self._passed(t)
        if not self._traits.pulsed:
            late = self._device.lag + DELAY
            self._stepped(late * max(abs(value), abs(self._input)))
            self._input = value
        elif self._way is not None:
            self._way.given += self._gain * value
            self._way.gone += abs(self._gain * value)
            self._stepped(abs(value))

    def reported(self, t: float, value: float) -> None:
        """Note a report at t (s)."""
        self._passed(t)
        last, self._last = self._last, (t, value)
        if self._way is None or last is None:
            self._begin_way(t, value)
        elif not self._traits.total:
            self._way.counted += 0.5 * (value + last[1]) * (t - last[0])
        self.deviation = self._beyond(value) or self._compared(t, value) or self.deviation

    def _begin_way(self, t: float, value: float) -> None:
        self._way = _Way(t, value if self._traits.total else 0.0)
        if not self._traits.pulsed:
            self._stepped((self._device.lag + DELAY) * abs(self._input))

    def _stepped(self, late: float) -> None:
        if self._way is not None:
            self._way.step = max(self._way.step, self._gain * late)

    def _passed(self, t: float) -> None:
        """Count the input that lasts in, up to t (s)."""
        if self._way is not None and not self._traits.pulsed:
            taken = max(t - max(self._since, self._way.t), 0.0)
            self._way.given += self._gain * self._input * taken
            self._way.gone += abs(self._gain * self._input) * taken
        self._since = max(self._since, t)

    def _compared(self, t: float, value: float) -> Reason | None:
        way = self._way
        if way is None:
            return None
        counted = value - way.counted if self._traits.total else way.counted
        off = abs(counted - way.given)
        limit = greatest_input(self._device)
        alone = self._gain * limit * ALONE if limit < float("inf") else float("inf")
        enough = way.gone >= max(LATE * way.step, SCATTER * self._noise) and way.gone > 0.0
        way.saturated |= self._traits.total and abs(value) > NEAR * self._most
        wrong = off > SHARE * way.gone + (0.0 if enough else alone) and not way.saturated
        if enough or t - way.t > LONGEST:
            self._begin_way(t, value)
        if not wrong:
            return None
        numbers = {"counted": counted, "wanted": way.given, "seconds": t - way.t}
        about = (
            self._device.name,
            self._traits.counted_unit + ("" if self._traits.total else " s"),
        )
        return Reason(Interlock.NOT_FOLLOWING, about, numbers)

    def _beyond(self, value: float) -> Reason | None:
        """Return what is beyond what the device can be."""
        if abs(value) <= BEYOND * self._most + SCATTER * self._noise:
            return None
        about = (self._device.name, self._traits.counted_unit)
        numbers = {"at": value, "limit": self._most}
        return Reason(Interlock.DEVICE_LIMIT, about, numbers)
