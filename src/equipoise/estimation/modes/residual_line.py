"""A line in what a fit leaves: a mode that nobody modelled moves at one frequency.

The periodogram of the residuals, tapered at both ends (Tukey), summed over the axes,

    P_k = sum_axes |sum_i v_i r_i exp(-2 pi j f_k t_i)|^2,      x_k = P_k / median of P nearby

is Gamma distributed of shape 3 for white noise, scaled. The median over a band around a frequency
takes noise that has a colour as it is there. The greatest of M independent x exceeds the threshold
x* by chance with a probability of M (1 + x* + x*^2 / 2) exp(-x*).

So are halves, quarters and eighths of the record, where a mode may have died down.

Cannot see a mode above the Nyquist frequency of a sensor's rows; it is taken for its alias there.
Nor one within a few times the frequency of the motion, where what the model lacks leaves lines too.
"""

from collections.abc import Iterator
from itertools import pairwise
from typing import NamedTuple

import numpy as np
import scipy
from numpy.typing import NDArray

from equipoise.estimation.output_error.problem import quickest_swing
from equipoise.estimation.output_error.solution import Fitted
from equipoise.estimation.output_error.trajectory import fastest_rate
from equipoise.model.arrays import Bools, Floats, Ints, Series1, Series3, Vector3
from equipoise.model.recording import Samples

ALARM = 2e-3  # chosen: probability of a line by chance in one record
BAND = 150  # bins on either side, chosen: that a median is taken over
MEDIAN = 2.674060313723  # of a Gamma distribution of shape 3
ABOVE = 6.0  # chosen: times the fastest motion; its harmonics have faded there
WAVES = 12.0  # chosen: fewer within a record are no line
HIGHEST = 0.96  # chosen: of the Nyquist frequency
FINER = 4  # chosen: frequencies for an independent one; between, heights are higher by chance
LEVELS = 4  # chosen: the whole record, halves, quarters, eighths
TAPER = 0.2  # of a record, chosen: both ends together
ITERATIONS = 40  # of a map that shrinks errors by 2 / x
FEWEST = 200  # rows, chosen: fewer have no band to compare with


class Line(NamedTuple):
    """A line, and whether chance makes one."""

    frequency: float  # Hz
    height: float  # x, 3 on the average
    threshold: float  # x*
    axis: Vector3  # unit vector, body axes, along which the residual oscillates

    @property
    def is_sure(self) -> bool:
        """Say whether it is beyond what chance makes."""
        return self.height > self.threshold


class Spectrum(NamedTuple):
    """Fourier sums of rows at frequencies."""

    f: Series1  # Hz
    sums: NDArray[np.complex128]  # (n, 3)


def spectrum_of(t: Series1, left: Series3, period: float) -> Spectrum:
    """Return the windowed Fourier sums of rows; each counts at the nearest of even times."""
    slot: Ints = np.array((t - t[0]) / period + 0.5, dtype=np.int64)
    n = int(slot[-1]) + 1
    grid, taper = np.zeros((n, 3)), tapered(n)
    np.add.at(grid, slot, left * taper[slot][:, None])
    f = np.fft.rfftfreq(FINER * n, period).astype(np.float64, copy=False)
    return Spectrum(f, np.fft.rfft(grid, FINER * n, axis=0))


def threshold_for(frequencies: float) -> float:
    """Return the height that the greatest of so many independent ones exceeds by chance."""
    x = 20.0
    for _ in range(ITERATIONS):
        x = float(np.log(frequencies / ALARM) + np.log1p(x + x * x / 2))
    return x


def tapered(n: int) -> Series1:
    """Return Tukey's window of n rows: a cosine over half of TAPER at each end."""
    edge = np.minimum(np.arange(n), np.arange(n)[::-1]) / (0.5 * TAPER * (n - 1))
    return 0.5 - 0.5 * np.cos(np.pi * np.minimum(edge, 1.0))


def within(f: Series1, lowest: float, period: float) -> Bools:
    """Return which frequencies (Hz) are sought."""
    found: Bools = (f > lowest) & (f < HIGHEST * 0.5 / period)
    return found


def line_in(t: Series1, left: Series3, period: float, lowest: float, whole: int) -> Line | None:
    """Return the greatest line above a frequency (Hz); None where rows are too few.

    ``whole`` is how many frequencies the whole record has; the threshold counts that its halves,
    quarters and so on (``LEVELS``) have as many together.
    """
    if len(t) < FEWEST:
        return None
    spectrum = spectrum_of(t, left, period)
    sought = within(spectrum.f, max(lowest, WAVES / (t[-1] - t[0])), period)
    if np.count_nonzero(sought) < FINER * BAND:
        return None
    f, sums = spectrum.f[sought], spectrum.sums[sought]
    power: Floats = np.sum(np.abs(sums) ** 2, axis=1)
    level: Floats = (
        scipy.ndimage.median_filter(power, 2 * FINER * BAND + 1, mode="reflect") / MEDIAN
    )
    height = power / level
    k = int(np.argmax(height))
    cross = np.real(np.outer(sums[k], np.conj(sums[k])))
    axis: Vector3 = np.linalg.eigh(cross)[1][:, -1].astype(np.float64, copy=False)
    return Line(float(f[k]), float(height[k]), threshold_for(float(whole * LEVELS)), axis)


def parts_of(rows: Samples, left: Series3) -> Iterator[tuple[Series1, Series3]]:
    """Yield the rows of the record, its halves, and so on: a mode may die down within a part."""
    start, end = float(rows.t[0]), float(rows.t[-1])
    for level in range(LEVELS):
        edges = np.linspace(start, end, 2**level + 1)
        for a, b in pairwise(edges):
            inside = (rows.t >= a) & (rows.t <= b)
            yield rows.t[inside], left[inside]


def lowest_frequency(fitted: Fitted) -> float:
    """Return the frequency (Hz) above which a line is no motion that gravity and spin explain."""
    recording, testbed = fitted.problem.recording, fitted.problem.testbed
    swing = fitted.point.body(testbed.body.mass).swing_time(testbed.gravity)
    motion = max(fastest_rate(recording), min(quickest_swing(testbed), 2.0 / swing))
    return ABOVE * motion / (2 * np.pi)


def residual_line(fitted: Fitted) -> Line | None:
    """Return the surest line in what a fit leaves of the gyro's rows, or of the camera's."""
    recording, lowest = fitted.problem.recording, lowest_frequency(fitted)
    pairs = ((recording.rate, fitted.at.left_w), (recording.attitude, fitted.at.left_q))
    lines = [
        line_in(t, part, rows.period, lowest, FINER * len(rows) // 2)
        for rows, left in pairs if rows is not None and len(rows) > 1
        for t, part in parts_of(rows, left)
    ]  # fmt: skip
    found = [line for line in lines if line is not None]
    return max(found, key=lambda line: line.height / line.threshold, default=None)
