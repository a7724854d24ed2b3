"""What a device is asked for, each request sent again until it is confirmed.

A device that had no power when its port was opened, that was still starting, or whose line garbled
the request has not got it. So a request is open until its answer is seen, or its effect; a refusal
is noted and does not close it. Deadlines are on attended time, like those of boards.
"""

from collections.abc import Iterable
from dataclasses import dataclass

from equipoise.hardware.transport.attended_time import AttendedTime

AGAIN = 1.0  # s, chosen: between two sendings; answers take some ms, or 0.5 s by radio
ONCE = float("inf")  # s, instead: for a line that loses nothing, where twice would be two requests
PATIENCE = 1.5  # s, attended, chosen: until an open request is reported, as for boards
QUIET = 3.0  # s, attended, chosen: longer than between rows; then the device may have restarted


@dataclass(frozen=True, slots=True)
class Unconfirmed:
    """A request that is overdue."""

    what: str
    times: int  # that it was sent
    waited: float  # s, attended, since it was sent first
    answer: str = ""  # what was answered instead; empty: nothing

    @property
    def sentence(self) -> str:
        """All of it, for people."""
        often = "once" if self.times == 1 else f"{self.times} times"
        answer = f"; the answer was {self.answer}" if self.answer else ""
        how = f"{often} in {self.waited:.1f} s"
        return f"{self.what} was requested {how} and not confirmed{answer}"


@dataclass(slots=True)
class _Open:
    """An open request so far."""

    times: int = 0
    since: float = 0.0  # s, attended
    answer: str = ""


class Requests:
    """The requests of one device by name; open ones in the order in which they are sent."""

    def __init__(
        self, names: Iterable[str] = (), again: float = AGAIN, one_by_one: bool = False
    ) -> None:
        """Take whether each waits until the one before is confirmed, or was refused."""
        self._names, self._again, self._one_by_one = tuple(names), again, one_by_one
        self.begin()

    def begin(self) -> None:
        """Restart: the port was opened, nothing has been asked."""
        self._clock, self._alive = AttendedTime(), 0.0
        self._open = {name: _Open() for name in self._names}
        self._following = dict.fromkeys(self._names, float("-inf"))  # s, when to send each next

    @property
    def first(self) -> str | None:
        """The open request whose turn it is; None if all are confirmed."""
        return next(iter(self._open), None)

    def due(self, t: float) -> list[str]:
        """Return the names of what to send now; asked at every turn."""
        self._clock.turn(t)
        if self._clock.now - self._alive > QUIET and self._again < ONCE:
            self._alive = self._clock.now
            for name in reversed(self._names):
                self.reopen(name)
        found: list[str] = []
        for name, request in list(self._open.items())[: 1 if self._one_by_one else None]:
            if t >= self._following[name]:
                request.since = request.since if request.times else self._clock.now
                request.times += 1
                self._following[name] = t + self._again
                found.append(name)
        return found

    def alive(self) -> None:
        """Note that the device said something that was understood."""
        self._alive = self._clock.now

    def confirmed(self, name: str) -> None:
        """Note that a request was answered, or its effect seen."""
        self._open.pop(name, None)

    def refused(self, answer: str, name: str | None = None) -> None:
        """Note what was answered to a request instead, or to any that is open; it stays open."""
        for each in list(self._open) if name is None else [name]:
            request = self._open.pop(each, None)
            if request is not None:
                request.answer = answer
                self._open[each] = request  # behind the others

    def reopen(self, name: str) -> None:
        """Note that a request has to be sent anew, before the others: its effect is gone."""
        if name in self._names and name not in self._open:
            self._open = {name: _Open(), **self._open}

    @property
    def overdue(self) -> tuple[Unconfirmed, ...]:
        """What is not confirmed and should be."""
        now = self._clock.now
        return tuple(
            Unconfirmed(name, request.times, now - request.since, request.answer)
            for name, request in self._open.items()
            if request.times and now - request.since > PATIENCE
        )
