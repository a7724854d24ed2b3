"""How long a vector is that is known with normal errors only: the length, and what it may be.

    x known as m with covariance P,      length(x) = sqrt(x^T Q x),  Q positive semidefinite

    high     97.5 % of x ~ N(m, P) are shorter
    low      the shortest x within the 95 % ellipsoid (x - m)^T P^-1 (x - m) <= chi2(0.95, rank)
    floor    what ``high`` would be of m = 0: the least length that such errors can prove; without
             errors in proportion to x itself, such as that of a scale, if these are given apart

A length is never found shorter than its errors, so an interval about the value found would be wrong
near zero: ``high`` counts all directions in which x may be off, ``low`` the one towards zero. With
errors small beside m both are m's own 95 % interval. ``low`` is a trust-region problem: with
P = C C^T, u in a ball, minimise |A (m + C u)|^2, whose answer is u(l) = -(M + l E)^-1 g.
"""

from functools import cache
from typing import NamedTuple

import numpy as np
from scipy.optimize import brentq
from scipy.special import ndtri
from scipy.stats import chi2
from scipy.stats.qmc import Sobol

from equipoise.model.arrays import Floats, Square

SURE = 0.975  # one-sided, of every upper bound
INSIDE = 0.95  # of the ellipsoid
POINTS = 12  # 2^12 points, chosen: quantiles to 1 % of an sd
NOTHING = 1e-12  # chosen: of the largest eigenvalue, a smaller one is rounding


class Bounded(NamedTuple):
    """A length with its 95 % bounds, and the least that could have been proven."""

    value: float
    low: float
    high: float
    floor: float


def root_of(covariance: Square) -> Floats:
    """Return C with C C^T = P, for P that may be singular."""
    values, vectors = np.linalg.eigh(0.5 * (covariance + covariance.T))
    return vectors * np.sqrt(np.maximum(values, 0.0))


@cache
def normal_points(size: int) -> Floats:
    """Return points (n, size) spread evenly as N(0, E); always the same."""
    return ndtri(Sobol(size, scramble=False).fast_forward(1).random(2**POINTS - 1))


def lengths(x: Floats, Q: Square) -> Floats:
    """Return sqrt(x^T Q x) of each row of x."""
    return np.sqrt(np.maximum(np.einsum("ni,ij,nj->n", x, Q, x, optimize=True), 0.0))


def shortest(mean: Floats, C: Floats, Q: Square) -> float:
    """Return the least length within the ellipsoid."""
    values, vectors = np.linalg.eigh(C.T @ Q @ C)
    observed = values > NOTHING * max(float(values[-1]), 0.0)
    if not observed.any():
        return float(lengths(mean[None], Q)[0])
    values, V = values[observed], vectors[:, observed]
    g = V.T @ (C.T @ (Q @ mean))
    radius = float(np.sqrt(chi2.ppf(INSIDE, int(observed.sum()))))

    def excess(damping: float) -> float:
        return float(np.linalg.norm(g / (values + damping))) - radius

    least = excess(0.0)
    most = float(np.linalg.norm(g)) / radius
    damping = brentq(excess, 0.0, most) if least > 0 else 0.0
    u = V @ (-g / (values + float(damping)))
    return float(lengths((mean + C @ u)[None], Q)[0])


def bounded_length(
    mean: Floats, covariance: Square, Q: Square, unscaled: Square | None = None
) -> Bounded:
    """Return the length of ``mean`` (k,) in the metric ``Q`` (k, k), and its bounds.

    ``unscaled`` is the covariance without errors in proportion to x.
    """
    points, C = normal_points(len(mean)), root_of(covariance)
    least = C if unscaled is None else root_of(unscaled)
    high, floor = (
        float(np.quantile(lengths(at + points @ root.T, Q), SURE))
        for at, root in ((mean, C), (0 * mean, least))
    )
    return Bounded(float(lengths(mean[None], Q)[0]), shortest(mean, C, Q), high, floor)
