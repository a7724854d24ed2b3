"""A bench of which every row is kept, whatever a procedure passes on."""

from collections.abc import Mapping

from equipoise.model.bench import Bench
from equipoise.model.errors import BenchStopped
from equipoise.model.recording import Recording, joined
from equipoise.model.testbed import Testbed


class RecordedBench:
    """The same four verbs (see ``model.bench.Bench``), and a memory."""

    def __init__(self, bench: Bench) -> None:
        self._bench = bench
        self._parts: list[Recording] = []

    @property
    def testbed(self) -> Testbed:
        """What is known of it beforehand."""
        return self._bench.testbed

    @property
    def time(self) -> float:
        """Bench time, s."""
        return self._bench.time

    def read(self, duration: float) -> Recording:
        """Read and remember, also what was heard before the bench was stopped."""
        try:
            self._parts.append(self._bench.read(duration))
        except BenchStopped:
            self._parts.append(self._bench.read(0.0))
            raise
        return self._parts[-1]

    def move(self, targets: Mapping[str, float]) -> None:
        """Set masses on their way (m)."""
        self._bench.move(targets)

    def drive(self, inputs: Mapping[str, float]) -> None:
        """Give devices their inputs."""
        self._bench.drive(inputs)

    def stop(self) -> None:
        """Halt every mass and device."""
        self._bench.stop()

    def recording(self) -> Recording | None:
        """Return all that was read, as one; None if nothing was."""
        return joined(self._parts) if self._parts else None
