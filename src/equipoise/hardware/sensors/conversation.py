"""What drivers of sensors have in common: a count of messages, and what is sent first."""

from equipoise.hardware.transport.tally import Tally
from equipoise.model.reading import Counts, Reading


class Conversation(Tally):
    """A driver that sends ``greeting`` once after the port is opened, by itself nothing more."""

    def __init__(self, greeting: bytes = b"") -> None:
        super().__init__()
        self._greeting, self._greet = greeting, True

    def opened(self) -> None:
        """Begin anew."""
        self.counts, self._greet = Counts(), True

    def due(self, t: float) -> bytes:
        """Return the greeting, once."""
        greet, self._greet = self._greet, False
        return self._greeting if greet else b""

    def counted(self, readings: list[Reading] | None) -> list[Reading]:
        """Count a message by its rows and return them; no row: it is broken, None: of no use."""
        self.count(good=bool(readings), corrupt=readings == [], foreign=readings is None)
        return readings or []
