"""A count of what a driver has understood."""

from dataclasses import replace

from equipoise.model.reading import Counts


class Tally:
    """Counts that grow; see ``model.reading.Counts`` for what each means."""

    def __init__(self) -> None:
        self.counts = Counts()

    def cleared(self) -> None:
        """Begin anew."""
        self.counts = Counts()

    def good(self) -> None:
        """Count a message that was understood."""
        self.counts = replace(self.counts, good=self.counts.good + 1)

    def corrupt(self) -> None:
        """Count a broken one."""
        self.counts = replace(self.counts, corrupt=self.counts.corrupt + 1)

    def foreign(self) -> None:
        """Count one that is whole, and of no use."""
        self.counts = replace(self.counts, foreign=self.counts.foreign + 1)
