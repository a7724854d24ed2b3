"""A cloud of point masses, turns and numerical derivatives: truth for printed equations.

Nothing here rests on the package's dynamics. g is along -Z of the laboratory but where a paper has
it otherwise.
"""

import numpy as np

from tests.oracle.mujoco_bench import product

MASS, G = 14.24, 9.81
random = np.random.default_rng(11)
PLACES, MASSES = random.normal(size=(9, 3)), random.uniform(0.5, 2.0, size=9)
W, WDOT, MOVED = (random.normal(size=3) for _ in range(3))
STEP = 1e-6
E = np.eye(3)


def skew(v):
    return np.array([[0, -v[2], v[1]], [v[2], 0, -v[0]], [-v[1], v[0], 0]])


def inertia(masses, places):
    """About the origin, of points: sum of m (|p|^2 E - p p^T)."""
    return sum(m * (p @ p * E - np.outer(p, p)) for m, p in zip(masses, places, strict=True))


def turn(v):
    """Rotation matrix of a rotation vector, by the power series."""
    matrix, term = np.eye(3), np.eye(3)
    for k in range(1, 20):
        term = term @ skew(v) / k
        matrix = matrix + term
    return matrix


def matrix_of(q):
    """Body to laboratory: v -> q v q*, column by column."""
    back = q * [1, -1, -1, -1]
    return np.array([product(product(q, np.array([0, *e])), back)[1:] for e in E]).T


def slopes(function, at):
    """Central differences, one column for each element of ``at``."""
    ends = [(function(at + STEP * e), function(at - STEP * e)) for e in np.eye(len(at))]
    return np.array([(hi - lo) / (2 * STEP) for hi, lo in ends]).T


def centred():
    com = MASSES @ PLACES / MASSES.sum()
    return com, inertia(MASSES, PLACES - com)


J = inertia(MASSES, PLACES)


def euler_matrix(roll, pitch, yaw):
    """Body to laboratory, 3-2-1."""
    return turn(yaw * E[2]) @ turn(pitch * E[1]) @ turn(roll * E[0])


ROLL, PITCH = 0.3, -0.4
UP = euler_matrix(ROLL, PITCH, 1.1).T @ E[2]  # Z of the laboratory in body axes
