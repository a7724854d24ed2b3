"""The point that the tracker linearises about, and what happens to the covariance when it moves.

Free motion is the same for (J, r) and c (J, r). A filter that linearises about ever new beliefs
calls another direction unobservable each time, and so learns about the scale c what no row has
said. Two things prevent that: the point stays while rows come in, the belief leaning on it; and
when it moves, the covariance goes with it in coordinates in which the direction is constant,

    s = ln tr J,  J / tr J,  r / tr J         P <- T P T^T,  T = c E + (x' - c x) l
    x = (r, J),  l dx = tr dJ / tr J,  c = tr J' / tr J          (docs/derivations.md)

T takes x to x', and changes of (J, r) / tr J only by the factor c. tr J is linear in J, which
makes T the same by whatever points one goes.
"""

import numpy as np

from equipoise.maths.compiled import kernel, part
from equipoise.maths.linalg import element_sizes, unpack_symmetric
from equipoise.model.arrays import Floats

AT = 7  # where com stands in a belief written as one array: q, w, com, J, bias
FAR = 0.01  # of a moment, chosen: half of the error that linearising once stands
FAR_COM = 0.03  # of |r|, chosen: r enters linearly but for its product with 1/J
POSSIBLE = 0.5  # chosen: a point's inertia shrinks to no less than this at a time, along any axis


@part
def moved(point: Floats, end: Floats) -> bool:
    """Say whether a belief is too far from the point of linearisation."""
    for k in range(6):
        i = 0 if k == 0 or k == 3 or k == 4 else (1 if k == 1 or k == 5 else 2)
        j = 0 if k == 0 else (1 if k == 1 or k == 3 else 2)
        off = end[AT + 3 + k] - point[3 + k]
        if off * off > FAR * FAR * point[3 + i] * point[3 + j]:
            return True
    size, off = 0.0, 0.0
    for k in range(3):
        size += point[k] * point[k]
        off += (end[AT + k] - point[k]) ** 2
    return off > FAR_COM * FAR_COM * size


@kernel
def transport(P: Floats, point: Floats, end: Floats) -> None:
    """Move the point to the belief, and P with it: T P T^T."""
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


def nearer(point: Floats, belief: Floats) -> Floats:
    """Return the belief of (r, J), or a point on the way to it where J stays possible."""
    share = 1.0
    root = np.linalg.inv(np.linalg.cholesky(unpack_symmetric(point[3:])))
    while share > 1e-3:
        new = point + share * (belief - point)
        if np.linalg.eigvalsh(root @ unpack_symmetric(new[3:]) @ root.T)[0] > POSSIBLE:
            return new
        share /= 2
    return point


def doubt(point: Floats, covariance: Floats) -> float:
    """Return the greatest sd of an element of J, relative to its size."""
    sizes = element_sizes(unpack_symmetric(point[3:]))
    return float(np.max(np.sqrt(np.diag(covariance)[9:15]) / sizes))


def doubt_of_shape(point: Floats, covariance: Floats) -> float:
    """Return the same for J / tr J: what is left of the doubt with the scale taken out."""
    inertia = point[3:]
    out_of_scale = np.eye(6) - np.outer(inertia, [1, 1, 1, 0, 0, 0]) / inertia[:3].sum()
    left = out_of_scale @ covariance[9:15, 9:15] @ out_of_scale.T
    sizes = element_sizes(unpack_symmetric(inertia))
    return float(np.max(np.sqrt(np.abs(np.diag(left))) / sizes))
