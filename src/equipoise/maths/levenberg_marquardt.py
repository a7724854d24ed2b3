"""Levenberg-Marquardt on normal equations, for parameters that need not form a vector space.

    (A + lam diag A) step = b,     A = J^T W J,  b = J^T W e,     x <- retract(x, step)

The caller supplies cost, A and b at a point; this module only decides where to look next
(Nielsen's rule for lam; Madsen, Nielsen and Tingleff 2004, section 3.2).
"""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Generic, TypeVar

import numpy as np

from equipoise.model.arrays import Floats, Square

Point = TypeVar("Point")
FREE = 1e-2  # damping beyond which a small promise may only say that steps are kept small
NEAR = 100.0  # by how much the promise of a bolder step may exceed the tolerance: 0.1 sd


@dataclass(frozen=True, slots=True, eq=False)
class Quadratic:
    """Half the sum of squares at a point, and its local model."""

    cost: float
    normal: Square  # A
    descent: Floats  # b


@dataclass(frozen=True, slots=True, eq=False)
class Solution(Generic[Point]):
    """Where the iteration ended."""

    point: Point
    local: Quadratic
    converged: bool
    evaluations: int


def scaled_solve(normal: Square, descent: Floats, damping: float) -> Floats:
    """Return the damped step; solved with unit diagonal, so units do not matter."""
    diagonal = np.diag(normal)
    scale = 1.0 / np.sqrt(np.where(diagonal > 0, diagonal, 1.0))
    unit = normal * scale[:, None] * scale
    unit[np.diag_indices_from(unit)] += damping
    return scale * np.linalg.solve(unit, scale * descent)


def promise(local: Quadratic, step: Floats) -> float:
    """Return by how much a step should lower twice the cost, by the local model."""
    return float(2 * step @ local.descent - step @ local.normal @ step)


def minimise(
    evaluate: Callable[[Point], Quadratic],
    propose: Callable[[Point, Quadratic, float], tuple[Point, float]],
    start: Point,
    tolerance: float = 1e-4,
    most: int = 300,
    damping: float = 1e-6,
    rows: int = 0,
) -> Solution[Point]:
    """Return a local minimum from ``start``.

    ``propose`` gives the next point for a damping, and its promise. Converged means that the step
    promises to lower twice the cost by less than ``tolerance``; for residuals in units of their sd
    that is a step of sqrt(tolerance) standard deviations. ``rows``, when given, lets the tolerance
    grow with a misfit beyond one sd a row, where digits run out and the sd mean less.
    """
    point, local = start, evaluate(start)
    evaluations, growth = 1, 2.0
    while evaluations < most and np.isfinite(local.cost):
        trial, promised = propose(point, local, damping)
        misfit = max(1.0, 2 * local.cost / rows) if rows else 1.0
        if promised < tolerance * misfit:
            bold = promised if damping < FREE else propose(point, local, FREE)[1]
            return Solution(point, local, abs(bold) < NEAR * tolerance * misfit, evaluations)
        there = evaluate(trial)
        evaluations += 1
        gained = 2.0 * (local.cost - there.cost)
        if not np.isfinite(gained) or gained < 0:
            damping, growth = max(damping, 1e-6) * growth, 2.0 * growth
            continue
        trust, point, local, growth = gained / promised, trial, there, 2.0
        damping = max(damping * max(0.1, 1.0 - (2.0 * trust - 1.0) ** 3), 1e-12)
    return Solution(point, local, False, evaluations)
