"""Jumps of com of unstated size hold no information on the scale of J and com; a plain fit errs.

Rows show jumps u only as u/J. A fit with an sd s of the jumps can therefore lower sum u^2/s^2 by
shrinking J, com and u alike, in the proportion c, and would: by the pull

    d/d(ln c) [ 1/2 sum u^2/s^2 ] = S,     S = sum u^2/s^2

which outweighs the known move where jumps are many. It is not what is likely: the volume that u may
take up shrinks, too, as c^-1 for each jump that the rows show (restricted likelihood), and s is set
by the same u, so that it goes along. What is left of the jumps about the scale is nothing; so

    cost - S ln c,      information - S l l^T,     l = d(ln c)/d(unknowns)

c is measured by the moments about level axes, across which gravity turns a shift of com:
c ~ tr J - up.J up, linear in J. The first is a linear term, which moves the mean of J's priors.

Cannot see more than that: where jumps are as large as the known moves, the scale is lost.
"""

from dataclasses import replace

import numpy as np

from equipoise.estimation.output_error.problem import Prior, Problem, posed
from equipoise.estimation.output_error.solution import Fitted
from equipoise.estimation.parameters.fit_parameters import CORE, JP, Unknowns
from equipoise.maths.linalg import inverse_spd, pack_symmetric
from equipoise.model.arrays import Floats, Vector3

KEPT = 1e-3  # chosen: of what is known of the scale, at least, so that there is an inverse


def scale_row(problem: Problem, point: Unknowns, up: Vector3) -> Floats:
    """Return l: how ln c goes with the unknowns."""
    across = np.eye(3) - np.outer(up, up) / float(up @ up)
    inertia = point.body(problem.mass).inertia_P
    row = np.zeros(problem.layout.size)
    row[JP] = pack_symmetric(across) * [1, 1, 1, 2, 2, 2] / float(np.sum(across * inertia))
    return row


def pull(problem: Problem, jumps: Floats) -> float:
    """Return S of the jumps; 0 where the scale is held."""
    if problem.scale_open or problem.prior.held[CORE].any():
        return 0.0
    return float(np.sum(posed(problem).cuts.weight * jumps**2))


def untied(problem: Problem, plain: Prior, fitted: Fitted, up: Vector3) -> Problem:
    """Return a problem whose jumps do not pull at the scale; ``plain`` is its own prior.

    By how much they would is what they do in a fit nearby, with the lesser of both sd's S: where
    the sd has changed, its jumps have not yet.
    """
    pulls = [pull(each, fitted.jumps) for each in (problem, fitted.problem)]
    push = min(pulls) * scale_row(problem, fitted.point, up)
    mean = plain.mean.copy()
    mean[JP] += push[JP] / plain.weight[JP]
    return replace(problem, prior=replace(plain, mean=mean))


def disbelieved(fitted: Fitted, up: Vector3) -> Fitted:
    """Return the fit without the information on the scale that is the jumps'."""
    row = scale_row(fitted.problem, fitted.point, up)
    reported = 1.0 / float(row @ inverse_spd(fitted.at.normal) @ row)
    taken = min(pull(fitted.problem, fitted.jumps), (1 - KEPT) * reported)
    normal = fitted.at.normal - taken * np.outer(row, row)
    return replace(fitted, at=replace(fitted.at, normal=normal))
