"""A part's share in the platform's moments of mass, and how its errors move them.

Moments add up: over all parts

    p = (M, mu, J)       M = sum m,   mu = sum m c,   J = sum [ R I R^T + m (c.c E - c c^T) ]

I is the part's inertia about its own centre c (``shapes``), R turns its axes to the body's. With
x = (m, c, small turn d, factor k of I, dimensions) and the diagonal variances V of x,

    p(x) = (m, m c, k R [d] I(m, s) [d]^T R^T + m (c.c E - c c^T)),    [d] = E + [d x]

    covariance of p = sum (dp/dx) V (dp/dx)^T

(Summing parts: Olsen 1996, after da Silva 2021 section 3.1.2.) So an error of a part's mass acts on
mass, centre of mass and inertia jointly. Errors of parts are independent of each other: one that is
common, such as that of a drawing whose origin is not P, is not in it.
"""

from collections.abc import Sequence

import numpy as np

from equipoise.estimation.mass_budget.shapes import SQUARES
from equipoise.maths.complex_step import jacobian
from equipoise.maths.linalg import PAIRS
from equipoise.model.arrays import Complexes, Floats, Square, Vector3
from equipoise.model.mass_budget import Part

SIZE = 10  # M, mu, J xx yy zz xy xz yz
INERTIA = slice(4, 10)
EYE = np.eye(3)
TURNS = np.array([[[0, 0, 0], [0, 0, -1], [0, 1, 0]], [[0, 0, 1], [0, 0, 0], [-1, 0, 0]],
                  [[0, -1, 0], [1, 0, 0], [0, 0, 0]]], float)  # fmt: skip  # [e_k x]


def moments(part: Part, x: Complexes) -> Complexes:
    """Return p of a part (kg, kg m, kg m^2) with its numbers x."""
    mass, centre, turn, factor, size = x[0], x[1:4], x[4:7], x[7], x[8:]
    own = part.inertia + mass * np.diag(SQUARES[part.shape] @ size**2)
    axes = part.turn @ (EYE + np.tensordot(turn, TURNS, 1))
    inertia = factor * axes @ own @ axes.T
    inertia = inertia + mass * (centre @ centre * EYE - np.outer(centre, centre))
    return np.array([mass, *(mass * centre), *(inertia[i, j] for i, j in PAIRS)])


def nominal(part: Part) -> Floats:
    """Return x as stated."""
    return np.concatenate([[part.mass], part.centre, np.zeros(3), [1.0], part.size])


def spreads(part: Part) -> Floats:
    """Return the sd of x."""
    three, sizes = np.ones(3), np.full(len(part.size), part.size_sd)
    return np.concatenate(
        [[part.mass_sd], part.centre_sd * three, part.turn_sd * three, [part.inertia_sd], sizes]
    )


def contribution(part: Part) -> tuple[Floats, Square]:
    """Return p of a part, and its covariance."""
    at = nominal(part)
    spread = jacobian(lambda x: moments(part, x), at) * spreads(part)
    return moments(part, at.astype(complex)).real, spread @ spread.T


def total(parts: Sequence[Part]) -> tuple[Floats, Square, Floats]:
    """Return p of all parts, its covariance, and the covariance that each part contributes."""
    found = [contribution(part) for part in parts]
    each = np.array([covariance for _, covariance in found])
    return np.sum([p for p, _ in found], axis=0), each.sum(axis=0), each


def about_P(p: Complexes) -> Complexes:
    """Return mass, centre of mass and inertia about P (xx yy zz xy xz yz) of the moments."""
    return np.concatenate([p[:1], p[1:4] / p[0], p[INERTIA]])


def about_C(p: Complexes) -> Complexes:
    """Return the inertia about the centre of mass (xx yy zz xy xz yz) of the moments."""
    mass, first = p[0], p[1:4]
    shift = (first @ first * EYE - np.outer(first, first)) / mass
    return p[INERTIA] - np.array([shift[i, j] for i, j in PAIRS])


def along(axis: Vector3 | Complexes) -> Complexes:
    """Return the row that gives n^T J n of J's six elements."""
    return np.array([(1.0 if i == j else 2.0) * axis[i] * axis[j] for i, j in PAIRS])
