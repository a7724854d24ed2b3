"""The hands of a person, as far as they are filed: recordings made, weights placed."""

from collections.abc import Sequence

from equipoise.model.arrays import Ints
from equipoise.model.hands import Awaited
from equipoise.model.recording import Recording
from equipoise.model.testbed import Testbed


class FiledHands:
    """The verbs of ``model.hands.Hands``, played back; a placing not filed yet is the one asked."""

    def __init__(
        self, testbed: Testbed, recordings: Sequence[Recording], placed: Sequence[Ints | None]
    ) -> None:
        self._testbed, self._recordings, self._filed = testbed, recordings, placed
        self.placed: list[Ints] = []
        self.swings = 0

    @property
    def testbed(self) -> Testbed:
        """What is known of it beforehand, without any weights."""
        return self._testbed

    @property
    def time(self) -> float:
        """Time recorded so far, s."""
        spans = [recording.span for recording in self._recordings[: self.swings]]
        return sum(end - start for start, end in spans)

    def swing(self) -> Recording:
        """Return the next recording."""
        if self.swings == len(self._recordings):
            raise Awaited
        self.swings += 1
        return self._recordings[self.swings - 1]

    def place(self, wanted: Ints) -> Ints:
        """Return how the platform was loaded after the last recording."""
        filed = self._filed[len(self.placed)] if len(self.placed) < len(self._filed) else None
        self.placed.append(wanted if filed is None else filed)
        return self.placed[-1]
