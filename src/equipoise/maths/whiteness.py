"""Whether a series is white noise, and what it can do at most if it is not.

The portmanteau test of Ljung and Box (1978):

    Q = n (n + 2) sum_k rho_k^2 / (n - k),    k = 1 ... m;    chi-square of m degrees of freedom

rho_k is the correlation of rows k apart, for each column by itself.

Least squares of Jacobian H that assumes white noise of its rows has in truth the covariance
(H^T H)^-1 H^T S H (H^T H)^-1 for errors of covariance S. That is at most (H^T H)^-1 times the
greatest eigenvalue of S, and those of a stationary series lie below the peak of its spectral
density (Grenander and Szegoe 1958, section 5.2): no parameter errs by more than its root.
"""

import numpy as np

from equipoise.maths.chi_square import chi_square_chance
from equipoise.model.arrays import Floats, Series

LAGS = 10  # chosen: a few rows more than neighbours that share a cause
FEWEST = 30  # rows
WHITE = 1e-3  # probability below which a series is not white, chosen
BINS = 5  # of the periodogram at least, chosen: the mean of three columns is known to a quarter
BANDS = 30  # at most, chosen: among more the greatest by chance is much above the rest


def autocorrelation(residual: Series, lags: int) -> Series:
    """Return rho_k, k = 1 ... lags, a row a lag, of each column by itself; n > lags."""
    centred: Floats = residual - np.mean(residual, axis=0)
    power = np.maximum(np.sum(centred**2, axis=0), 1e-300)
    rho = [np.sum(centred[k:] * centred[:-k], axis=0) / power for k in range(1, lags + 1)]
    return np.array(rho, dtype=np.float64).reshape(lags, residual.shape[1])


def portmanteau(residual: Series) -> float:
    """Return the probability that white noise shows correlations as large; 1 for too few rows."""
    n = len(residual)
    if n < FEWEST:
        return 1.0
    rho = autocorrelation(residual, LAGS)
    left = n - np.arange(1, LAGS + 1)
    Q: Floats = n * (n + 2) * np.sum(rho**2 / left[:, None], axis=0)
    return chi_square_chance(LAGS * Q.size, float(np.sum(Q)))


def spectral_peak(residual: Series) -> float:
    """Return the peak of the spectral density over its mean, at least 1; 1 for white noise.

    Rows count as evenly spaced; the periodogram is smoothed over columns and a band of frequencies,
    so that a line much narrower than a band counts as wide as that.
    """
    if portmanteau(residual) > WHITE:
        return 1.0
    centred: Floats = residual - np.mean(residual, axis=0)
    power: Floats = np.sum(np.abs(np.fft.rfft(centred, axis=0)[1:]) ** 2, axis=1)
    width = max(BINS, len(power) // BANDS)
    smooth: Floats = np.convolve(power, np.full(width, 1 / width), mode="valid")
    return max(float(smooth.max() / power.mean()), 1.0)
