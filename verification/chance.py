"""What chance alone does to a statistic of so many seeds.

A claim holds as stated when it is measured with the seeds it was stated for (``FULL``). With fewer
seeds chance is larger, and the band is the wider of the claim's and the one that a sound estimator
leaves once in a thousand runs. Bands follow from the chi-square and binomial distributions.
"""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray
from scipy.stats import binom, chi2

from equipoise.model.estimate import NORMAL_95

FULL = 200  # seeds for which the claims are stated
RARE = 1e-3  # how often a sound estimator may leave a widened band
DRAWS = 4000  # of whole runs, to find the band of correlated ratios

Array = NDArray[np.float64]


def nees_band(size: int, seeds: int, share: float = 0.95) -> tuple[float, float]:
    """Return the band of the mean of ``seeds`` chi-squares of ``size`` degrees of freedom."""
    tail = (1 - share) / 2
    low, high = chi2.ppf([tail, 1 - tail], size * seeds) / seeds
    return float(low), float(high)


def ratio_limits(covariance: Array, seeds: int) -> tuple[float, float]:
    """Return what mean and greatest ratio of RMSE to bound stay below but once in a thousand runs,
    for an estimator at the bound whose errors have this covariance."""
    sd = np.sqrt(np.diag(covariance))
    root = np.linalg.cholesky(covariance / np.outer(sd, sd) + 1e-12 * np.eye(len(sd)))
    rng = np.random.default_rng(0)
    ratios = np.empty((DRAWS, len(sd)))
    for k in range(DRAWS):
        ratios[k] = np.sqrt(np.mean((rng.normal(size=(seeds, len(sd))) @ root.T) ** 2, axis=0))
    mean, greatest = ratios.mean(axis=1), ratios.max(axis=1)
    return float(np.quantile(mean, 1 - RARE)), float(np.quantile(greatest, 1 - RARE))


def mean_square_band(correlations: Sequence[Array]) -> tuple[float, float]:
    """Return the band of the mean square of groups of unit errors, each group correlated so."""
    rng = np.random.default_rng(0)
    total, count = np.zeros(DRAWS), 0
    for correlation in correlations:
        root = np.linalg.cholesky(correlation + 1e-9 * np.eye(len(correlation)))
        total += np.sum((rng.normal(size=(DRAWS, len(root))) @ root.T) ** 2, axis=1)
        count += len(root)
    low, high = np.quantile(total / count, [RARE / 2, 1 - RARE / 2])
    return float(low), float(high)


def share_band(
    wanted: tuple[float, float], true: float, seeds: int, among: int = 1
) -> tuple[float, float]:
    """Return the band of a share of ``seeds`` runs: the wanted one, or with fewer seeds than
    ``FULL`` the wider binomial one for the worst among so many shares."""
    if seeds >= FULL:
        return wanted
    low, high = binomial_band(true, seeds, among)
    return min(low, wanted[0]), max(high, wanted[1])


def binomial_band(true: float, seeds: int, among: int = 1) -> tuple[float, float]:
    """Return the band that the worst among so many shares of ``seeds`` runs leaves rarely."""
    tail = RARE / 2 / among
    low, high = binom.ppf([tail, 1 - tail], seeds, true) / seeds
    return float(low), float(high)


def leaving(band: tuple[float, float], covariances: Sequence[Array], seeds: int) -> float:
    """Return how often perfect 95 % intervals, for errors correlated as these, hold the truth in a
    share of ``seeds`` runs outside the band for at least one parameter."""
    rng, left = np.random.default_rng(0), 0
    roots = []
    for covariance in covariances:
        sd = np.sqrt(np.diag(covariance))
        roots.append(np.linalg.cholesky(covariance / np.outer(sd, sd) + 1e-9 * np.eye(len(sd))))
    for k in range(DRAWS // 2):
        root = roots[k % len(roots)]
        inside = np.abs(rng.normal(size=(seeds, len(root))) @ root.T) < NORMAL_95
        share = inside.mean(axis=0)
        left += bool(np.any((share < band[0]) | (share > band[1])))
    return left / (DRAWS // 2)


def fewest(share: float, seeds: int) -> float:
    """Return the least share of successes that still agrees with a true ``share``."""
    return share if seeds >= FULL else float(binom.ppf(RARE, seeds, share) / seeds)
