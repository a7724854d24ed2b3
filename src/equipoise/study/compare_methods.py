"""What methods are worth on one testbed, over many records of platforms that it may be.

Every method gets the same records, each of another platform (``method_record``), and is judged by
the truth (``method_run``). Over the runs that ended in a usable estimate:

    bias, sd, RMSE   of each parameter: mean, standard deviation (n - 1), root mean square of e
    RMSE / bound     root mean square of e / bound over the runs and the group's components, each
                     error in units of its own record's bound; com and inertia are a group each
    bias / bound     the same of the means of e / bound over the runs: what averaging does not mend
    coverage         95 % intervals that hold the truth; an estimate that warns of its own intervals
                     states none
    NEES             mean of e^T P^-1 e / n over the same runs; 1 where covariances are true
    confident wrong  runs with an interval that misses by more than 5 sd (``WRONG``) unwarned

Runs that failed are counted and are in no statistic. A method that gives nothing in hard cases is
easily better than its bound in the others: read the failures first.
"""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from equipoise.model.arrays import Floats
from equipoise.model.estimate import COM, NORMAL_95
from equipoise.study.method_families import FAMILY, Family
from equipoise.study.method_record import Scene
from equipoise.study.method_run import JUDGED, Ending, MethodRun, MethodTask, method_runs

WRONG = 5.0  # sd: by chance once in two million
GROUPS = {"com": slice(0, len(COM)), "inertia": slice(len(COM), len(JUDGED))}
Work = Callable[[MethodTask], list[MethodRun]]
Spread = Callable[[Work, Sequence[MethodTask]], Iterator[list[MethodRun]]]


class Share(NamedTuple):
    """How many of how many."""

    part: int
    of: int

    @property
    def value(self) -> float:
        """Return the share, nan of nothing."""
        return self.part / self.of if self.of else np.nan


@dataclass(frozen=True, slots=True)
class Ratios:
    """Errors of a group of parameters in units of the bound; nan where nothing is stated."""

    rmse: float
    bias: float
    stated: Share  # of what the records show, over the runs that did not fail


@dataclass(frozen=True, slots=True, eq=False)
class MethodSummary:
    """A method over many records. Arrays are in the order of ``JUDGED``, SI."""

    method: str
    family: Family
    runs: int
    refused: int
    unusable: int
    broke: int
    why: str  # of the first failure
    warned: int  # usable, with a warning of its own intervals
    bias: Floats
    sd: Floats
    rmse: Floats
    com: Ratios
    inertia: Ratios
    coverage: Share
    trusted: int  # runs whose intervals count in the coverage
    nees: float
    confident_wrong: int
    time: float  # s of the processor, median of the runs that were not refused
    memory: int | None  # bytes, greatest that was measured
    settled: float | None  # s, median; infinite: mostly never; None: it states no course

    @property
    def failed(self) -> int:
        """Return how many runs gave nothing to use."""
        return self.refused + self.unusable + self.broke


@dataclass(frozen=True, slots=True, eq=False)
class MethodComparison:
    """The request, and its results."""

    scene: Scene
    seeds: Sequence[int]
    methods: tuple[MethodSummary, ...]
    runs: tuple[MethodRun, ...]
    bound: Floats  # root mean square over the records, SI; infinite: one does not show it

    @property
    def met_stop(self) -> int:
        """Return in how many records the platform meets its stop."""
        return len({run.seed for run in self.runs if run.met_stop})


def root_mean_square(values: Floats) -> float:
    """Return the root mean square of what is finite, nan of nothing."""
    known = values[np.isfinite(values)]
    return float(np.sqrt(np.mean(known**2))) if len(known) else np.nan


def by_column(values: Floats, what: Callable[[Floats], float], fewest: int = 1) -> Floats:
    """Return a statistic of what is finite in each column, nan of fewer than ``fewest``."""
    columns = [column[np.isfinite(column)] for column in values.T]
    return np.array([what(c) if len(c) >= fewest else np.nan for c in columns])


def mean(values: Floats) -> float:
    """Return the mean."""
    return float(np.mean(values))


def deviation(values: Floats) -> float:
    """Return the standard deviation of a sample."""
    return float(np.std(values, ddof=1))


def ratios(error: Floats, bound: Floats) -> Ratios:
    """Return errors (runs, k) of a group in units of each run's bound (runs, k)."""
    shown = np.isfinite(bound) & (bound > 0)
    e = np.where(shown, error, np.nan) / np.where(shown, bound, 1.0)
    stated = Share(int(np.sum(np.isfinite(e))), int(np.sum(shown)))
    return Ratios(root_mean_square(e), root_mean_square(by_column(e, mean)), stated)


def stack(rows: Sequence[Floats]) -> Floats:
    """Return rows as one array, (0, 9) of none."""
    return np.array(rows).reshape(-1, len(JUDGED))


def summary(runs: Sequence[MethodRun]) -> MethodSummary:
    """Return one method's runs in numbers."""
    done = [run for run in runs if run.ending == "done"]
    estimated = [run for run in done if run.stated]
    error, bound = stack([run.error for run in done]), stack([run.bound for run in done])
    z = stack([run.error / run.sd for run in estimated])
    reported = np.abs(z[np.isfinite(z)])
    failures = [run for run in runs if run.ending != "done"]
    nees = [run.nees for run in estimated if np.isfinite(run.nees)]
    costs = [run.cost for run in runs if run.ending != "refused"]
    weights = [cost.memory for cost in costs if cost.memory is not None]
    courses = [run.settled for run in done if run.settled is not None]
    by_group = {name: ratios(error[:, part], bound[:, part]) for name, part in GROUPS.items()}

    def count(ending: Ending) -> int:
        return sum(run.ending == ending for run in runs)

    return MethodSummary(
        method=runs[0].method,
        family=FAMILY[runs[0].method],
        runs=len(runs),
        refused=count("refused"),
        unusable=count("unusable"),
        broke=count("broke"),
        why=failures[0].why if failures else "",
        warned=sum(run.warned for run in done),
        bias=by_column(error, mean),
        sd=by_column(error, deviation, fewest=2),
        rmse=by_column(error, root_mean_square),
        **by_group,
        coverage=Share(int(np.sum(reported <= NORMAL_95)), len(reported)),
        trusted=len(estimated),
        nees=mean(np.array(nees)) if nees else np.nan,
        confident_wrong=int(np.sum(np.nanmax(np.abs(z), axis=1) > WRONG)) if len(z) else 0,
        time=float(np.median([cost.time for cost in costs])) if costs else np.nan,
        memory=max(weights) if weights else None,
        settled=float(np.median(courses)) if courses else None,
    )


def compared_methods(tasks: Sequence[MethodTask], spread: Spread) -> MethodComparison:
    """Return what the methods of tasks, all of one scene, make of their records."""
    found = [run for runs in spread(method_runs, tasks) for run in runs]
    names = tasks[0].methods
    by_method = [[run for run in found if run.method == name] for name in names]
    bound = stack([run.bound for run in found])
    return MethodComparison(
        scene=tasks[0].scene,
        seeds=[task.seed for task in tasks],
        methods=tuple(summary(runs) for runs in by_method),
        runs=tuple(found),
        bound=np.sqrt(np.mean(bound**2, axis=0)),
    )
