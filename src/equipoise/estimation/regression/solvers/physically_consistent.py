"""Least squares among bodies that can exist: inertia by log-Cholesky numbers (Wensing 2018).

    minimise |A x - b|^2,    J_P = J_C(six) + m ( |r|^2 E - r r^T ),  six and r free

Every choice of the six numbers (``maths.pseudo_inertia``) is a body with J > 0 whose moments obey
the triangle inequalities; where the unconstrained solution is such a body, both are the same.
Where it is none, the answer lies near the border, and its interval is that of a clipped number:
the diagonal of the Cholesky factor is at least the root of ``pseudo_inertia.FLOOR`` of the guessed
trace, so that the search has an end and rounding leaves the answer possible.
"""

import numpy as np
import scipy

from equipoise.estimation.regression.formulations.rows import Rows, centred, guess_of
from equipoise.estimation.regression.solvers.least_squares import Aid, normal_of, solved
from equipoise.maths import pseudo_inertia
from equipoise.maths.linalg import pack_symmetric, unpack_symmetric
from equipoise.model.arrays import Floats
from equipoise.model.estimate import BODY, COM, INERTIA
from equipoise.model.mass_properties import MassProperties, is_possible, parallel_axis

LARGEST = 20.0  # of the logarithms, chosen: so that no trial leaves the range of numbers


def possible(rows: Rows, aid: Aid) -> Floats:
    """Return the solution."""
    normal, right = normal_of(centred(rows))
    free = solved(normal, right)
    if not set(BODY) <= set(rows.names):
        return free  # held values are the user's own
    six = [rows.names.index(name) for name in INERTIA]
    com = [rows.names.index(name) for name in COM]
    mass = aid.testbed.body.mass
    if is_possible(MassProperties(mass, free[com], unpack_symmetric(free[six]))):
        return free
    return nearest(normal, free, six, com, mass, guess_of(rows, aid.testbed))


def nearest(
    normal: Floats, free: Floats, six: list[int], com: list[int], mass: float, guess: Floats
) -> Floats:  # fmt: skip
    """Return the possible body of least (x - free)^T A^T A (x - free)."""
    scale = 1 / np.sqrt(np.diag(normal))
    root = np.linalg.cholesky(normal * np.outer(scale, scale) + 1e-12 * np.eye(len(free)))

    least = 0.5 * np.log(pseudo_inertia.FLOOR * np.trace(unpack_symmetric(guess[six])))

    def six_within(y: Floats) -> Floats:
        numbers = y[six]
        numbers[:3] = np.clip(numbers[:3], least, LARGEST)
        return numbers

    def body(y: Floats) -> Floats:
        x = y.copy()
        J = pseudo_inertia.to_inertia(six_within(y)) + parallel_axis(mass, y[com] * scale[com])
        x[six] = pack_symmetric(J) / scale[six]
        return x

    def slope(y: Floats) -> Floats:
        by_y, numbers = np.eye(len(y)), six_within(y)
        inside = numbers == y[six]
        by_y[np.ix_(six, six)] = pseudo_inertia.slope_of_inertia(numbers) * inside
        by_y[np.ix_(six, com)] = slope_of_shift(mass, y[com] * scale[com]) * scale[com]
        by_y[six] /= scale[six, None]
        return root.T @ by_y

    start = free / scale
    inertia_C = unpack_symmetric(free[six]) - parallel_axis(mass, free[com])
    if np.trace(inertia_C) <= 0:
        inertia_C = unpack_symmetric(guess[six])
    start[six] = pseudo_inertia.from_inertia(inertia_C)
    found = scipy.optimize.least_squares(
        lambda y: root.T @ (body(y) - free / scale), start, slope, method="lm", xtol=1e-12
    )
    return body(np.asarray(found.x, dtype=np.float64)) * scale


def slope_of_shift(mass: float, r: Floats) -> Floats:
    """Return d/dr of m (|r|^2 E - r r^T), (6, 3): rows xx yy zz xy xz yz."""
    x, y, z = mass * r
    return np.array([
        [0.0, 2 * y, 2 * z], [2 * x, 0.0, 2 * z], [2 * x, 2 * y, 0.0],
        [-y, -x, 0.0], [-z, 0.0, -x], [0.0, -z, -y],
    ])  # fmt: skip
