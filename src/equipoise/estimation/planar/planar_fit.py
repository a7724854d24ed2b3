"""The search of the maximum of the likelihood: damped steps, each to a body that can exist."""

from dataclasses import dataclass

import numpy as np

from equipoise.estimation.planar.planar_problem import (
    Left,
    PlanarProblem,
    Point,
    left_of,
    possible,
    sensitivities,
)
from equipoise.estimation.search_budget import Budget, Stage
from equipoise.maths.attitude import exponential, multiply
from equipoise.maths.levenberg_marquardt import FIRST, GROWTH, judge, promise, tolerated
from equipoise.maths.scaled_solve import scaled_solve
from equipoise.model.arrays import Floats, Square
from equipoise.model.estimate import ATTITUDE

MOST = 40  # steps, chosen: a search from the linear guess takes four to eight


@dataclass(frozen=True, slots=True, eq=False)
class PlanarFit:
    """Where a search ended."""

    problem: PlanarProblem
    point: Point
    left: Left
    normal: Square  # of the data and all priors, the anchor too
    chi_square: float  # of the data
    cost: float  # with the priors
    converged: bool


def cost_of(problem: PlanarProblem, point: Point, left: Left) -> float:
    """Return twice the negative logarithm of the posterior, but for constants."""
    off = point.values - problem.prior.mean
    return float(np.sum(left.flat**2) + np.sum(problem.prior.weight * off**2))


def advanced(point: Point, step: Floats, turn: list[int]) -> Point:
    """Return the point after a step; the turn goes into the first attitude."""
    values = point.values + step
    q0 = multiply(point.q0, exponential(values[turn]))
    values[turn] = 0.0
    return Point(q0, values)


def tried(problem: PlanarProblem, point: Point) -> tuple[Left | None, float]:
    """Return what a point leaves and its cost; infinite where no body is like that."""
    if not possible(problem, point.values):
        return None, np.inf
    left = left_of(problem, point)
    cost = cost_of(problem, point, left)
    return left, cost if np.isfinite(cost) else np.inf


def local_model(problem: PlanarProblem, point: Point, left: Left) -> tuple[Square, Floats]:
    """Return the normal matrix and the descent; of what is held a unit and zero."""
    by, prior = sensitivities(problem, point, left), problem.prior
    # summed plainly: for so few columns BLAS wakes every core, and waits for those that are busy
    normal = np.einsum("ki,kj->ij", by, by) + np.diag(prior.weight)
    descent = -np.einsum("ki,k->i", by, left.flat) - prior.weight * (point.values - prior.mean)
    held = np.flatnonzero(prior.held)
    normal[held, :] = normal[:, held] = 0.0
    normal[held, held], descent[held] = 1.0, 0.0
    return normal, descent


@np.errstate(over="ignore", invalid="ignore")  # of a step too far, which is not taken
def settled(problem: PlanarProblem, start: Point, budget: Budget) -> PlanarFit:
    """Return the optimum that a search from ``start`` finds, or where it had to end."""
    turn, point = problem.layout.of(*ATTITUDE), start
    left, cost = left_of(problem, point), 0.0
    cost = cost_of(problem, point, left)
    damping, growth, converged = FIRST, GROWTH, False
    normal, descent = local_model(problem, point, left)
    for _ in range(MOST):
        step = scaled_solve(normal, descent, damping)
        promised = promise(normal, descent, step)
        if promised < tolerated(cost, problem.rows):
            converged = True
            break
        if not budget.allows(Stage.MOTION):
            break
        trial = advanced(point, step, turn)
        trial_left, trial_cost = tried(problem, trial)
        better, damping, growth = judge(cost - trial_cost, promised, damping, growth)
        if better and trial_left is not None:
            point, left, cost = trial, trial_left, trial_cost
            normal, descent = local_model(problem, point, left)
    square = float(np.sum(left.flat**2))
    return PlanarFit(problem, point, left, normal, square, cost, converged)
