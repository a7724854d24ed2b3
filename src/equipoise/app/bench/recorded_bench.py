"""A bench of which every row is kept, whatever a procedure passes on."""

from equipoise.app.bench.bench_proxy import OuterBench
from equipoise.model.bench import Bench
from equipoise.model.errors import BenchStopped
from equipoise.model.recording import Recording, joined


class RecordedBench(OuterBench):
    """The same bench, and a memory."""

    def __init__(self, bench: Bench) -> None:
        super().__init__(bench)
        self._parts: list[Recording] = []

    def read(self, duration: float) -> Recording:
        """Read and remember, also what was heard before the bench was stopped."""
        try:
            self._parts.append(self._bench.read(duration))
        except BenchStopped:
            self._parts.append(self._bench.read(0.0))
            raise
        return self._parts[-1]

    def recording(self) -> Recording | None:
        """Return all that was read, as one; None if nothing was."""
        return joined(self._parts) if self._parts else None
