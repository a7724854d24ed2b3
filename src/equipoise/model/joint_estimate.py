"""What several recordings of one platform say together, and whether they agree."""

from dataclasses import dataclass

from equipoise.model.estimate import Estimate
from equipoise.model.verdict import Verdict


@dataclass(frozen=True, slots=True)
class Deviation:
    """How much a run alone deviates from all runs together."""

    source: str
    chi_square: float  # of what the run shows, in the sd of that difference
    freedom: float  # how many directions that is; 0: it has none in common with another run
    probability: float  # of a deviation as large, were all as stated


@dataclass(frozen=True, slots=True)
class Spread:
    """One parameter over the runs that show it, SI."""

    name: str
    unit: str
    runs: int
    mean: float
    sd_between: float  # of the runs' values
    sd_stated: float  # rms of what the runs state


@dataclass(frozen=True, slots=True)
class RunScatter:
    """The scatter between runs against what their sd lead to expect."""

    chi_square: float
    freedom: float
    probability: float  # of a scatter as large, were all as stated
    deviations: tuple[Deviation, ...]  # by run
    spreads: tuple[Spread, ...]  # by parameter

    @property
    def factor(self) -> float:
        """Return how many times as large as stated the scatter is."""
        return float((self.chi_square / self.freedom) ** 0.5) if self.freedom > 0 else 1.0


@dataclass(frozen=True, slots=True, eq=False)
class JointEstimate:
    """The estimate of all runs together, and the verdict on their scatter."""

    estimate: Estimate
    verdict: Verdict
    scatter: RunScatter | None = None  # None: no joint fit
    used: tuple[bool, ...] = ()  # which of the runs it is made of
