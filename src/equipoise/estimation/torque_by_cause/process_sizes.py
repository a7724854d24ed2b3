"""Size and correlation time of the unmodelled torque, weighed by the record.

No single best is taken:

    weight_j ~ p(rows | s_j, T_j) prior_j,     mean = sum weight_j mean_j,
    variance = sum weight_j (variance_j + (mean_j - mean)^2)

over a grid of sd s and correlation time T. A record that does not show the torque leaves the sizes
open below what it would show; intervals that rest on the likeliest alone, often the least, would
then be too short. No bench is without such a torque, so that none has no share of its own.
"""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from equipoise.estimation.torque_by_cause.by_cause import Impulses, Rows, rows_of
from equipoise.estimation.torque_by_cause.gauss_markov import (
    Chain,
    Course,
    Process,
    improbability,
    smoothed,
)
from equipoise.model.arrays import Floats

SIZES = 10.0 ** (np.arange(-30, -13) / 4)  # N m, chosen: 3e-8 to 3e-4, a quarter decade each
CORRELATIONS = (2.0, 6.0, 20.0, 60.0, 200.0)  # s, chosen: drafts to slow air supply
DECADES_SD, USUAL = 1.0, 3e-6  # chosen: most benches have 1e-6 to 1e-5 N m
COARSE = 4  # chosen: decades of sd, and two correlation times
COUNTS = 0.01  # chosen: a process of less weight than this, of the greatest, is left out


class Weighed(NamedTuple):
    """A process with its weight, and the course that it gives."""

    process: Process
    weight: float
    course: Course


def prior_share(process: Process) -> float:
    """Return how probable a process is before the record is seen, but for a factor."""
    return float(np.exp(-0.5 * (np.log10(process.sd / USUAL) / DECADES_SD) ** 2))


def grid(skip: int = 1) -> list[Process]:
    """Return the processes among which a record weighs, or every so many of sizes and times."""
    return [Process(float(s), T) for s in SIZES[::skip] for T in CORRELATIONS[::skip]]


def least_improbability(chain: Chain) -> float:
    """Return -2 ln of how probable the rows are with the torque that suits them best."""
    return min(improbability(chain, process) for process in grid(COARSE))


def weighed(chains: Sequence[Chain], coarsely: bool = False) -> tuple[Weighed, ...]:
    """Return the processes that the record leaves, with their courses; weights sum to 1.

    Chains are models of one record, at the odds that ``term_odds`` gives them.
    """
    trials = [(c, process) for c in chains for process in grid(COARSE if coarsely else 1)]
    improbable = np.array([improbability(chain, process) for chain, process in trials])
    share = np.array([prior_share(process) for _, process in trials])
    share *= np.exp(-0.5 * (improbable - improbable.min()))
    kept = np.flatnonzero(share >= COUNTS * share.max())
    total = float(share[kept].sum())
    return tuple(
        Weighed(process, float(share[k]) / total, smoothed(chain, process))
        for k in kept
        for chain, process in (trials[k],)
    )


def mean_course(found: Sequence[Weighed]) -> Floats:
    """Return the mean deviations (K, n)."""
    return np.array(sum(each.weight * each.course.mean for each in found))


def mixed(found: Sequence[Weighed], impulses: Impulses, interval: float) -> Rows:
    """Return rows with the mean and the variance of the mixture."""
    rows = [rows_of(impulses, each.course, interval) for each in found]
    weight = np.array([each.weight for each in found])

    def both(values: Floats, variances: Floats) -> tuple[Floats, Floats]:
        mean = np.tensordot(weight, values, 1)
        return mean, np.tensordot(weight, variances + (values - mean) ** 2, 1)

    torque, variance = both(
        np.array([r.torque for r in rows]), np.array([r.variance for r in rows])
    )
    total, whole = both(np.array([r.total for r in rows]),
                        np.array([r.total_variance for r in rows]))  # fmt: skip
    return Rows(torque, variance, total, whole)
