"""Covariance of a sum of correlated vectors.

    var(sum_k s_k) = sum_|l| < L  v(l / L) sum_k s_k s_(k+l)^T
    v(x) = 1 up to 1/2, then 2 (1 - x)

with Politis and Romano's (1995) flat top, which keeps neighbours' correlations whole: the noise of
differences, which cancels in their sum, comes out small. L is twice the lag from which on the
series is uncorrelated (Politis 2003).

Cannot see correlations that last longer than a quarter of the series.
"""

import numpy as np

from equipoise.maths.linalg import symmetrise
from equipoise.model.arrays import Floats, Series, Square

RUN = 5  # chosen (Politis): so many lags in a row must be uncorrelated
LONGEST = 0.25  # of the series
LEAST = 1e-3  # chosen: of the variance of independent vectors, below which it is not taken


def correlations(series: Series, most: int) -> Floats:
    """Return the correlation at lags 0 ... most, columns pooled by their power."""
    n = len(series)
    centred: Floats = series - series.mean(axis=0)
    size = 2 ** int(np.ceil(np.log2(2 * n)))
    power: Floats = np.sum(np.abs(np.fft.rfft(centred, size, axis=0)) ** 2, axis=1)
    covariance: Floats = np.fft.irfft(power, size)[: most + 1]
    return covariance / max(float(covariance[0]), 1e-300)


def memory(series: Series) -> int:
    """Return the lag from which on a series is uncorrelated, by what chance would show."""
    n = len(series)
    most = max(int(LONGEST * n), 1)
    rho = np.abs(correlations(series, min(most + RUN, n - 1)))
    small = rho < 2 * np.sqrt(np.log10(max(n, 10)) / n)
    for lag in range(1, most):
        if np.all(small[lag : lag + RUN]):
            return lag - 1
    return most


def long_run_covariance(vectors: Floats, lag: int) -> Square:
    """Return the covariance of the sum of vectors (n, k) that are correlated up to ``lag``.

    Directions in which the sum would come out less than ``LEAST`` of what independent vectors would
    give are kept at that.
    """
    total: Square = vectors.T @ vectors
    scale = 1 / np.sqrt(np.maximum(np.diag(total), 1e-300))
    for step in range(1, min(2 * lag, len(vectors) - 1) + 1):
        weight = min(1.0, 2.0 * (1.0 - step / (2 * lag + 1)))
        both = vectors[step:].T @ vectors[:-step]
        total = total + weight * (both + both.T)
    values, turn = np.linalg.eigh(symmetrise(total) * np.outer(scale, scale))
    kept = (turn * np.maximum(values, LEAST)) @ turn.T
    return symmetrise(kept) / np.outer(scale, scale)
