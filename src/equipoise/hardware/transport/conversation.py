"""What drivers have in common: a count of messages; those of sensors also what is sent first."""

from abc import abstractmethod
from collections.abc import Sequence

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
    """The conversation with one sensor; ``greeting`` is sent once after the port is opened."""

    def __init__(self, greeting: bytes = b"") -> None:
        super().__init__()
        self._greeting, self._greet = greeting, True
        self.rowless: dict[Code, Rowless] = {}  # messages without a row, since the port was opened

    def opened(self) -> None:
        """Begin anew: the port has just been opened, half a message of before is void."""
        self.counts, self.rowless, self._greet = Counts(), {}, True

    @abstractmethod
    def feed(self, data: bytes) -> Sequence[Reading]:
        """Return the rows that are complete with these bytes (for UDP: this datagram)."""

    def due(self, t: float) -> bytes:
        """Return what to send now: a greeting, a request, a heartbeat; asked at every turn."""
        greet, self._greet = self._greet, False
        return self._greeting if greet else b""

    def counted(self, readings: list[Reading] | None) -> list[Reading]:
        """Count a message by its rows and return them; no row: it is broken, None: of no use."""
        self.count(good=bool(readings), corrupt=readings == [], foreign=readings is None)
        return readings or []

    def without_row(self, reason: Reason) -> list[Reading]:
        """Count a message that is whole and gives no row, with its reason; return no row."""
        before = self.rowless.get(reason.code)
        self.rowless[reason.code] = Rowless(reason, 1 if before is None else before.count + 1)
        return self.counted(None)
