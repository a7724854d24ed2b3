"""Periods of swing, by least squares of decaying sines through roll and pitch.

    s(t) = c0 + c1 t + lines(t) + sum_k e^(-d_k t) (a_k cos 2 pi f_k t + b_k sin 2 pi f_k t)

k <= 2. f and d are the same in both signals, the rest is solved for at every step (variable
projection; Golub and Pereyra 1973). The lines are what turns with the platform (``spin_lines``): a
swing is what they leave, and nothing that a record cannot separate from one of them. The sd of f is
that of least squares, with rows that err together counted by the residual's own spectrum. A swing
of amplitude a is slower than a small one:

    f_small = f (1 + a^2 / 16)

Half of that goes into the sd. A swing of amplitude b about the other axis bends this one, between
-b^2 / 16 (in one plane) and 5 b^2 / 16 (round a cone: f = f_small / sqrt(cos a)): 3 b^2 / 16 more.
While a platform turns, terms of second order have sums and differences of swings and spin as their
frequencies. Some lie where the record of T seconds cannot separate them from a swing, and they are
a share of up to a / 2 of it: they move its phase by so much within the record, and f by

    a / (4 pi T)

Cannot see a swing of which less than one period was recorded.
"""

import math
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
import scipy

from equipoise.assessment.metrics.spectrum import decimated, highest_peak, spectrum
from equipoise.assessment.metrics.spin_lines import SEPARATE, SpinLines, is_separate, no_lines
from equipoise.maths.whiteness import spectral_peak
from equipoise.model.arrays import Complexes, Floats, Series, Series1

MOST = 2  # swings of a platform
SWING_UNKNOWNS = 6  # unknowns: f, d, and two coefficients of each signal
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
    shape: tuple[complex, complex]  # the signals are Re(shape e^(2 pi i f t)), unit vector
    centre: tuple[float, float]  # about which they swing


class Tilts(NamedTuple):
    """Roll and pitch of a record, and what else than swings is in them."""

    t: Series1  # (n,) s, from 0
    s: Series  # (n, 2) rad
    fixed: Floats  # (n, c) columns of free size: constant, trend, lines of the spin
    lines: SpinLines

    @property
    def duration(self) -> float:
        """Return the record's length, s."""
        return float(self.t[-1])

    def freedom(self, swings: int) -> int:
        """Return the degrees of freedom that so many swings leave."""
        return self.s.size - 2 * self.fixed.shape[1] - SWING_UNKNOWNS * swings


def swings(t: Series1, s: Series, lines: SpinLines | None = None) -> tuple[Swing, ...]:
    """Return the swings in signals (n, 2), small angles in rad, at times t (s); slow one first.

    ``lines`` are those of a platform that turns.
    """
    tilts = posed(t, s, no_lines(len(t)) if lines is None else lines)
    found = np.zeros(0)
    left = remains(tilts, found)
    before = float(np.sum(left**2))
    for k in range(1, MOST + 1):
        peak, _ = highest_peak(spectrum(tilts.t, left))
        first = max(peak, LEAST_TURNS / tilts.duration)
        trial = settled(tilts, np.array([*found, first, 0.0]))
        left = remains(tilts, trial)
        after = float(np.sum(left**2))
        if not is_more(before, after, tilts.freedom(k)) or not is_swing(tilts, trial):
            break
        found, before = trial, after
    return described(tilts, found) if len(found) else ()


def posed(t: Series1, s: Series, lines: SpinLines) -> Tilts:
    """Return the signals, as means of neighbours where rows are many."""
    at, means = decimated(t, np.column_stack([s, lines.columns]))
    fixed = np.column_stack([np.ones_like(at), at - at.mean(), means[:, 2:]])
    return Tilts(at - at[0], means[:, :2], fixed, lines)


def basis(tilts: Tilts, unknowns: Floats) -> Floats:
    """Return the columns (n, c + 2 k) at (f, d) of each swing in turn."""
    t, columns = tilts.t, [tilts.fixed]
    for f, d in unknowns.reshape(-1, 2):
        decay = np.exp(-d * t)
        columns += [decay * np.cos(2 * np.pi * f * t), decay * np.sin(2 * np.pi * f * t)]
    return np.column_stack(columns)


def fitted(tilts: Tilts, unknowns: Floats) -> Floats:
    """Return the coefficients (c + 2 k, 2) of least squares."""
    found = np.linalg.lstsq(basis(tilts, unknowns), tilts.s, rcond=None)[0]
    return found.astype(np.float64, copy=False)


