"""How a centre of mass moves over hours: drift, walk, and the Allan deviation of looks at it.

    sigma^2(m T) = 1 / (2 (n - 2 m + 1)) sum_k (y_{k+m} - y_k)^2,   y_k the mean of m looks from k

for n looks, T apart, each axis by itself (overlapping; the statistic of clocks, Allan 1966, here of
r where clocks have frequency). Looks that only err leave sd / sqrt(m); a walk of c m/sqrt(s) leaves
c sqrt(m T / 3), a steady drift of D m/s leaves D m T / sqrt(2). Where the deviation stops falling,
longer looks tell no more of where the centre of mass is now.

    c^2 = ( mean of (r_{k+1} - r_k)^2 - mean of (sd_k^2 + sd_{k+1}^2) ) / T,  after the drift, >= 0
    D     by least squares; variance of the looks' errors + 6 c^2 / (5 n T)

Cannot tell a walk from a cycle longer than the record, nor see what is quicker than a look.
"""

from dataclasses import dataclass

import numpy as np

from equipoise.model.arrays import Floats, Series1, Series3, Vector3

FEWEST = 4  # looks, chosen: of fewer nothing is told


@dataclass(frozen=True, slots=True, eq=False)
class Wander:
    """What looks that follow one another say."""

    span: Floats  # (k,) s, over which looks are averaged
    deviation: Floats  # (k, 3) m, Allan's
    error: Floats  # (k,) relative sd of it
    measurements_alone: Floats  # (k, 3) m, what looks that only err would leave
    drift: Vector3  # m/s
    drift_sd: Vector3  # m/s
    walk: Vector3  # m/sqrt(s)


def allan_deviation(r: Series3, m: int) -> Vector3:
    """Return sigma of means of m looks."""
    running = np.vstack([np.zeros(3), np.cumsum(r, axis=0)])
    means: Floats = (running[m:] - running[:-m]) / m
    steps: Floats = means[m:] - means[:-m]
    return np.sqrt(0.5 * (steps**2).mean(axis=0))


def wander_of(t: Series1, r: Series3, sd: Series3) -> Wander:
    """Return drift, walk and Allan deviation of looks r (n, 3) m with their sd, at times t (s)."""
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
