"""The torque of a mass that hangs, beside that of the platform with the mass where it rests level.

With n = g_B / |g|, u the side to which it swings and up the body axis that points up level,

    n_u = n.u,   n_d = -n.up,   s = (n_u^2 + n_d^2)^(1/2),   phi = atan2(n_u, n_d)
    k theta + (1 - k) s sin(theta - phi) = 0
    torque = M g c (sin(theta) u + (1 - cos(theta)) up) x n

theta is where spring and gravity leave it (``model.hanging_mass``). For small tilts the torque is
that of elastic sag, c (1 - k) u u^T.

Cannot show how it swings about that place: a mode does (``modal_motion``). A platform moves some
twenty times as slowly, and what lags then is some hundredths of its sag.
"""

from typing import NamedTuple

import numpy as np

from equipoise.maths.attitude import to_matrix
from equipoise.model.arrays import Floats, Series, Series1, Series3, Vector3
from equipoise.model.hanging_mass import HangingMass
from equipoise.model.recording import Samples

TURNS = 12  # of Newton's, chosen: a few reach rounding


class HangingTorque(NamedTuple):
    """A mass that hangs, and what it did in a motion; None: not followed yet."""

    mass: HangingMass
    torque: Samples | None = None  # N m, body axes


def sides_of(up: Vector3) -> tuple[Vector3, Vector3]:
    """Return two body axes that are level when ``up`` is vertical; headings count from the first.

    It is the one of x, y, z that is farthest from vertical, the first of two alike.
    """
    aside = np.eye(3)[int(np.argmin(np.abs(up)))]
    first: Vector3 = aside - (aside @ up) * up
    first = (first / np.linalg.norm(first)).astype(np.float64, copy=False)
    return first, np.cross(up, first).astype(np.float64, copy=False)


def swung(n_u: Series1, n_d: Series1, spring: float) -> Series1:
    """Return theta (rad)."""
    phi: Floats = np.arctan2(n_u, n_d)
    size: Floats = np.hypot(n_u, n_d)
    theta = (1.0 - spring) * phi
    for _ in range(TURNS):
        off = spring * theta + (1.0 - spring) * size * np.sin(theta - phi)
        theta -= off / (spring + (1.0 - spring) * size * np.cos(theta - phi))
    return theta


def hanging_torque(q: Series, mass: HangingMass, up: Vector3, weight: float) -> Series3:
    """Return the torque (N m, body axes) at attitudes (n, 4), ``weight`` being M g."""
    down: Series3 = -to_matrix(q)[:, 2, :]
    x, y = sides_of(up)
    side: Vector3 = np.cos(mass.heading) * x + np.sin(mass.heading) * y
    theta = swung(down @ side, -(down @ up), mass.spring)
    moved = np.outer(np.sin(theta), side) + np.outer(1.0 - np.cos(theta), up)
    return np.cross(weight * mass.lever * moved, down).astype(np.float64, copy=False)
