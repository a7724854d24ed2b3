"""What a person sees of a bench while it is only recorded."""

from pathlib import Path

from equipoise.app.live.status_block import TerminalView
from equipoise.model.testbed import Testbed


class RecordingView(TerminalView):
    """The newest numbers, and what share of the record there is, in which file."""

    def __init__(self, testbed: Testbed, file: Path, begin: float, duration: float) -> None:
        super().__init__(testbed)
        self._file, self._begin, self._duration = file, begin, duration

    def lines(self) -> list[list[str]]:
        """Return what is known, in groups: a name, and short texts."""
        share = min(max(self.newest.time - self._begin, 0.0) / self._duration, 1.0)
        done = ["record", f"{share:4.0%} of {self._duration:g} s", self._file.name]
        rows = [f"{name} {number}" for name, number in self.newest.counts.items()]
        return [*super().lines(), done, ["rows", *rows] if rows else []]
