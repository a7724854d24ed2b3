"""How long a vector is that is known with normal errors only: the length, and what it may be.

    x known as m with covariance P,      length(x) = sqrt(x^T Q x),  Q positive semidefinite

    high     97.5 % of x ~ N(m, P) are shorter
    low      the least length L that x <= L is not rejected: m is at most r sd from where x is L
             or shorter, r such that 97.5 % of what is measured of the nearest such x is nearer
    floor    what ``high`` would be of m = 0: the least length that such errors can prove; without
             errors in proportion to x itself, such as that of a scale, if these are given apart

A length is never found shorter than its errors, so an interval about the value found would be wrong
near zero: ``high`` counts all directions in which x may be off, ``low`` the one towards zero. With
errors small beside m both are m's own 95 % interval.

In sd, u = C^-1 (x - m) with P = C C^T, the nearest x of length L is that of a trust-region problem,
u(l) = -(M + l E)^-1 g, M = C^T Q C, g = C^T Q m. Vectors no longer than it are an ellipsoid K with
that x on its edge, where 2 g.v + v^T M v = 0 about it; r is the 97.5 % quantile of the distance of
N(0, E) from K: 1.96 where K is flat, that of chi with k degrees of freedom where it is a point.
Where K is slender beside the errors, up to 4 % err in place of 2.5 %, as r is that of the nearest x
and not of the worst.
"""

from functools import cache
from typing import NamedTuple

import numpy as np
import scipy

from equipoise.maths.sobol_points import sobol_points
from equipoise.model.arrays import Floats, Square

SURE = 0.975  # one-sided, of every upper bound
POINTS = 12  # 2^12 points, chosen: quantiles to 1 % of an sd
FEW = 2**10 - 1  # points, chosen: of those, for r to 2 % of an sd
WIDEST, HALVINGS = 30.0, 40  # of the pull toward K, ln: to rounding
TURNS, CLOSE = 12, 1e-3  # chosen: r to a thousandth of an sd
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
    return scipy.special.ndtri(sobol_points(1, 2**POINTS - 1, size))


def lengths(x: Floats, Q: Square) -> Floats:
    """Return sqrt(x^T Q x) of each row of x."""
    return np.sqrt(np.maximum(np.einsum("ni,ij,nj->n", x, Q, x, optimize=True), 0.0))


def distances(z: Floats, g: Floats, curvature: Floats) -> Floats:
    """Return how far each row of z (n, k) is from where 2 g.v + sum(curvature v^2) <= 0."""

    def excess(v: Floats) -> Floats:
        return v @ (2.0 * g) + v**2 @ curvature

    found = np.zeros(len(z))
    outside = excess(z) > 0
    beyond, nearest = z[outside], z[outside]
    low, high = np.full((2, len(beyond)), [[-WIDEST], [WIDEST]])
    for _ in range(HALVINGS):
        middle = 0.5 * (low + high)
        pull = np.exp(middle)[:, None]
        nearest = (beyond - pull * g) / (1.0 + pull * curvature)
        short = excess(nearest) > 0
        low, high = np.where(short, middle, low), np.where(short, high, middle)
    found[outside] = np.linalg.norm(nearest - beyond, axis=1)
    return found


def sure_distance(z: Floats, g: Floats, curvature: Floats) -> float:
    """Return the 97.5 % quantile of ``distances``, exact where the edge is flat.

    There they are those along g alone, so that what these points miss of 1.96 is known.
    """
    found = float(np.quantile(distances(z, g, curvature), SURE))
    size = float(np.linalg.norm(g))
    along = (
        float(np.quantile(z @ (g / size), SURE)) if size > 0 else float(scipy.special.ndtri(SURE))
    )
    return found + float(scipy.special.ndtri(SURE)) - along


def toward_zero(g: Floats, curvature: Floats, radius: float) -> Floats:
    """Return the u of length ``radius``, or shorter, with the least 2 g.u + sum(curvature u^2)."""

    def excess(damping: float) -> float:
        return float(np.linalg.norm(g / (curvature + damping))) - radius

    most = float(np.linalg.norm(g)) / radius
    damping = scipy.optimize.brentq(excess, 0.0, most) if excess(0.0) > 0 else 0.0
    return -g / (curvature + float(damping))


def shortest(mean: Floats, C: Floats, Q: Square) -> float:
    """Return the least length that x may well have."""
    values, vectors = np.linalg.eigh(C.T @ Q @ C)
    observed = values > NOTHING * max(float(values[-1]), 0.0)
    if not observed.any():
        return float(lengths(mean[None], Q)[0])
    size = float(values[-1])  # in its units there is none
    curvature, axes = values[observed] / size, vectors[:, observed]
    pull = C.T @ (Q @ mean) / size
    V = axes * np.where(axes.T @ pull < 0, -1.0, 1.0)  # which way they point is chance
    g, z = V.T @ pull, normal_points(int(observed.sum()))[:FEW]
    radius, before = float(scipy.special.ndtri(SURE)), np.inf
    for turn in range(TURNS):
        if abs(radius - before) < CLOSE:
            break
        before = radius
        at = toward_zero(g, curvature, radius)
        sure = sure_distance(z, g + curvature * at, curvature)
        radius = sure if turn < TURNS // 2 else 0.5 * (radius + sure)
    return float(lengths((mean + C @ (V @ toward_zero(g, curvature, radius)))[None], Q)[0])


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
