"""The point that the tracker linearises about, and what happens to the covariance when it moves.

Free motion is the same for (J, r) and c (J, r). A filter that linearises about ever new estimates
calls another direction unobservable each time, and so gains information on the scale c that no row
holds. Two things prevent that: the point stays while rows come in, the estimate leaning on it; and
when it moves, the covariance goes with it in coordinates in which the direction is constant,

    s = ln tr J,  J / tr J,  r / tr J         P <- T P T^T,  T = c E + (x' - c x) l
    x = (r, J),  l dx = tr dJ / tr J,  c = tr J' / tr J          (docs/derivations.md)

T takes x to x', and changes of (J, r) / tr J only by the factor c. tr J is linear in J, which
makes T the same by whatever points one goes. A sag scales as r does: where it is estimated, its
coefficients are part of x and of the point.
"""

import numpy as np

from equipoise.maths.kernels.compiled import kernel, part
from equipoise.maths.linalg import element_sizes, unpack_symmetric
from equipoise.model.arrays import Floats, Square

AT = 7  # where com stands in an estimate written as one array: q, w, com, J, bias, v, k, sag
STIFF = 9  # numbers of a point, r and J, before those of a sag
BESIDE = 9  # numbers of an estimate between J and the sag: bias, v, k
MOVED = 0.01  # of a moment, chosen: half of the error that linearising once stands
MOVED_COM = 0.03  # of |r|, chosen: r enters linearly but for its product with 1/J
POSSIBLE = 0.5  # chosen: a point's inertia shrinks to no less than this at a time, along any axis


@part
def distance(point: Floats, end: Floats) -> float:
    """Return the distance of an estimate from the point; beyond 1 the point has to move."""
    size, off, moved = 0.0, 0.0, 0.0
    for k in range(6):
        i = 0 if k == 0 or k == 3 or k == 4 else (1 if k == 1 or k == 5 else 2)
        j = 0 if k == 0 else (1 if k == 1 or k == 3 else 2)
        share = (end[AT + 3 + k] - point[3 + k]) ** 2 / (point[3 + i] * point[3 + j])
        moved = max(moved, share / (MOVED * MOVED))
    for k in range(3):
        size += point[k] * point[k]
        off += (end[AT + k] - point[k]) ** 2
    return max(moved, off / (MOVED_COM * MOVED_COM * size)) ** 0.5


@kernel
def transport(P: Floats, point: Floats, end: Floats) -> None:
    """Move the point to the estimate, and P with it: T P T^T."""
    size = point[3] + point[4] + point[5]
    c = (end[AT + 3] + end[AT + 4] + end[AT + 5]) / size
    for j in range(P.shape[0]):
        along = (P[9, j] + P[10, j] + P[11, j]) / size
        for k in range(9):
            P[6 + k, j] = c * P[6 + k, j] + (end[AT + k] - c * point[k]) * along
    for j in range(P.shape[0]):
        along = (P[j, 9] + P[j, 10] + P[j, 11]) / size
        for k in range(9):
            P[j, 6 + k] = c * P[j, 6 + k] + (end[AT + k] - c * point[k]) * along
    for k in range(9):
        point[k] = end[AT + k]


@kernel
def bent(point: Floats, end: Floats) -> float:
    """Return how far the sag is from that of the point, as ``distance`` has it for r; 0 without."""
    size, off = 0.0, 0.0
    for k in range(3):
        size += point[k] * point[k]
    for k in range(STIFF, point.shape[0]):
        off += (end[AT + BESIDE + k] - point[k]) ** 2
    return (off / (MOVED_COM * MOVED_COM * size)) ** 0.5


def moved(point: Floats, end: Floats) -> float:
    """Return the distance of an estimate from the point, a sag included."""
    return max(distance(point, end), bent(point, end))


def transport_sag(P: Square, point: Floats, new: Floats) -> None:
    """Move the sag of the point, and P with it: the rows of T that are its own.

    Before ``transport``, which changes what these take from J.
    """
    size, rows = point[3:6].sum(), np.arange(STIFF, len(point)) + 6 + BESIDE
    c, T = new[3:6].sum() / size, np.eye(len(P))
    T[rows, rows] = c
    T[rows, 9:12] = ((new - c * point) / size)[STIFF:, None]
    P[:] = T @ P @ T.T
    point[STIFF:] = new[STIFF:]


def linear_in(posterior: Floats) -> Floats:
    """Return what a point has of an estimate: r, J and a sag."""
    return np.append(posterior[AT : AT + STIFF], posterior[AT + STIFF + BESIDE :])


def shrunk(point: Floats, new: Floats) -> bool:
    """Say whether J' - J POSSIBLE is not positive: one of its leading minors (Sylvester)."""
    xx, yy, zz = (float(new[k] - POSSIBLE * point[k]) for k in (3, 4, 5))
    xy, xz, yz = (float(new[k] - POSSIBLE * point[k]) for k in (6, 7, 8))
    minor = xx * yy - xy * xy
    whole = zz * minor - xx * yz * yz - yy * xz * xz + 2 * xy * xz * yz
    return not (xx > 0.0 and minor > 0.0 and whole > 0.0)


def nearer(point: Floats, posterior: Floats) -> Floats:
    """Return the estimate of (r, J), or a point on the way to it where J stays possible."""
    share = 1.0
    while share > 1e-3:
        new = point + share * (posterior - point)
        if not shrunk(point, new):
            return new
        share /= 2
    return point


def doubt(point: Floats, covariance: Floats) -> float:
    """Return the greatest sd of an element of J, relative to its size."""
    sizes = element_sizes(unpack_symmetric(point[3:STIFF]))
    return float(np.max(np.sqrt(np.diag(covariance)[9:15]) / sizes))


def doubt_of_shape(point: Floats, covariance: Floats) -> float:
    """Return the same for J / tr J: what is left of the doubt with the scale taken out."""
    inertia = point[3:STIFF]
    out_of_scale = np.eye(6) - np.outer(inertia, [1, 1, 1, 0, 0, 0]) / inertia[:3].sum()
    left = out_of_scale @ covariance[9:15, 9:15] @ out_of_scale.T
    sizes = element_sizes(unpack_symmetric(inertia))
    return float(np.max(np.sqrt(np.abs(np.diag(left))) / sizes))
