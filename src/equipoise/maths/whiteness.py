"""Whether a series is white noise: the portmanteau test of Ljung and Box (1978).

    Q = n (n + 2) sum_k rho_k^2 / (n - k),    k = 1 ... m;    chi-square of m degrees of freedom

rho_k is the correlation of rows k apart, for each column by itself.
"""

import numpy as np
from scipy.stats import chi2

from equipoise.model.arrays import Floats, Series

LAGS = 10  # chosen: a few rows more than neighbours that share a cause
FEWEST = 30  # rows


def portmanteau(residual: Series) -> float:
    """Return the probability that white noise shows correlations as large; 1 for too few rows."""
    n = len(residual)
    if n < FEWEST:
        return 1.0
    centred: Floats = residual - np.mean(residual, axis=0)
    power = np.maximum(np.sum(centred**2, axis=0), 1e-300)
    rho: list[Floats] = [
        np.sum(centred[k:] * centred[:-k], axis=0) / power for k in range(1, LAGS + 1)
    ]
    left = n - np.arange(1, LAGS + 1)
    Q: Floats = n * (n + 2) * np.sum(np.array(rho) ** 2 / left[:, None], axis=0)
    return float(chi2.sf(float(np.sum(Q)), LAGS * Q.size))
