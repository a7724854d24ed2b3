"""Where a fit ended, and what its stretches say of themselves."""

from dataclasses import dataclass

import numpy as np

from equipoise.estimation.output_error.kernels import gauss_newton, record_pass
from equipoise.estimation.output_error.kernels.interval_smoother import Smoothed, smooth
from equipoise.estimation.output_error.kernels.segments import Pieces
from equipoise.estimation.output_error.problem import Problem, posed
from equipoise.estimation.parameters.fit_parameters import Unknowns, unknowns_of
from equipoise.estimation.search_budget import Stage
from equipoise.maths.levenberg_marquardt import FIRST, GROWTH
from equipoise.maths.linalg import inverse_spd
from equipoise.model.arrays import Floats, Series, Square

MOST = 300  # evaluations, chosen: a fit that settles takes fewer than thirty
AT_ONCE = 2e7  # node columns, chosen: about a second, after which a budget may end a descent
FEWEST = 3  # evaluations, chosen: fewer than two do not move


@dataclass(frozen=True, slots=True, eq=False)
class Evaluation:
    """The problem at one point: the local model in physical coordinates, data and priors."""

    cost: float  # half the sum of squares
    normal: Square  # A
    descent: Floats  # b
    left_q: Series  # (n, 3) residuals in sd
    left_w: Series
    left_v: Series  # of sensors of vectors
    pieces: Pieces  # the local models of all stretches, data alone

    @property
    def residuals(self) -> int:
        """Return how many numbers are measured."""
        return self.left_q.size + self.left_w.size + self.left_v.size


@dataclass(frozen=True, slots=True, eq=False)
class Fitted:
    """Where a fit ended."""

    problem: Problem
    point: Unknowns
    at: Evaluation
    converged: bool
    evaluations: int
    jumps: Floats  # (K - 1, a) in the order of the problem's


def settle(
    problem: Problem, point: Unknowns, jumps: Floats | None = None, most: int = MOST
) -> Fitted:
    """Return the local optimum from a point and its jumps; None: zero."""
    size, as_posed = problem.layout.size, posed(problem)
    best = record_pass.local_for(as_posed, point.flat)
    if jumps is not None:
        best.pieces.jumps[:] = jumps
    normal, toward = np.eye(size), np.zeros(size)
    damping, growth, done, several = FIRST, GROWTH, 0, at_once(problem)
    while True:
        again = min(done, 1)  # a descent that goes on evaluates once more where it is
        turn = min(most - done, several) + again
        ended = gauss_newton.descend(as_posed, best, turn, normal, toward, damping, growth)
        damping, growth, done = ended.damping, ended.growth, done + ended.evaluations - again
        over = ended.evaluations < turn or done >= most
        if over or not problem.budget.allows(Stage.MOTION):
            break
    at = Evaluation(ended.cost, normal, toward, best.left_q, best.left_w, best.left_v, best.pieces)
    return Fitted(problem, unknowns_of(best.point), at, ended.converged, done,
                  best.pieces.jumps)  # fmt: skip


def at_once(problem: Problem) -> int:
    """Return how many evaluations a descent makes before its budget may end it."""
    columns = len(problem.line.t) * problem.layout.size
    return max(int(AT_ONCE / columns), FEWEST)


def evaluate(problem: Problem, point: Unknowns, jumps: Floats | None = None) -> Evaluation:
    """Return cost, information and descent in physical coordinates, data and priors together."""
    return settle(problem, point, jumps, 1).at


def chi_square_share(fit: Fitted) -> float:
    """Return twice the cost over the number of residuals."""
    return 2 * fit.at.cost / fit.at.residuals


def finite_cost(cost: float) -> float:
    """Return a cost, infinite if it is no number: such a one never wins."""
    return cost if np.isfinite(cost) else np.inf


def cost_of(fit: Fitted) -> float:
    """Return the cost of a fit, infinite if there is none."""
    return finite_cost(fit.at.cost)


def smooth_at(fit: Fitted) -> Smoothed:
    """Return what is known of every stretch at an optimum, with the priors of the problem."""
    return smooth(posed(fit.problem).cuts, fit.at.pieces, inverse_spd(fit.at.normal))


def freedom(fit: Fitted, after: Smoothed) -> float:
    """Return how many unknowns the jumps amount to: sum of 1 - posterior / prior variance."""
    cuts = posed(fit.problem).cuts
    spread = np.diagonal(after.jump_covariance, axis1=1, axis2=2)
    return float(np.sum(np.where(cuts.free >= 0, 1.0 - cuts.weight * spread, 0.0)))
