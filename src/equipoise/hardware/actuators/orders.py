"""Numbered orders to a device, one under way at a time, repeated until the device has taken it.

Its reports say which number it took last. An order that is repeated bears the same number, and a
device does nothing for a number that it knows: so a pulse is given once, whatever the line loses.
"""

from collections import deque
from collections.abc import Mapping
from dataclasses import dataclass, field

from equipoise.hardware.actuators.checked_lines import checked, listed
from equipoise.hardware.transport.attended_time import AttendedTime

AGAIN = 0.1  # s, chosen: between two sendings of the same; a fifth of what the deadman allows


@dataclass(frozen=True, slots=True)
class Order:
    """Something that a device is to take; without inputs: to begin to work."""

    inputs: Mapping[str, float] = field(default_factory=dict[str, float])


class Orders:
    """What waits to be sent, and what is under way."""

    def __init__(self, names: tuple[str, ...], clock: AttendedTime) -> None:
        """Take the devices in the order of the outputs."""
        self._names, self._clock = names, clock
        self._waiting: deque[Order] = deque()
        self._number, self._next, self._since = 0, float("-inf"), 0.0
        self.pending: Order | None = None

    def put(self, order: Order) -> None:
        """Send this after what waits already."""
        self._waiting.append(order)

    def clear(self) -> None:
        """Send nothing of this any more."""
        self._waiting.clear()
        self.pending = None

    def taken(self, number: int) -> Order | None:
        """Note which number a device took last; return the order that is taken with it."""
        if self.pending is None or number != self._number:
            return None
        done, self.pending = self.pending, None
        return done

    def due(self, t: float) -> bytes:
        """Return the order under way if it is time to send it."""
        if self.pending is None:
            if not self._waiting:
                return b""
            self.pending, self._since = self._waiting.popleft(), self._clock.now
            self._number, self._next = self._number + 1, t
        if t < self._next:
            return b""
        self._next = t + AGAIN
        return self._line(self.pending)

    @property
    def waited(self) -> float:
        """How long the order under way has waited to be taken, s, attended."""
        return 0.0 if self.pending is None else self._clock.now - self._since

    def _line(self, order: Order) -> bytes:
        if not order.inputs:
            return checked(f'{{"arm":{self._number}}}')
        inputs = listed([order.inputs.get(name) for name in self._names])
        return checked(f'{{"set":{self._number},"u":[{inputs}]}}')