def remains(tilts: Tilts, unknowns: Floats) -> Series:
    """Return what least squares leave (n, 2)."""
    return tilts.s - basis(tilts, unknowns) @ fitted(tilts, unknowns)


def settled(tilts: Tilts, unknowns: Floats) -> Floats:
    """Return (f, d) of each swing that leave least."""

    def left(x: Floats) -> Floats:
        return remains(tilts, x).ravel()

    scale = np.full(len(unknowns), 1 / tilts.duration)
    return scipy.optimize.least_squares(left, unknowns, x_scale=scale, method="lm").x


def is_more(before: float, after: float, freedom: int) -> bool:
    """Say whether a swing's unknowns leave less than noise would let them (F test)."""
    if freedom < 1 or after <= 0:
        return False
    ratio = (before - after) / SWING_UNKNOWNS / (after / freedom)
    return bool(scipy.special.fdtrc(SWING_UNKNOWNS, freedom, ratio) < CHANCE)


def is_swing(tilts: Tilts, unknowns: Floats) -> bool:
    """Say whether what was found last turns at least once, lasts, and is not a mere distortion."""
    amplitude, pairs, T = amplitudes(tilts, unknowns), unknowns.reshape(-1, 2), tilts.duration
    f, d = pairs[-1]
    lasts = f * T >= LEAST_TURNS and d < 2 * f and -d < 1 / T
    separate = np.all(np.abs(pairs[:-1, 0] - f) * T > SEPARATE)
    return bool(lasts and separate and amplitude[-1] > WORTH * amplitude[0])


def phasors(tilts: Tilts, unknowns: Floats) -> Complexes:
    """Return what each swing is in the signals (k, 2) at t = 0: Re(phasor e^((2 pi i f - d) t))."""
    parts = fitted(tilts, unknowns)[tilts.fixed.shape[1] :].reshape(-1, 2, 2)
    return parts[:, 0] - 1j * parts[:, 1]


def amplitudes(tilts: Tilts, unknowns: Floats) -> Floats:
    """Return the amplitudes (k,) along the long axis of each swing, root mean square over time."""
    found = phasors(tilts, unknowns)
    parts = np.stack([found.real, found.imag], axis=1)
    decay: Floats = unknowns.reshape(-1, 2)[:, 1]
    fade: Floats = np.sqrt(np.mean(np.exp(-2 * np.outer(decay, tilts.t)), axis=1))
    return np.linalg.svd(parts, compute_uv=False)[:, 0] * fade


def spread(tilts: Tilts, unknowns: Floats) -> Floats:
    """Return the sd of (f, d) of each swing in turn."""
    left = remains(tilts, unknowns)
    slope = np.empty((left.size, len(unknowns)))
    for j in range(len(unknowns)):
        step = np.zeros(len(unknowns))
        step[j] = 1e-4 / tilts.duration
        change: Floats = remains(tilts, unknowns + step) - remains(tilts, unknowns - step)
        slope[:, j] = change.ravel() / (2 * step[j])
    freedom = max(tilts.freedom(len(unknowns) // 2), 1)
    variance = float(np.sum(left**2)) / freedom * max(spectral_peak(left), 1.0)
    return np.sqrt(np.diag(variance * np.linalg.inv(slope.T @ slope)))


def described(tilts: Tilts, unknowns: Floats) -> tuple[Swing, ...]:
    """Return the swings with their sd; one that may be a line of the spin is left out."""
    sd, centre = spread(tilts, unknowns), fitted(tilts, unknowns)[0]
    size, shape, T = amplitudes(tilts, unknowns), phasors(tilts, unknowns), tilts.duration
    shape /= np.linalg.norm(shape, axis=1)[:, None]
    frequency: Floats = unknowns[::2]
    own, other = size**2 / 16, 3 * (np.sum(size**2) - size**2) / 16
    beat = float(np.linalg.norm(size)) / (4 * np.pi * T) if tilts.lines.turns else 0.0
    bent: Floats = np.hypot(0.5 * own, other) * frequency
    return tuple(
        Swing(
            float(frequency[k] * (1 + own[k])),
            math.hypot(sd[2 * k], bent[k], beat),
            float(size[k]),
            float(unknowns[2 * k + 1]),
            (complex(shape[k, 0]), complex(shape[k, 1])),
            (float(centre[0]), float(centre[1])),
        )
        for k in np.argsort(frequency)
        if is_separate(float(frequency[k]), tilts.lines, T)
    )
