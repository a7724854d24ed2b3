"""A bench whose rows an onlooker gets soon after they arrive, also within a long reading."""

from collections.abc import Callable

from equipoise.app.bench.bench_proxy import OuterBench
from equipoise.app.bench.lost_onlookers import complain_of
from equipoise.hardware.bench.onlookers import Onlookers
from equipoise.model.bench import Bench
from equipoise.model.bench_requests import check_duration
from equipoise.model.recording import Recording, joined

Onlooker = Callable[[Recording], None]
ROUNDING = 1e-6  # s, chosen: a clock of whole nanoseconds may end a reading so much early


class WatchedBench(OuterBench):
    """The same bench, its readings cut into slices for an onlooker.

    A reading is made of slices of ``slice_s`` seconds; ``inf``: of one. ``between`` is called
    before each slice and may raise to stop. After each, ``guard`` gets the rows first: what it
    raises stops the reading. Then ``onlooker`` gets them. One that fails is reported and dropped:
    observation does not stop a bench, and no guard depends on it.

    What was read before something raised within a reading is given by the next one. A real bench's
    slice lasts until some sensor has given a row, so that a reading may end so much later. A
    simulated bench reports where masses are at both ends of a reading: slices add such rows.
    """

    def __init__(
        self,
        bench: Bench,
        onlooker: Onlooker,
        slice_s: float,
        between: Callable[[], None] | None = None,
        guard: Onlooker | None = None,
    ) -> None:
        super().__init__(bench)
        self._slice, self._between, self._guard = slice_s, between, guard
        self._onlookers = Onlookers[Onlooker](complain_of)
        self._onlookers.add("the view of the bench", onlooker)
        self._unclaimed: list[Recording] = []

    def read(self, duration: float) -> Recording:
        """Read slice by slice, and return all of it."""
        check_duration(duration)
        end = self.time + duration
        self._read_slice(min(self._slice, duration))
        while (rest := end - self.time) > ROUNDING:
            self._read_slice(min(self._slice, rest))
        whole = joined(self._unclaimed)
        self._unclaimed = []
        return whole

    def _read_slice(self, duration: float) -> None:
        if self._between is not None:
            self._between()
        rows = self._bench.read(duration)
        self._unclaimed.append(rows)
        if self._guard is not None:
            self._guard(rows)
        self._onlookers.hand_on(lambda onlooker: onlooker(rows))
