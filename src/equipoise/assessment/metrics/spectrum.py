"""The amplitude spectrum of roll and pitch, with gaps or without.

    A(f) = 2/N |sum_k (s_k - s_mean) e^(-2 pi i f t_k)|            even rows: FFT
    A(f)  by least squares of a sine, a cosine and a constant      otherwise: Lomb and Scargle

The two signals are the components of the vertical across ``up``, so that a swing about either axis
shows in one of them. A record of T seconds resolves 1/T: two swings nearer than that are one peak.

Cannot distinguish a swing from anything else that repeats; that is ``swing_modes``' part.
"""

from dataclasses import dataclass

import numpy as np
import scipy

from equipoise.model.arrays import Floats, Series, Series1

FINER = 8  # chosen: points per resolution width, so that no peak falls between two
HIGHEST = 2.0  # Hz, chosen: no platform swings faster
EVEN = 0.05  # of a period, chosen: rows off an even grid by less are even
ROWS = 3000  # chosen: of more, means of neighbours say the same of swings


@dataclass(frozen=True, slots=True, eq=False)
class Spectrum:
    """Amplitudes of roll and pitch."""

    frequency: Series1  # Hz
    amplitude: Series  # (n, 2), in the signals' unit
    resolution: float  # Hz


def is_even(t: Series1) -> bool:
    """Say whether rows follow one another at one period, without gaps."""
    period = float(t[-1] - t[0]) / (len(t) - 1)
    off: Series1 = t - t[0] - period * np.arange(len(t))
    return bool(np.abs(off).max() < EVEN * period)


def decimated(t: Series1, s: Series) -> tuple[Floats, Floats]:
    """Return means of so many neighbours that about ROWS are left."""
    group = max(len(t) // ROWS, 1)
    n = len(t) // group
    at = t[: n * group].reshape(n, group).mean(axis=1)
    return at, s[: n * group].reshape(n, group, s.shape[1]).mean(axis=1)


def spectrum(t: Series1, s: Series) -> Spectrum:
    """Return the spectrum of signals (n, 2) at times t (s)."""
    t, s = decimated(t, s)
    length, centred = float(t[-1] - t[0]), s - s.mean(axis=0)
    highest = min(HIGHEST, 0.5 * (len(t) - 1) / length)
    if is_even(t):
        size = FINER * len(t)
        frequency = np.arange(size // 2 + 1.0) * ((len(t) - 1) / (length * size))
        amplitude = 2.0 / len(t) * np.abs(np.fft.rfft(centred, size, axis=0))
        keep = (frequency > 0) & (frequency <= highest)
        return Spectrum(frequency[keep], amplitude[keep], 1 / length)
    # Of less than a period sine and constant are nearly one, and their amplitudes run away.
    frequency = np.arange(float(FINER), int(highest * length * FINER) + 1) / (length * FINER)
    by_least_squares = [
        scipy.signal.lombscargle(
            t, column, 2 * np.pi * frequency, floating_mean=True, normalize="amplitude"
        )
        for column in s.T
    ]
    return Spectrum(frequency, np.abs(np.column_stack(by_least_squares)), 1 / length)


def highest_peak(found: Spectrum) -> tuple[float, float]:
    """Return frequency (Hz) and amplitude, both signals together, of the highest peak."""
    together: Floats = np.linalg.norm(found.amplitude, axis=1)
    k = int(np.argmax(together))
    return float(found.frequency[k]), float(together[k])
