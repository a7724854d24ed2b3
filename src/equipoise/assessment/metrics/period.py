"""Periods of swing, by least squares of decaying sines through roll and pitch.

    s(t) = c0 + c1 t + sum_k e^(-d_k t) (a_k cos 2 pi f_k t + b_k sin 2 pi f_k t),   k <= 2

f and d are the same in both signals, the rest is solved for at every step (variable projection;
Golub and Pereyra 1973). The sd of f is that of least squares, with rows that err together counted
by the residual's own spectrum. A swing of amplitude a is slower than a small one:

    f_small = f (1 + a^2 / 16)

Half of that goes into the sd. A swing of amplitude b about the other axis bends this one, between
-b^2 / 16 (in one plane) and 5 b^2 / 16 (round a cone: f = f_small / sqrt(cos a)): 3 b^2 / 16 more.

Cannot see a swing of which less than one period was recorded.
"""

from dataclasses import dataclass

import numpy as np
from scipy.optimize import least_squares
from scipy.stats import f as fisher

from equipoise.assessment.metrics.spectrum import decimated, highest_peak, spectrum
from equipoise.maths.whiteness import spectral_peak
from equipoise.model.arrays import Floats, Series, Series1

MOST = 2  # swings of a platform
CHANCE = 1e-4  # chosen: of a swing that noise alone would show
LEAST_TURNS = 1.0  # periods in the record
WORTH = 0.02  # of the first swing's amplitude, chosen: a smaller second one is its distortion


@dataclass(frozen=True, slots=True)
class Swing:
    """One swing; frequencies are those of a small one."""

    frequency: float  # Hz
    sd: float  # Hz
    amplitude: float  # of the signals, both together
    decay: float  # 1/s
    direction: tuple[float, float]  # in which the two signals swing, unit vector


def swings(t: Series1, s: Series) -> tuple[Swing, ...]:
    """Return the swings in signals (n, 2), small angles in rad, at times t (s); slow one first."""
    t, s = decimated(t, s)
    t = t - t[0]
    found = np.zeros(0)
    left = remains(t, s, found)
    before = float(np.sum(left**2))
    for k in range(MOST):
        peak, _ = highest_peak(spectrum(t, left))
        trial = settled(t, s, np.array([*found, max(peak, LEAST_TURNS / t[-1]), 0.0]))
        left = remains(t, s, trial)
        after = float(np.sum(left**2))
        if not is_more(before, after, len(t), k) or not is_swing(t, s, trial):
            break
        found, before = trial, after
    return described(t, s, found) if len(found) else ()


def basis(t: Series1, unknowns: Floats) -> Floats:
    """Return the columns (n, 2 + 2 k) at (f, d) of each swing in turn."""
    columns = [np.ones_like(t), t - t.mean()]
    for f, d in unknowns.reshape(-1, 2):
        decay = np.exp(-d * t)
        columns += [decay * np.cos(2 * np.pi * f * t), decay * np.sin(2 * np.pi * f * t)]
    return np.column_stack(columns)


def fitted(t: Series1, s: Series, unknowns: Floats) -> Floats:
    """Return the coefficients (2 + 2 k, 2) of least squares."""
    return np.linalg.lstsq(basis(t, unknowns), s, rcond=None)[0].astype(np.float64, copy=False)


def remains(t: Series1, s: Series, unknowns: Floats) -> Series:
    """Return what least squares leave (n, 2)."""
    return s - basis(t, unknowns) @ fitted(t, s, unknowns)


def settled(t: Series1, s: Series, unknowns: Floats) -> Floats:
    """Return (f, d) of each swing that leave least."""

    def left(x: Floats) -> Floats:
        return remains(t, s, x).ravel()

    scale = np.tile([1 / t[-1], 1 / t[-1]], len(unknowns) // 2)
    return least_squares(left, unknowns, x_scale=scale, method="lm").x


def is_more(before: float, after: float, rows: int, k: int) -> bool:
    """Say whether six unknowns more leave less than noise would let them (F test)."""
    freedom = 2 * rows - 4 - 6 * (k + 1)
    if freedom < 1 or after <= 0:
        return False
    return bool(fisher.sf((before - after) / 6 / (after / freedom), 6, freedom) < CHANCE)


def is_swing(t: Series1, s: Series, unknowns: Floats) -> bool:
    """Say whether what was found last turns at least once, lasts, and is not a mere distortion."""
    amplitude = amplitudes(t, s, unknowns)[0]
    pairs = unknowns.reshape(-1, 2)
    f, d = pairs[-1]
    separation = np.all(np.abs(pairs[:-1, 0] - f) * t[-1] > 0.5)
    return bool(f * t[-1] >= LEAST_TURNS and d < 2 * f and -d < 1 / t[-1] and separation
                and amplitude[-1] > WORTH * amplitude[0])  # fmt: skip


def amplitudes(t: Series1, s: Series, unknowns: Floats) -> tuple[Floats, Floats]:
    """Return root mean square amplitudes over the record (k,) and the directions (k, 2)."""
    parts = fitted(t, s, unknowns)[2:].reshape(-1, 2, 2)
    decay: Floats = unknowns.reshape(-1, 2)[:, 1]
    fade: Floats = np.sqrt(np.mean(np.exp(-2 * np.outer(decay, t)), axis=1))
    _, sizes, axes = np.linalg.svd(parts)
    return sizes[:, 0] * fade, axes[:, 0]


def described(t: Series1, s: Series, unknowns: Floats) -> tuple[Swing, ...]:
    """Return the swings with their sd."""
    left = remains(t, s, unknowns)
    slope = np.empty((left.size, len(unknowns)))
    for j in range(len(unknowns)):
        step = np.zeros(len(unknowns))
        step[j] = 1e-4 / t[-1]
        change: Floats = remains(t, s, unknowns + step) - remains(t, s, unknowns - step)
        slope[:, j] = change.ravel() / (2 * step[j])
    freedom = max(left.size - 4 - 3 * len(unknowns), 1)
    variance = float(np.sum(left**2)) / freedom * max(spectral_peak(left), 1.0)
    sd: Floats = np.sqrt(np.diag(variance * np.linalg.inv(slope.T @ slope)))
    size, axes = amplitudes(t, s, unknowns)
    own, other = size**2 / 16, 3 * (np.sum(size**2) - size**2) / 16
    order = np.argsort(unknowns[::2])
    return tuple(
        Swing(
            float(unknowns[2 * k] * (1 + own[k])),
            float(np.hypot(sd[2 * k], np.hypot(0.5 * own[k], other[k]) * unknowns[2 * k])),
            float(size[k]),
            float(unknowns[2 * k + 1]),
            (float(axes[k, 0]), float(axes[k, 1])),
        )
        for k in order
    )
