"""What drivers have in common: a count of messages; those of sensors also what they ask for."""

from abc import abstractmethod
from collections.abc import Mapping, Sequence

from equipoise.hardware.transport.requests import AGAIN, Requests
from equipoise.model.reading import Counts, Reading, Rowless
from equipoise.model.reasons.reason import Code, Reason


class Tally:
    """Counts that grow; see ``model.reading.Counts`` for what each means."""

    def __init__(self) -> None:
        self.counts = Counts()  # since the port was opened

    def count(self, good: int = 0, corrupt: int = 0, foreign: int = 0) -> None:
        """Count messages: understood, broken, or whole and of no use."""
        now = self.counts
        self.counts = Counts(now.good + good, now.corrupt + corrupt, now.foreign + foreign)


class SensorDriver(Tally):
    """The conversation with one sensor, and what it is asked for after the port is opened.

    ``spoken`` says how each request is sent, by its name for people.
    """

    def __init__(
        self,
        spoken: Mapping[str, bytes] | None = None,
        again: float = AGAIN,
        one_by_one: bool = False,
    ) -> None:
        super().__init__()
        self._spoken = dict(spoken or {})
        self.requests = Requests(self._spoken, again, one_by_one)
        self.rowless: dict[Code, Rowless] = {}  # messages without a row, since the port was opened

    def opened(self) -> None:
        """Restart: the port has just been opened, half a message of before is void."""
        self.counts, self.rowless = Counts(), {}
        self.requests.begin()

    @abstractmethod
    def feed(self, data: bytes) -> Sequence[Reading]:
        """Return the rows that are complete with these bytes (for UDP: this datagram)."""

    def due(self, t: float) -> bytes:
        """Return what to send now: requests, a heartbeat; asked at every turn."""
        return b"".join(self._spoken[name] for name in self.requests.due(t))

    def count(self, good: int = 0, corrupt: int = 0, foreign: int = 0) -> None:
        """Count messages; one that is whole is a sign of life."""
        super().count(good, corrupt, foreign)
        if good or foreign:
            self.requests.alive()

    def counted(self, readings: list[Reading] | None) -> list[Reading]:
        """Count a message by its rows and return them; no row: it is broken, None: of no use."""
        self.count(good=bool(readings), corrupt=readings == [], foreign=readings is None)
        return readings or []

    def without_row(self, reason: Reason) -> list[Reading]:
        """Count a message that is whole and gives no row, with its reason; return no row."""
        before = self.rowless.get(reason.code)
        self.rowless[reason.code] = Rowless(reason, 1 if before is None else before.count + 1)
        return self.counted(None)
