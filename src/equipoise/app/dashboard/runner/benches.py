"""The benches that the page can show: simulated, replayed, real."""

from collections.abc import Callable, Generator
from contextlib import contextmanager
from dataclasses import dataclass
from typing import Literal

import numpy as np

from equipoise.app.bench.open_bench import HAND, Wanted, real_bench
from equipoise.hardware.bench.real_bench import RealBench
from equipoise.hardware.bench.replayed_bench import ReplayedBench
from equipoise.model.bench import Bench
from equipoise.model.recording import Recording, rows_between
from equipoise.model.testbed import Testbed
from equipoise.simulation.bench import SimulatedBench

Kind = Literal["simulated", "replayed", "real"]
LEAST = 0.5  # s, chosen: of a recording that is left to be shown
BEFORE = 60.0  # s, chosen: of a recording, shown at once in front of the time that was gone to


@dataclass(frozen=True, slots=True, eq=False)
class Station:
    """A bench and what kind it is. ``before``: rows recorded before it began."""

    kind: Kind
    bench: Bench
    title: str
    before: Recording | None = None
    span: tuple[float, float] | None = None  # s, of a recording
    source: Recording | None = None  # the whole of it
    seed: int | None = None

    @property
    def testbed(self) -> Testbed:
        """The testbed as stated."""
        return self.bench.testbed

    @property
    def paced(self) -> bool:
        """Say whether its time is ours to pass."""
        return self.kind != "real"


def simulated(testbed: Testbed, seed: int) -> Station:
    """Return a simulated platform, held at time zero."""
    title = f"{testbed.name}, simulated, seed {seed}"
    return Station("simulated", SimulatedBench(testbed, seed), title, seed=seed)


def replayed(testbed: Testbed, recording: Recording, title: str, t: float | None = None) -> Station:
    """Return a recording from its beginning, or from a time (s) with the minute before it."""
    first, last = recording.span
    begin = first if t is None else float(np.clip(t, first, last - LEAST))
    if begin == first:
        before, rest = None, recording
    else:
        before = rows_between(recording, begin - BEFORE, begin)
        rest = rows_between(recording, begin, last)
    bench = ReplayedBench(testbed, rest)
    return Station("replayed", bench, title, before, (first, last), recording)


@contextmanager
def real(testbed: Testbed) -> Generator[Station]:
    """Lend the real bench: every sensor gives rows, masses stay where they are."""
    with real_bench(Wanted(testbed, None)) as bench:
        yield Station("real", bench, f"{testbed.name}, real")


def let_go(bench: RealBench, report: Callable[[str], None]) -> None:
    """Bring the masses home, say that the platform is to be let go, and wait for the hand."""
    report("The masses move home: hold the platform.")
    bench.start()
    report("Masses are at home: release the platform.")
    bench.read(HAND)
    bench.watch()
