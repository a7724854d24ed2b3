"""A count of what a driver has understood."""

from equipoise.model.reading import Counts


class Tally:
    """Counts that grow; see ``model.reading.Counts`` for what each means."""

    def __init__(self) -> None:
        self.counts = Counts()  # since the port was opened

    def count(self, good: int = 0, corrupt: int = 0, foreign: int = 0) -> None:
        """Count messages: understood, broken, or whole and of no use."""
        now = self.counts
        self.counts = Counts(now.good + good, now.corrupt + corrupt, now.foreign + foreign)
