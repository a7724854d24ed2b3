"""Profile likelihood: whether the misfit rises beside an optimum as its interval says.

    rise(x) = 2 (min over all others of cost, at x - cost at the optimum),   4 at 2 sd of a parabola

An interval is that of the plane through one point. Where a record tells a moment of inertia to a
twentieth of its size or worse, the valley may bend away from the plane, or the search may end at
the edge of the possible bodies; the plane then tells firmly what the record leaves open. So both
ends of a wide interval are tried, with everything else sought anew. Where the misfit rises by less
than half of what the interval says, the number is open. This is the likelihood interval of Venzon
and Moolgavkar (1988, eq. 4), at two points.

What the testbed's body bounds as prior is not tried: that is an interval whatever the record says.
Cannot see what no search from the optimum reaches; an end that no body can have counts as a rise.
"""

from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from equipoise.estimation.output_error.fixed_parameters import settle_pinned
from equipoise.estimation.output_error.problem import Problem
from equipoise.estimation.output_error.solution import Fitted, cost_of
from equipoise.estimation.parameters.fit_parameters import CORE, Unknowns, physical
from equipoise.estimation.parameters.observability import natural_sizes
from equipoise.estimation.search_budget import UNLIMITED, Budget, Stage
from equipoise.model.estimate import BODY, Estimate, Parameter
from equipoise.model.outcome import Outcome
from equipoise.model.reasons.data_reasons import Unobservable
from equipoise.model.reasons.estimate_reasons import EstimateReason as Why
from equipoise.model.reasons.reason import Reason

WIDE = 0.05  # natural sizes, chosen: within less the valley is a parabola
SDS = 2.0  # sd from the optimum
LEAST = 0.5 * SDS**2  # chosen: of an interval too narrow by the root of two
FEW = 30  # evaluations, chosen: from an optimum near by
PART = Reason(Why.PART_UNOBSERVABLE)
Flat = Mapping[str, tuple[float, float]]  # sd from the optimum, and rise of chi-square there


def profiled(estimate: Estimate, fitted: Fitted, budget: Budget = UNLIMITED) -> Estimate:
    """Return the estimate without the intervals of inertia and com that the misfit belies.

    As far as the budget allows; the rest is ``unfinished`` in it.
    """
    if not estimate.outcome.usable:
        return estimate
    sizes, flat = sizes_of(fitted), dict[str, tuple[float, float]]()
    within = replace(fitted, problem=replace(fitted.problem, budget=budget))
    for parameter in (*estimate.parameters, *estimate.ratios):
        if not is_wide(parameter, sizes):
            continue
        if not budget.allows(Stage.INTERVALS):
            break
        least = least_rise(within, parameter)
        if least < LEAST:
            flat[parameter.name] = (SDS, least)
    return opened(estimate, flat)


def opened(estimate: Estimate, flat: Flat) -> Estimate:
    """Return the estimate without intervals that the misfit belies; the same if there is none."""
    if not flat:
        return estimate
    reasons = estimate.outcome.reasons
    return replace(
        estimate,
        parameters=without_intervals(estimate.parameters, flat),
        ratios=without_intervals(estimate.ratios, flat),
        unobservable=(*estimate.unobservable,
                      *(Reason(Unobservable.MISFIT_FLAT, (name,),
                               {"sds": sds, "rise": rise, "due": sds**2})
                        for name, (sds, rise) in flat.items())),
        outcome=Outcome(reasons if PART in reasons else (*reasons, PART)),
    )  # fmt: skip


def sizes_of(fitted: Fitted) -> dict[str, float]:
    """Return the natural sizes of what no prior bounds, of inertia and centre of mass."""
    prior = fitted.problem.prior
    size = natural_sizes(fitted.point, fitted.problem.mass, fitted.problem.layout)
    bounded = prior.weight > prior.anchor
    columns = zip(BODY, size[CORE].tolist(), bounded[CORE], strict=True)
    return {name: value for name, value, known in columns if not known}


def without_intervals(parameters: tuple[Parameter, ...], flat: Flat) -> tuple[Parameter, ...]:
    """Return parameters of which some are open."""
    return tuple(
        replace(p, sd=np.inf, observable=False) if p.name in flat else p for p in parameters
    )


def is_wide(parameter: Parameter, sizes: Mapping[str, float]) -> bool:
    """Say whether a part of the body, or a ratio to another, is known so badly that it is tried."""
    first, *top = parameter.name.split("/")
    if first not in sizes or not parameter.observable:
        return False
    size = sizes[first] / (sizes[top[0]] if top else 1.0)
    return parameter.sd > WIDE * size


def least_rise(fitted: Fitted, parameter: Parameter) -> float:
    """Return by how much the misfit rises at that end of an interval where it rises less."""
    return min(rise(fitted, parameter, side * SDS * parameter.sd) for side in (-1.0, 1.0))


def held_at(problem: Problem, values: Mapping[str, float]) -> Problem:
    """Return the problem with some values held where they are given."""
    prior, names = problem.prior, problem.layout.names
    mean, held = prior.mean.copy(), prior.held.copy()
    for name, value in values.items():
        k = names.index(name)
        mean[k], held[k] = value, True
    return replace(problem, prior=replace(prior, mean=mean, held=held), scale_open=False)


def values_of(problem: Problem, point: Unknowns) -> dict[str, float]:
    """Return inertia and centre of mass at a point, by name."""
    values = physical(point, problem.mass, problem.layout)
    return dict(zip(BODY, values[CORE].tolist(), strict=True))


def end_of(fitted: Fitted, parameter: Parameter, away: float) -> dict[str, float]:
    """Return what is held where a parameter is ``away`` from its value: of a ratio, both."""
    problem = fitted.problem
    names = parameter.name.split("/")
    here = values_of(problem, fitted.point)
    found = {name: here[name] for name in names}
    size = found[names[1]] if len(names) > 1 else 1.0
    return found | {names[0]: found[names[0]] + away * size}


def rise(fitted: Fitted, parameter: Parameter, away: float) -> float:
    """Return by how much the misfit rises at so far from the optimum, all else sought anew."""
    problem = held_at(fitted.problem, end_of(fitted, parameter, away))
    found = settle_pinned(problem, fitted.point, fitted.jumps, FEW)
    return 2 * (cost_of(found) - cost_of(fitted))
