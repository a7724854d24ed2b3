"""The momentum trajectory that makes gravity sweep two directions of the body.

Gravity's direction n = g_B / g is to go round a cone that opens slowly about level,

    n_d = -cos(a) up + sin(a) p,    p = cos(W t) e1 + sin(W t) e2,    a = A (1 - (1 + t/s) e^-t/s)

so that nothing jumps at the start; s is OPENS turns of 2 pi / W. With n' = n x w the rate for that,
and for coming back when n has strayed, is

    w_d  = n_d' x n_d + k n_d x n
    w_d' = n_d'' x n_d + k (n_d' x n + n_d x (n x w))

and the momentum trajectory is H_d = J w_d. It includes no spin about n. A = 0 and k = 0 is rest.
"""

from typing import NamedTuple

import numpy as np

from equipoise.maths.linalg import cross
from equipoise.model.arrays import Matrix3, Vector3

OPENS = 0.5  # turns, chosen: a cone that is nine tenths open after two


class Sweep(NamedTuple):
    """A cone for gravity's direction to go round."""

    axes: Matrix3  # columns e1, e2, up
    angle: float  # rad, A
    speed: float  # rad/s, W
    hold: float  # 1/s, k


class Wanted(NamedTuple):
    """Rate and its slope."""

    rate: Vector3  # rad/s, w_d
    slope: Vector3  # rad/s^2, w_d'


def cone(sweep: Sweep, t: float) -> tuple[Vector3, Vector3, Vector3]:
    """Return n_d, n_d' and n_d'' at time t (s) since the start."""
    e1, e2, up = sweep.axes.T
    W, opens = sweep.speed, sweep.speed / (2 * np.pi * OPENS)
    x, late = t * opens, np.exp(-t * opens)
    a = sweep.angle * (1 - (1 + x) * late)
    a1 = sweep.angle * x * late * opens
    a2 = sweep.angle * (1 - x) * late * opens**2
    s, c = np.sin(a), np.cos(a)
    p = np.cos(W * t) * e1 + np.sin(W * t) * e2
    p1 = W * (np.cos(W * t) * e2 - np.sin(W * t) * e1)
    outward, inward = s * up + c * p, c * up - s * p
    n = -c * up + s * p
    n1 = a1 * outward + s * p1
    n2 = a2 * outward + a1**2 * inward + 2 * c * a1 * p1 - s * W**2 * p
    return n, n1, n2


def wanted(sweep: Sweep, t: float, down: Vector3, rate: Vector3) -> Wanted:
    """Return the rate to have at time t (s), from gravity's direction and the rate as they are."""
    n, n1, n2 = cone(sweep, t)
    back = cross(n1, down) + cross(n, cross(down, rate))
    return Wanted(cross(n1, n) + sweep.hold * cross(n, down), cross(n2, n) + sweep.hold * back)
