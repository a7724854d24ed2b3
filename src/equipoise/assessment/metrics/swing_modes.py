"""Small swings of a platform on its bearing: their frequencies, and the height that they imply.

About hanging at rest, or a steady spin about the vertical, with w = -W n + dw, n = g_B/g,

    J dw' = [J w]x dw - [w]x J dw + m g [r]x dn,      dn' = [n]x dw - [w]x dn
    m g r = m g h n + W^2 (n n^T - E) J n

A platform spins steadily about an axis that is not principal where gravity holds it there, with the
centre of mass aside of the vertical: m g r x n = W^2 n x J n gives r but for its height h along n.

The eigenvalues of this 6 x 6 system are two pairs +-i omega, the swings, and two zeros, the turn
about the vertical. Without spin and products of inertia

    omega = sqrt(m g h / J_i),    T = 2 pi sqrt( J_i / (m g h) ),    h = 4 pi^2 J_i / (m g T^2)

for each horizontal axis: T grows as balance improves (da Silva 2021 section 5 says that it falls).
The turn about the vertical is free, so products of inertia act by J_hh - J_hn J_nh / J_nn.

Holds for small tilts. A swing of amplitude a is slower by a^2 / 16 (``period``).
"""

import numpy as np
import scipy

from equipoise.maths.attitude import level, to_matrix
from equipoise.maths.linalg import inverse_spd, skew
from equipoise.model.arrays import Complexes, Floats, Matrix3, Square, Vector3

STILL = 1e-9  # rad/s, chosen: slower is the turn about the vertical


def linear_motion(moment: float, inertia_P: Matrix3, down: Vector3, spin: float) -> Square:
    """Return the matrix of (dw, dn); ``moment`` is m g h in N m, ``spin`` about the vertical."""
    w: Vector3 = -spin * down
    turned = inverse_spd(inertia_P)
    turn: Floats = turned @ (skew(inertia_P @ w) - skew(w) @ inertia_P)
    pull: Floats = turned @ skew(moment * down + steadying(inertia_P, down, spin))
    return np.vstack([np.hstack([turn, pull]), np.hstack([skew(down), -skew(w)])])


def steadying(inertia_P: Matrix3, down: Vector3, spin: float) -> Vector3:
    """Return m g r (N m) across the vertical that makes a spin about it steady."""
    momentum: Vector3 = inertia_P @ down
    return spin**2 * (down * (down @ momentum) - momentum)


def swing_rates(moment: float, inertia_P: Matrix3, down: Vector3, spin: float = 0.0) -> Floats:
    """Return omega (2,) of the swings, slow one first, rad/s; zero for one that topples."""
    values = np.linalg.eigvals(linear_motion(moment, inertia_P, down, spin))
    rates: Floats = np.sort(np.asarray(values.imag, float))[-2:]
    return np.where(rates > STILL, rates, 0.0)


def across(down: Vector3) -> Floats:
    """Return two body axes (2, 3) at right angles to gravity, in which swings are stated."""
    R = to_matrix(level(-down))
    return R[:2]


def swing_shapes(moment: float, inertia_P: Matrix3, down: Vector3, spin: float = 0.0) -> Complexes:
    """Return how the vertical moves in each swing (2, 2), slow one first.

    Rows are unit vectors along the axes of ``across``: real without spin, for a swing in a plane,
    and complex for one that goes round, Re(shape e^(i omega t)).
    """
    motion = linear_motion(moment, inertia_P, down, spin).astype(np.complex128)
    values, vectors = np.linalg.eig(motion)
    last = np.argsort(np.imag(values))[-2:]
    shapes = np.asarray(vectors[3:, last].T @ across(down).T, dtype=np.complex128)
    return shapes / np.linalg.norm(shapes, axis=1)[:, None]


def moment_for(
    omega: float, mode: int, inertia_P: Matrix3, down: Vector3, spin: float = 0.0
) -> float:
    """Return m g h (N m) at which swing ``mode`` (0: the slow one) has a rate omega (rad/s).

    Not a number when none has, as with a spin faster than the swing.
    """

    def off(moment: float) -> float:
        return float(swing_rates(moment, inertia_P, down, spin)[mode]) - omega

    most = float(np.linalg.eigvalsh(inertia_P)[-1]) * omega**2
    while off(most) < 0 and most < 1e6:
        most *= 2
    least = 1e-9 * most
    if off(least) > 0 or off(most) < 0:
        return float("nan")
    return float(scipy.optimize.brentq(off, least, most, xtol=1e-12 * most))
