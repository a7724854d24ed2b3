"""Parts and swings to one estimate, in information form.

    p = p0 + L z + F f,     z ~ N(0, E),     L L^T: covariance of the parts' moments p0

F has a column for each element of J if a part of unknown inertia is among them: then nothing is
known of J beforehand, and the swings alone determine it, as least squares over axes do. A swing is
a row h (p - p0) = -left with an sd (``oscillations``), so that

    information of (z, f) = diag(E, 0) + sum b b^T,     b = [L F]^T h / sd

Its null directions are those of J that no swing shows: six axes in general position leave none.
Rows of swings by gravity depend on where the centre of mass is, so they are linearised anew about
each solution. Swings contradict the parts, or each other, when the sum of squares that is left is
beyond what chance makes it.
"""

from collections.abc import Callable, Sequence
from typing import NamedTuple

import numpy as np

from equipoise.estimation.mass_budget.oscillations import Measured, measured
from equipoise.estimation.mass_budget.part_moments import INERTIA, SIZE
from equipoise.maths.linalg import eigen_symmetric
from equipoise.model.arrays import Floats, Square
from equipoise.model.mass_budget import Oscillation

ROUNDS = 8  # chosen: of the linearisation; two are enough where a centre of mass is known to mm
SETTLED = 1e-6  # chosen: of the unknowns, below which a round changes nothing
NULL = 1e-10  # chosen: of the greatest information, below which a direction has none


class Posterior(NamedTuple):
    """Moments, their covariance, and what is not known of them."""

    p: Floats  # (10,)
    covariance: Square
    open: Floats  # (10, k) directions that nothing shows
    squares: float  # that are left
    freedom: int


class Solution(NamedTuple):
    """What minimises the squares about one linearisation."""

    unknowns: Floats  # z and f
    inverse: Square  # of their information, where there is some
    null: Floats  # directions without
    left: Floats  # of the swings, sd


def combined(
    p0: Floats, covariance: Square, swings: Sequence[Oscillation], is_open: bool
) -> Posterior:
    """Return what parts and swings make of the moments."""
    free = np.eye(SIZE)[:, INERTIA] if is_open else np.zeros((SIZE, 0))
    values, vectors = eigen_symmetric(covariance)
    basis = np.hstack([vectors * np.sqrt(np.maximum(values, 0.0)), free])
    prior = np.concatenate([np.ones(SIZE), np.zeros(free.shape[1])])

    def solved(unknowns: Floats) -> Solution:
        rows = [measured(swing, p0 + basis @ unknowns) for swing in swings]
        h = whitened(rows) @ basis
        wanted = h @ unknowns - np.array([row.left / row.sd for row in rows])
        inverse, null = inverse_of(np.diag(prior) + h.T @ h)
        found = inverse @ (h.T @ wanted)
        return Solution(found, inverse, null, h @ found - wanted)

    last = settled(solved, np.zeros(len(prior)))
    squares = float(np.sum(last.left**2) + np.sum(prior * last.unknowns**2))
    return Posterior(
        p0 + basis @ last.unknowns,
        basis @ last.inverse @ basis.T,
        basis @ last.null,
        squares,
        len(swings) - free.shape[1] + last.null.shape[1],
    )


def settled(solved: Callable[[Floats], Solution], start: Floats) -> Solution:
    """Return the solution about itself."""
    last = solved(start)
    for _ in range(ROUNDS):
        before, last = last, solved(last.unknowns)
        change = float(np.linalg.norm(last.unknowns - before.unknowns))
        if change <= SETTLED * float(np.linalg.norm(last.unknowns)):
            break
    return last


def whitened(rows: Sequence[Measured]) -> Floats:
    """Return the rows (n, 10), each in units of its sd."""
    return np.array([row.row / row.sd for row in rows]).reshape(len(rows), SIZE)


def inverse_of(information: Square) -> tuple[Square, Floats]:
    """Return the inverse where there is information, and the directions without."""
    scale = np.sqrt(np.where(np.diag(information) > 0, np.diag(information), 1.0))
    values, vectors = eigen_symmetric(information / np.outer(scale, scale))
    known = values > NULL * values[-1]
    half = vectors[:, known] / np.sqrt(values[known]) / scale[:, None]
    return half @ half.T, vectors[:, ~known] / scale[:, None]
