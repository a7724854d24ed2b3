"""From a record to the optimum: a horizon that grows, and a friction map as fine as is supported.

A wrong guess of the swings' period loses the motion after a few of them. So the first fits take a
part of the record, with the linear guess as a weak prior, and each begins where the last one ended.

Maps are refined node by node, 2 by 2, 3 by 3 and so on. Akaike's criterion

    chi^2 + 2 k,    k: nodes

is least for the map that the record supports. The map that is kept is two refinements finer. What
it could hold, and the record does not show, then widens the intervals. The coarser map has too
narrow ones: a slope along the path and a friction that changes along it look alike, and a change
that is missed moves the slope by several of its sd.
"""

from dataclasses import dataclass, replace

import numpy as np

from equipoise.dynamics.planar.friction_map import hat_functions
from equipoise.estimation.planar.planar_fit import PlanarFit, settled
from equipoise.estimation.planar.planar_layout import (
    natural_sizes,
    planar_layout,
    planar_prior,
)
from equipoise.estimation.planar.planar_problem import (
    PlanarProblem,
    Point,
    grid_of,
    pose,
)
from equipoise.estimation.planar.planar_start import TRUST, first_point
from equipoise.estimation.search_budget import Budget, Stage
from equipoise.maths.linalg import element_sizes, unpack_symmetric
from equipoise.model.arrays import Floats, Series
from equipoise.model.estimate import COM, INERTIA
from equipoise.model.recording import Recording, window
from equipoise.model.testbed import Testbed

PARTS = (0.12, 0.25, 0.5)  # of the record, chosen: a few swings, then twice as many each time
FIRST_MAP, FINEST = 2, 6  # nodes along an axis, chosen: of the search, and at most
BEYOND = 2  # chosen: refinements beyond the map that is supported
GUESS = 3  # nodes of the linear guess, chosen: a coarse map bends the path that moments are seen by
RANK = 1e-2  # chosen: directions of nodes that the path hardly meets stay at the mean
LEAST_COM = 1e-4  # m, chosen: sd of the linear guess of a centre of mass near P


@dataclass(frozen=True, slots=True, eq=False)
class PlanarCase:
    """A record that is to be explained."""

    recording: Recording
    testbed: Testbed
    terms: tuple[str, ...]
    hold: tuple[str, ...]
    use_prior: bool

    def problem(self, nodes: int) -> PlanarProblem:
        """Return the problem with a map of ``nodes`` by ``nodes``."""
        start, end = self.recording.span
        layout = planar_layout(self.testbed, self.terms, nodes)
        size = natural_sizes(layout, self.testbed, end - start)
        prior = planar_prior(layout, self.testbed, size, self.use_prior, self.hold)
        return pose(self.recording, self.testbed, layout, prior, size)


def searched(case: PlanarCase, budget: Budget) -> PlanarFit:
    """Return the fit in a map two refinements finer than the one that the record supports."""
    found = best = grown(case, budget)
    for nodes in range(FIRST_MAP + 1, FINEST + 1):
        if nodes > best.problem.layout.nodes + BEYOND or not budget.allows(Stage.MODELS):
            break
        problem = case.problem(nodes)
        found = settled(problem, on_map(found, problem), budget)
        best = found if akaike(found) < akaike(best) else best
    return found


def akaike(fit: PlanarFit) -> float:
    """Return chi^2 + 2 k, but for what all maps have in common."""
    return fit.chi_square + 2.0 * fit.problem.layout.nodes**2


def grown(case: PlanarCase, budget: Budget) -> PlanarFit:
    """Return a fit of the whole record, reached by parts of it."""
    rich, problem = case.problem(GUESS), case.problem(FIRST_MAP)
    guess = first_point(rich, case.recording)
    point = moved_to(guess, rich, problem)
    (start, end), whole = case.recording.span, case.recording
    for share in PARTS:
        part = replace(case, recording=window(whole, start, start + share * (end - start)))
        early = guided(part.problem(FIRST_MAP), point)
        early = replace(early, size=problem.size)
        point = settled(early, point, budget).point
    return settled(problem, point, budget)


def guided(problem: PlanarProblem, guess: Point) -> PlanarProblem:
    """Return a problem with a weak prior around a guess of inertia and centre of mass."""
    layout, prior = problem.layout, problem.prior
    mean, weight = prior.mean.copy(), prior.weight.copy()
    J, r = layout.of(*INERTIA), layout.of(*COM)
    spread = TRUST * element_sizes(unpack_symmetric(guess.values[J]))
    mean[J], mean[r] = guess.values[J], guess.values[r]
    weight[J] += spread**-2.0
    weight[r] += (TRUST * float(np.linalg.norm(guess.values[r])) + LEAST_COM) ** -2.0
    return replace(problem, prior=replace(prior, mean=mean, weight=weight))


def on_map(fit: PlanarFit, problem: PlanarProblem) -> Point:
    """Return the point of a fit among the unknowns of a problem with another map."""
    return moved_to(fit.point, fit.problem, problem)


def moved_to(point: Point, before: PlanarProblem, after: PlanarProblem) -> Point:
    """Return a point with its map read at the nodes of another, by least squares along the path."""
    path = before.position.rows.values
    along = nodes_along(before, path) @ point.values[before.layout.friction]
    weights, mean = nodes_along(after, path), float(np.mean(along))
    rest = np.linalg.lstsq(weights, along - mean, rcond=RANK)[0].astype(np.float64, copy=False)
    values = np.append(point.values[: before.layout.friction.start], mean + rest)
    return Point(point.q0, values)


def nodes_along(problem: PlanarProblem, path: Series) -> Floats:
    """Return the weights of a map's nodes at places (n, 2) m."""
    nodes = problem.layout.nodes
    return hat_functions(grid_of(problem.table, np.zeros((nodes, nodes))), path)
