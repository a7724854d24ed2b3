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


def minimise(
    evaluate: Callable[[Point], Quadratic],
    retract: Callable[[Point, Floats], Point],
    start: Point,
    tolerance: float = 1e-6,
    most: int = 60,
    damping: float = 1e-6,
) -> Solution[Point]:
    """Return a local minimum from ``start``.

    Converged means that a full step would lower twice the cost by less than ``tolerance``; for
    residuals in units of their sd that is a step of sqrt(tolerance) standard deviations.
    """
    point, local = start, evaluate(start)
    evaluations, growth = 1, 2.0
    while evaluations < most:
        step = scaled_solve(local.normal, local.descent, damping)
        promised = float(step @ local.descent)
        trial = retract(point, step)
        there = evaluate(trial)
        evaluations += 1
        gained = 2.0 * (local.cost - there.cost)
        if not np.isfinite(gained) or gained < 0:
            if promised < tolerance:
                return Solution(point, local, True, evaluations)
            damping, growth = max(damping, 1e-6) * growth, 2.0 * growth
            continue
        point, local, growth = trial, there, 2.0
        if promised < tolerance:
            return Solution(point, local, True, evaluations)
        trust = gained / promised if promised > 0 else 1.0
        damping = max(damping * max(1.0 / 3.0, 1.0 - (2.0 * trust - 1.0) ** 3), 1e-12)
    return Solution(point, local, False, evaluations)
