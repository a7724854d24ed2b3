"""The portmanteau test: a sum worked by hand, white noise let pass, neighbours alike rejected."""

import numpy as np
import pytest
from scipy.signal import lfilter
from scipy.stats import chi2, kstest

from equipoise.maths.whiteness import BANDS, FEWEST, LAGS, portmanteau, spectral_peak


def test_by_hand():
    """40 rows of +1, -1, ...: rho_k = (-1)^k (40 - k) / 40, so Q = 42 / 40 sum (40 - k) = 362.25.

    Ten lags: sum (40 - k) = 400 - 55 = 345. Ten degrees of freedom.
    """
    series = np.tile([1.0, -1.0], 20)[:, None]
    assert portmanteau(series) == pytest.approx(chi2.sf(362.25, 10), rel=1e-9)


def test_columns_add_up():
    """Two columns alike: twice the sum, twice the degrees of freedom. A mean does not count."""
    series = np.zeros((40, 2))
    series[5:8] = 1.0  # mean 0.075, power 3 - 9 / 40
    p = 3 / 40
    x = series[:, 0] - p
    rho = [x[k:] @ x[:-k] / (3 - 9 / 40) for k in range(1, 11)]
    total = 40 * 42 * sum(r**2 / (40 - k) for k, r in enumerate(rho, 1))
    assert portmanteau(series + [3.0, -7.0]) == pytest.approx(chi2.sf(2 * total, 20), rel=1e-9)


def test_too_few_rows_say_nothing():
    """One row fewer than are asked for: even a series that is plainly not white passes."""
    series = np.tile([1.0, -1.0], FEWEST)[:, None]
    assert portmanteau(series[: FEWEST - 1]) == 1.0
    assert portmanteau(series[:FEWEST]) < 1e-6


def test_a_column_of_zeros_does_not_matter():
    """It adds degrees of freedom, no number that is none."""
    assert np.isfinite(portmanteau(np.zeros((100, 3))))


def test_white_noise_gives_an_even_probability():
    """400 series of 500 rows: Kolmogorov and Smirnov find nothing at 1 %."""
    rng = np.random.default_rng(1)
    values = [portmanteau(rng.normal(scale=[1, 5, 0.1], size=(500, 3))) for _ in range(400)]
    assert kstest(values, "uniform").pvalue > 0.01


def test_autocorrelation_is_detected():
    """x_k = 0.3 x_(k-1) + e: of 500 rows every one of 50 series is rejected at 1e-4.

    Q is about 500 rho^2 (1 + rho^2) = 49 for each of three columns, on thirty degrees of freedom.
    """
    rng = np.random.default_rng(2)
    values = [
        portmanteau(lfilter([1], [1, -0.3], rng.normal(size=(500, 3)), axis=0)) for _ in range(50)
    ]
    assert max(values) < 1e-4


def test_autocorrelation_is_detected_up_to_the_largest_lag():
    """An echo after ``LAGS`` rows shows, one a row later is not."""
    rng = np.random.default_rng(3)
    noise = rng.normal(size=(2000, 1))
    near, beyond = (portmanteau(noise[lag:] + 0.4 * noise[:-lag]) for lag in (LAGS, LAGS + 1))
    assert near < 1e-9
    assert beyond > 1e-3


def test_peak_of_a_wave_in_noise_by_hand():
    """A wave of amplitude a fills one bin with n a^2 / 4 over a band; noise, every bin with 1."""
    rng, n, amplitude = np.random.default_rng(5), 3000, 0.5
    wave = amplitude * np.sin(2 * np.pi * 400 * np.arange(n) / n)
    series = rng.normal(size=(n, 3)) + wave[:, None]
    expected = (1 + n * amplitude**2 / 4 / (n / 2 / BANDS)) / (1 + amplitude**2 / 2)
    assert spectral_peak(series) == pytest.approx(expected, rel=0.15)


def test_peak_of_an_autoregression():
    """(1 - r^2) / (1 - r)^2 at frequency zero; smoothed over a band, the peak is a bit lower."""
    rng = np.random.default_rng(6)
    series = lfilter([1], [1, -0.6], rng.normal(size=(20000, 3)), axis=0)
    assert 3.6 < spectral_peak(series) < 4.4


def test_white_noise_has_no_peak():
    rng = np.random.default_rng(7)
    assert spectral_peak(rng.normal(size=(500, 3))) == 1.0
    assert spectral_peak(np.zeros((0, 3))) == 1.0


def test_no_parameter_errs_by_more_than_the_root_of_the_peak():
    """Slope, wave and mean fitted by least squares to correlated errors, 2000 draws."""
    rng, n = np.random.default_rng(8), 300
    t = np.arange(n)
    H = np.column_stack([np.ones(n), t / n, np.sin(0.1 * t), np.cos(2.0 * t)])
    noise = lfilter([1], [1, -0.7], rng.normal(size=(2000, n + 100)), axis=1)[:, 100:]
    noise *= np.sqrt(1 - 0.7**2)
    sd = noise @ np.linalg.pinv(H).T
    ratio = np.std(sd, axis=0) / np.sqrt(np.diag(np.linalg.inv(H.T @ H)))
    peak = (1 - 0.7**2) / (1 - 0.7) ** 2
    assert np.all(ratio < 1.05 * np.sqrt(peak))
    assert ratio[0] > 0.9 * np.sqrt(peak)  # slow parameters meet the bound
