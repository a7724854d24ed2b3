"""A bench that stands before another one and passes on what it does not do itself; a memory."""

import math
from collections.abc import Mapping

from equipoise.model.bench import Bench
from equipoise.model.errors import BenchStopped
from equipoise.model.recording import Recording, joined
from equipoise.model.testbed import Testbed


class OuterBench:
    """All verbs but reading (see ``model.bench.Bench``), as the inner bench does them."""

    def __init__(self, bench: Bench) -> None:
        self._bench = bench

    @property
    def testbed(self) -> Testbed:
        """What is known of it a priori."""
        return self._bench.testbed

    @property
    def time(self) -> float:
        """Bench time, s."""
        return self._bench.time

    def move(self, targets: Mapping[str, float], speed: float = math.inf) -> None:
        """Set masses on their way (m), no faster than ``speed`` (m/s)."""
        self._bench.move(targets, speed)

    def drive(self, inputs: Mapping[str, float]) -> None:
        """Give devices their inputs."""
        self._bench.drive(inputs)

    def stop(self) -> None:
        """Halt every mass and device."""
        self._bench.stop()


class RecordedBench(OuterBench):
    """A bench of which every row is kept, whatever a procedure passes on."""

    def __init__(self, bench: Bench) -> None:
        super().__init__(bench)
        self._parts: list[Recording] = []

    def read(self, duration: float) -> Recording:
        """Read and keep, also what arrived before the bench was stopped."""
        try:
            self._parts.append(self._bench.read(duration))
        except BenchStopped:
            self._parts.append(self._bench.read(0.0))
            raise
        return self._parts[-1]

    def recording(self) -> Recording | None:
        """Return all that was read, as one; None if nothing was."""
        return joined(self._parts) if self._parts else None
