"""How a centre of mass moves over hours: drift, walk, and the Allan deviation of its estimates.

    sigma^2(m T) = 1 / (2 (n - 2 m + 1)) sum_k (y_{k+m} - y_k)^2,   y_k the mean of m from k

for n estimates, T apart, each axis by itself (overlapping; the statistic of clocks, Allan 1966,
here of r where clocks have frequency). Estimates with white errors alone leave sd / sqrt(m); a walk
of c m/sqrt(s) leaves c sqrt(m T / 3), a steady drift of D m/s leaves D m T / sqrt(2). Where the
deviation stops falling, longer averages do not locate the present centre of mass any better.

    c^2 = ( mean of (r_{k+1} - r_k)^2 - mean of (sd_k^2 + sd_{k+1}^2) ) / T,  after the drift, >= 0
    D     by least squares; variance from the estimates' errors + 6 c^2 / (5 n T)

Cannot distinguish a walk from a cycle longer than the record, nor show motion within one estimate.
"""

from dataclasses import dataclass

import numpy as np

from equipoise.model.arrays import Floats, Series1, Series3, Vector3

FEWEST = 4  # estimates, chosen: fewer show nothing


@dataclass(frozen=True, slots=True, eq=False)
class Wander:
    """Drift and walk shown by successive estimates."""

    span: Floats  # (k,) s, over which estimates are averaged
    deviation: Floats  # (k, 3) m, Allan's
    error: Floats  # (k,) relative sd of it
    measurements_alone: Floats  # (k, 3) m, of measurement errors alone
    drift: Vector3  # m/s
    drift_sd: Vector3  # m/s
    walk: Vector3  # m/sqrt(s)


def allan_deviation(r: Series3, m: int) -> Vector3:
    """Return sigma of means of m estimates."""
    running = np.vstack([np.zeros(3), np.cumsum(r, axis=0)])
    means: Floats = (running[m:] - running[:-m]) / m
    steps: Floats = means[m:] - means[:-m]
    return np.sqrt(0.5 * (steps**2).mean(axis=0))


def wander_of(t: Series1, r: Series3, sd: Series3) -> Wander:
    """Return drift, walk and Allan deviation of estimates r (n, 3) m with sd, at times t (s)."""
    n, separation = len(t), float(np.median(np.diff(t)))
    sizes = [2**k for k in range(n.bit_length()) if 2 * 2**k <= n]
    deviation = np.array([allan_deviation(r, m) for m in sizes])
    freedom = np.array([n / m - 1 for m in sizes])
    typical: Vector3 = np.sqrt((sd**2).mean(axis=0))
    alone = typical / np.sqrt(np.array(sizes, float))[:, None]
    slope, slope_sd = lines_through(t, r, sd)
    steps: Floats = np.diff(r, axis=0) - np.diff(t)[:, None] * slope
    excess: Floats = (steps**2 - sd[1:] ** 2 - sd[:-1] ** 2).mean(axis=0) / separation
    walk: Vector3 = np.sqrt(np.maximum(excess, 0.0))
    wide = np.sqrt(slope_sd**2 + 1.2 * walk**2 / float(t[-1] - t[0]))
    return Wander(separation * np.array(sizes, float), deviation, 1 / np.sqrt(2 * freedom), alone,
                  slope, wide, walk)  # fmt: skip


def lines_through(t: Series1, r: Series3, sd: Series3) -> tuple[Vector3, Vector3]:
    """Return the slope of each axis by weighted least squares, and its sd."""
    w: Floats = sd**-2.0
    middle = (w * t[:, None]).sum(axis=0) / w.sum(axis=0)
    off = t[:, None] - middle
    spread: Vector3 = (w * off**2).sum(axis=0)
    return (w * off * r).sum(axis=0) / spread, spread**-0.5
