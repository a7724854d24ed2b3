"""Whether a body nearer to the stated one explains the record nearly as well as an interval allows.

An interval is that of the plane through one optimum. By the inequality of Cauchy and Schwarz, a
point at which chi-square has risen by ``rise`` is within

    |x_i - x_i*| <= sd_i rise^(1/2)

in every parameter, where that plane holds. So the optimum is sought once more with the testbed's
body as prior, from the one that was found, as far as the budget allows. It goes along what the
record leaves open, which may bend: where a number then is much farther away than the inequality
allows, its interval is none.

Cannot see what bends elsewhere than on the way to the stated body, nor anything if that is the one
that was found, or where the prior is in use anyway.
"""

from dataclasses import replace

import numpy as np

from equipoise.estimation.output_error.fixed_parameters import fixed, settle_pinned
from equipoise.estimation.output_error.problem import Problem, prior_of
from equipoise.estimation.output_error.profile_likelihood import (
    opened,
    profiled,
    sizes_of,
    values_of,
)
from equipoise.estimation.output_error.solution import Fitted, cost_of, evaluate
from equipoise.estimation.parameters.fit_parameters import CORE
from equipoise.estimation.search_budget import UNLIMITED, Budget, Stage
from equipoise.model.estimate import Estimate, Parameter
from equipoise.model.testbed import Testbed

FARTHER = 1.5  # chosen: times what the inequality allows; a record that is sound is within 1.3
FARTHEST = 25.0  # of chi-square, chosen: beyond that nothing says that it should be a parabola
FEW = 60  # evaluations, chosen


def tried(
    estimate: Estimate, fitted: Fitted, stated: Testbed, budget: Budget = UNLIMITED
) -> Estimate:
    """Return the estimate without intervals that the misfit belies, beside or toward the stated."""
    return profiled(compared_with_stated(estimate, fitted, stated, budget), fitted, budget)


def compared_with_stated(
    estimate: Estimate, fitted: Fitted, stated: Testbed, budget: Budget = UNLIMITED
) -> Estimate:
    """Return the estimate without intervals that a body nearer to the stated one belies."""
    if not sizes_of(fitted) or not estimate.outcome.usable or not budget.allows(Stage.INTERVALS):
        return estimate
    guided = with_stated(replace(fitted.problem, budget=budget), stated)
    nearer = settle_pinned(guided, fitted.point, fitted.jumps, FEW)
    rise = 2.0 * (evaluate(fitted.problem, nearer.point, nearer.jumps).cost - cost_of(fitted))
    if not rise < FARTHEST:
        return estimate
    allowed = FARTHER * max(1.0, rise) ** 0.5
    here, there = (values_of(fitted.problem, one.point) for one in (fitted, nearer))
    off = {p.name: sds_between(p, here, there) for p in (*estimate.parameters, *estimate.ratios)}
    return opened(estimate, {name: (sds, rise) for name, sds in off.items() if sds > allowed})


def with_stated(problem: Problem, stated: Testbed) -> Problem:
    """Return the problem with the testbed's body as prior: it decides what is open."""
    prior = problem.prior
    body = prior_of(stated, problem.errors, problem.layout, True, ())
    mean, weight = prior.mean.copy(), prior.weight.copy()
    mean[CORE], weight[CORE] = body.mean[CORE], body.weight[CORE]
    prior = replace(prior, mean=mean, weight=weight, held=fixed(problem))
    return replace(problem, prior=prior)


def sds_between(parameter: Parameter, here: dict[str, float], there: dict[str, float]) -> float:
    """Return by how many sd a part of the body, or a ratio to another, differs; 0: it is none."""
    first, *top = parameter.name.split("/")
    if first not in here or not 0.0 < parameter.sd < np.inf:
        return 0.0
    one, other = (values[first] / (values[top[0]] if top else 1.0) for values in (here, there))
    return abs(other - one) / parameter.sd
